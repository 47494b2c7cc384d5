//! Forward dynamics if the mass matrix is nearly singular, and if it is singular.

#![allow(clippy::unwrap_used)]

use robot_build::{Effects, FunctionKind, Functions, Options, Pivots, Programs, Source};
use robot_codegen::{Interpreter, counts::Counts, program::Operation};
use robot_model::robot::Robot;
use robot_numeric::Mechanism;
use robot_numeric::robots::{self, Random, Recipe};
use robot_symbolic::Function;
use serde_json::Value;

/// The wrists of `tests/fixtures/gimbals`, with results computed with 80 digits.
const GIMBALS: &str = include_str!("../../../tests/fixtures/gimbals/gimbals.json");
/// A wrist without mass in its first two links; its mass matrix is singular if q2 is 0.
const WRIST: &str = include_str!("../../../tests/fixtures/gimbals/wrist.toml");
const PENDULUM: &str = "format = 1
[robot]
name = \"pendulum\"
[parameters]
I = 0.1
[[link]]
name = \"1\"
joint = { type = \"revolute\", axis = \"y\" }
mass = 2
center_of_mass = [0.5, 0, 0]
inertia = { yy = \"I\", unchecked = true }
";

fn options(kind: FunctionKind) -> Options {
    Options { functions: Functions::Chosen(vec![kind]), ..Options::default() }
}

fn programs(name: &str, text: &str, kind: FunctionKind) -> Programs {
    let source = Source { name: name.to_owned(), text: text.to_owned() };
    robot_build::programs(&source, &options(kind)).unwrap()
}

/// All outputs at a state, one after the other.
fn call(programs: &Programs, given: &[(&str, f64)], inputs: &[(&str, &[f64])]) -> Vec<f64> {
    let interpreter = Interpreter::new(&programs.module, given).unwrap();
    let outputs = interpreter.call(&programs.module.functions[0].name, inputs).unwrap();
    outputs.into_iter().flat_map(|output| output.values).collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The largest error in units of the largest value.
fn error(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
    let largest = |worst: f64, (a, b): (&f64, &f64)| worst.max((a - b).abs());
    assert!(found.iter().all(|entry| entry.is_finite()), "{found:?}");
    found.iter().zip(expected).fold(0.0, largest) / size
}

/// The errors of the outputs of a function, for the robots whose fixtures have these outputs, with their states.
fn errors(kind: FunctionKind, keys: &[&str]) -> Vec<(String, f64, f64)> {
    let robots: Value = serde_json::from_str(GIMBALS).unwrap();
    let mut errors = vec![];
    for robot in robots.as_array().unwrap() {
        let text = robot["text"].as_str().unwrap();
        let name = if text.starts_with('<') { "wrist.urdf" } else { "wrist.toml" };
        let programs = programs(name, text, kind);
        for state in robot["states"].as_array().unwrap() {
            if keys.iter().any(|key| state.get(key).is_none()) {
                continue;
            }
            let [q, qd, tau] = ["q", "qd", "tau"].map(|key| numbers(&state[key]));
            let found = call(&programs, &[], &[("q", &q), ("qd", &qd), ("tau", &tau)]);
            for (found, key) in found.chunks(found.len() / keys.len()).zip(keys) {
                let distance = state["distance"].as_f64().unwrap();
                let place = format!("{} at {distance}: {key}", robot["name"]);
                errors.push((place, distance, error(found, &numbers(&state[key]))));
            }
        }
    }
    errors
}

/// Condition numbers from 10 to 10¹⁷. With a decomposition of M, the last states would have no correct digit.
#[test]
fn accelerations_keep_their_digits() {
    let errors = errors(FunctionKind::ForwardDynamics(Effects::NONE), &["qdd"]);
    assert_eq!(errors.len(), 14 * 16);
    // In one state torques cancel; there the error of Pinocchio is also 10⁻¹⁴.
    let many = errors.iter().filter(|(.., error)| *error > 5e-15).count();
    assert!(many <= 1, "{errors:?}");
    for (place, _, error) in errors {
        assert!(error <= 2e-13, "{place} is off by {error:e}");
    }
}

/// M⁻¹ ∂τ/∂x: ∂τ/∂x is a difference of large torques, and loses digits as the distance grows.
#[test]
fn derivatives_keep_what_their_torques_have() {
    let keys = ["dqdd_dq", "dqdd_dqd", "dqdd_dtau"];
    let errors = errors(FunctionKind::ForwardDynamicsDerivatives, &keys);
    assert_eq!(errors.len(), 2 * 16 * 3);
    for (place, distance, error) in errors {
        let bound = if place.ends_with("dtau") { 5e-15 } else { 1e-14 / distance };
        assert!(error <= bound, "{place} is off by {error:e}");
    }
}

#[test]
fn accelerations_have_the_right_sign() {
    let programs = programs("wrist.toml", WRIST, FunctionKind::ForwardDynamics(Effects::NONE));
    let signs = |q2: f64| -> Vec<f64> {
        let inputs: [(&str, &[f64]); 3] =
            [("q", &[0.3, q2, 0.4]), ("qd", &[0.0; 3]), ("tau", &[1.0, 0.0, 0.0])];
        call(&programs, &[], &inputs).iter().map(|entry| entry.signum()).collect()
    };
    for exponent in 2..16 {
        // A torque on the first joint moves it in its own direction, and the third joint in the opposite one.
        let signs = signs(10.0_f64.powi(-exponent));
        assert_eq!([signs[0], signs[2]], [1.0, -1.0], "at 1e-{exponent}");
    }
}

#[test]
fn what_is_singular_has_no_number() {
    let wrist = programs("wrist.toml", WRIST, FunctionKind::ForwardDynamics(Effects::NONE));
    let inputs: [(&str, &[f64]); 3] =
        [("q", &[0.3, 0.0, 0.4]), ("qd", &[0.0; 3]), ("tau", &[1.0, 2.0, 3.0])];
    let found = call(&wrist, &[], &inputs);
    assert!(found.iter().all(|entry| entry.is_nan()), "{found:?}");

    // An inertia of −9 in addition to m r² = 0.5: the acceleration would be finite, and opposed to the torque.
    let pendulum =
        programs("pendulum.toml", PENDULUM, FunctionKind::ForwardDynamics(Effects::NONE));
    let inputs: [(&str, &[f64]); 3] = [("q", &[0.0]), ("qd", &[0.0]), ("tau", &[1.0])];
    assert!(call(&pendulum, &[("I", 0.1)], &inputs)[0].is_finite());
    assert!(call(&pendulum, &[("I", -9.0)], &inputs)[0].is_nan());
    assert!(call(&pendulum, &[("I", -0.5)], &inputs)[0].is_nan());
}

#[test]
fn pivots_name_the_joint_and_the_digits() {
    let robot = programs("wrist.toml", WRIST, FunctionKind::ForwardDynamics(Effects::NONE)).robot;
    let pivots = Pivots::new(&robot, &Options::default(), &[]).unwrap();
    let at = |q2: f64| pivots.smallest(&[0.3, q2, 0.4]).unwrap();
    assert_eq!(at(0.5), None);
    let near = at(1e-5).unwrap();
    assert!(near.joint == "roll" && near.part < 1e-9 && !near.is_wrong(), "{near:?}");
    assert!(near.digits >= 14, "{near:?}");
    let here = at(0.0).unwrap();
    assert!(here.joint == "roll" && here.is_wrong(), "{here:?}");
    assert!(here.to_string().contains("singular in this configuration"), "{here}");
}

/// If a coordinate does not move exactly one joint, M is decomposed, and digits are lost.
#[test]
fn pivots_count_the_digits_that_a_decomposition_loses() {
    let follower = "[[link]]\nname = \"finger\"\nparent = \"hand\"\nmass = 0.1\n\
                    center_of_mass = [0, 0, 0.1]\n\
                    inertia = { xx = 1e-5, yy = 1e-5, zz = 1e-5 }\n\
                    joint = { type = \"prismatic\", axis = \"x\", mimic = { joint = \"finger2\" } }\n\
                    [[link]]\nname = \"finger2\"\nparent = \"hand\"\nmass = 0.1\n\
                    center_of_mass = [0, 0, 0.1]\n\
                    inertia = { xx = 1e-5, yy = 1e-5, zz = 1e-5 }\n\
                    joint = { type = \"prismatic\", axis = \"y\" }\n";
    let text = format!("{WRIST}\n{follower}");
    let robot = programs("wrist.toml", &text, FunctionKind::ForwardDynamics(Effects::NONE)).robot;
    let pivots = Pivots::new(&robot, &Options::default(), &[]).unwrap();
    let near = pivots.smallest(&[0.3, 1e-5, 0.4, 0.0]).unwrap().unwrap();
    assert!((2..=6).contains(&near.digits), "{near:?}");
}

/// Equal links about axes `axes`, one after the other; the link `idle` has the same axis as the next one and nearly no
/// inertia, and the last joint follows the one before it, so that M is decomposed.
fn chain(joints: usize, axes: [&str; 3], idle: Option<usize>) -> Robot {
    let link = |index: usize| {
        let axis = axes[index % 3];
        let (offset, mass) = match idle {
            Some(idle) if index == idle => (0.1, 1e-24),
            Some(idle) if index == idle + 1 => (0.0, 1.0),
            _ => (0.1, 1.0),
        };
        let inertia = 0.01 * mass;
        let mimic = match idle {
            Some(_) if index + 1 == joints => format!(", mimic = {{ joint = \"{}\" }}", index - 1),
            _ => String::new(),
        };
        format!(
            "[[link]]\nname = \"{index}\"\njoint = {{ type = \"revolute\", axis = \"{axis}\"{mimic} }}\n\
             origin = {{ xyz = [{offset}, 0, 0] }}\nmass = {mass}\ncenter_of_mass = [0.05, 0.01, 0]\n\
             inertia = {{ xx = {inertia}, yy = {inertia}, zz = {inertia} }}\n"
        )
    };
    let links: String = (0..joints).map(link).collect();
    let text = format!("format = 1\n[robot]\nname = \"chain\"\n{links}");
    robot_build::read(&Source { name: "chain.toml".to_owned(), text }).unwrap().robot
}

/// A bound that follows each operation grows by about one digit with each joint, and would leave no digit here. The
/// condition numbers of M are about 10⁵.
#[test]
fn long_chains_keep_their_digits() {
    for (joints, axes, digits) in [(16, ["z"; 3], 9), (30, ["z"; 3], 8), (30, ["z", "y", "x"], 8)] {
        let robot = chain(joints, axes, None);
        let pivots = Pivots::new(&robot, &Options::default(), &[]).unwrap();
        let mechanism = Mechanism::nominal(&robot).unwrap();
        let options = options(FunctionKind::ForwardDynamics(Effects::NONE));
        let programs = robot_build::programs_of(robot, "chain", &options).unwrap();
        let rest = vec![0.0; joints];
        let other = Random::new(1).state(&mechanism).q;
        for q in [rest.clone(), other] {
            assert_eq!(pivots.smallest(&q).unwrap(), None, "{joints} {axes:?} {q:?}");
            let tau: Vec<f64> = (0..joints).map(|joint| joint as f64 - 7.5).collect();
            let found = call(&programs, &[], &[("q", &q), ("qd", &rest), ("tau", &tau)]);
            let torques = mechanism.inverse_dynamics(&q, &rest, &found).unwrap();
            assert!(error(torques.as_slice(), &tau) < 10.0_f64.powi(-digits), "{joints} {axes:?}");
        }
    }
}

/// The first of two joints with the same axis carries 10⁻²⁴ kg more than the second.
#[test]
fn long_chains_can_be_singular_to_within_rounding() {
    for axes in [["z"; 3], ["z", "z", "y"]] {
        let robot = chain(24, axes, Some(9));
        let pivots = Pivots::new(&robot, &Options::default(), &[]).unwrap();
        let found = pivots.smallest(&[0.1; 23]).unwrap().unwrap();
        assert!(found.is_wrong() && found.joint == "9", "{found:?}");
        assert!(found.to_string().contains("singular"), "{found}");
    }
}

/// The code of arms does not check pivots with reciprocals of positive numbers. The numbers are the operations of
/// forward dynamics without a search.
#[test]
fn arms_decompose_their_mass_matrix() {
    for (name, operations) in
        [("puma560", 514), ("ur5", 382), ("iiwa", 753), ("panda", 1084), ("scara", 84)]
    {
        let path = format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let programs = programs(name, &text, FunctionKind::ForwardDynamics(Effects::NONE));
        let core = &programs.module.functions[0].core;
        assert_eq!(Counts::of(core).operations(), operations, "{name}");
        let checks = |operation: &Operation| {
            matches!(operation, Operation::Call(Function::RecipPositive, _))
        };
        assert!(!core.operations().iter().any(checks), "{name}");
    }
}

/// A random tree in which some links that carry others have no mass.
fn with_massless_links(seed: u64) -> Robot {
    let mut random = Random::new(seed);
    let recipe = Recipe::tree(3 + random.index(5));
    let mut robot = robots::robot(&mut random, &recipe);
    for index in 0..robot.links.len() {
        let carries = robot.links.iter().any(|other| other.parent == Some(index));
        if carries && random.index(2) == 0 {
            robot.links[index].bodies.clear();
        }
    }
    robot
}

#[test]
fn trees_with_massless_links_agree_with_the_numeric_solver() {
    let mut checked = 0;
    for seed in 0..60 {
        let robot = with_massless_links(seed);
        let mechanism = Mechanism::nominal(&robot).unwrap();
        let state = Random::new(seed).state(&mechanism);
        let (q, qd, tau) = (&state.q, &state.qd, &state.tau);
        let Ok(expected) = mechanism.articulated_body(q, qd, tau, &[]) else { continue };
        // Two parallel slides without mass between them: M is singular in every configuration.
        if expected.iter().any(|entry| !entry.is_finite() || entry.abs() > 1e8) {
            continue;
        }
        let options = options(FunctionKind::ForwardDynamics(Effects::NONE));
        let programs = robot_build::programs_of(robot, "random", &options).unwrap();
        let found = call(&programs, &[], &[("q", q), ("qd", qd), ("tau", tau)]);
        let error = error(&found, expected.as_slice());
        assert!(error < 1e-9, "seed {seed}: {error:e}");
        checked += 1;
    }
    assert!(checked > 40, "{checked}");
}

/// A joint that moves no mass in any configuration: the error names the mass matrix.
#[test]
fn a_joint_without_mass_is_the_reason() {
    let text = format!(
        "{WRIST}\n[[link]]\nname = \"idle\"\njoint = {{ type = \"revolute\", axis = \"x\" }}\nmassless = true\n"
    );
    let source = Source { name: "wrist.toml".to_owned(), text };
    let options = options(FunctionKind::ForwardDynamics(Effects::NONE));
    let found = robot_build::programs(&source, &options).unwrap_err().to_string();
    assert!(found.contains("the mass matrix is singular"), "{found}");
}

#[test]
fn functions_that_a_singular_robot_lacks_are_listed_with_the_joints() {
    let robot = |more: &str| {
        let source = Source { name: "wrist.toml".to_owned(), text: format!("{WRIST}\n{more}") };
        robot_build::read(&source).unwrap().robot
    };
    let options = Options { search: true, ..Options::default() };
    assert_eq!(robot_build::unsolvable(&robot(""), &options), None);
    let idle = "[[link]]\nname = \"idle\"\njoint = { name = \"free\", type = \"revolute\", axis = \"x\" }\n\
        massless = true\n";
    let found = robot_build::unsolvable(&robot(idle), &options).unwrap();
    assert_eq!(found.joints, ["free"]);
    assert!(found.functions.contains(&FunctionKind::ForwardDynamics(Effects::NONE)));
    assert!(found.functions.iter().all(|kind| kind.divides_by_mass_matrix()), "{found:?}");
    let shown = found.to_string();
    assert!(shown.starts_with("the robot has no forward_dynamics, "), "{shown}");
    assert!(shown.ends_with("do not determine the accelerations of `free`"), "{shown}");
}

/// Two arms, each of which is a wrist; `q2` and `q5` are their tilts.
fn two_wrists() -> Robot {
    let (start, links) = WRIST.split_once("[[link]]").unwrap();
    let links = format!("[[link]]{links}");
    let other = ["roll", "tilt", "hand"].iter().fold(links.clone(), |text, name| {
        text.replace(&format!("\"{name}\""), &format!("\"other_{name}\""))
    });
    let other =
        other.replacen("name = \"other_roll\"", "name = \"other_roll\"\nparent = \"base\"", 1);
    let source = Source { name: "two.toml".to_owned(), text: format!("{start}{links}{other}") };
    robot_build::read(&source).unwrap().robot
}

/// The decomposition starts with the last row, so of equal pivots the last is named.
#[test]
fn the_smallest_pivot_is_named() {
    let robot = two_wrists();
    let pivots = Pivots::new(&robot, &Options::default(), &[]).unwrap();
    let at = |q2: f64, q5: f64| pivots.smallest(&[0.3, q2, 0.4, 0.3, q5, 0.4]).unwrap();
    let joint = |q2, q5| at(q2, q5).unwrap().joint;
    let [first, last] = [0, 3].map(|index| robot.coordinates[index].joint.clone());
    assert_ne!(first, last);
    assert_eq!(at(1.0, 1.0), None);
    assert_eq!([joint(1e-5, 1.0), joint(1.0, 1e-5)], [first.clone(), last.clone()]);
    assert_eq!([joint(1e-6, 1e-5), joint(1e-5, 1e-6)], [first, last.clone()]);
    assert_eq!(joint(0.0, 0.0), last);
    // Sums are rounded in different orders in the two arms, so that only some pivots are exactly equal.
    let part = |q2, q5| at(q2, q5).unwrap().part;
    let tilts = (1..200).map(|index| 1e-7 * f64::from(index));
    let equal: Vec<f64> = tilts.filter(|tilt| part(*tilt, 1.0) == part(1.0, *tilt)).collect();
    assert!(equal.len() > 5, "{equal:?}");
    for tilt in equal {
        assert_eq!(joint(tilt, tilt), last, "{tilt}");
    }
}

/// A module lists the other functions of its robot; functions that solve with the mass matrix are not among them if it
/// is always singular.
#[test]
fn a_module_lists_what_else_the_robot_has() {
    let idle = format!(
        "{WRIST}\n[[link]]\nname = \"idle\"\njoint = {{ type = \"revolute\", axis = \"x\" }}\nmassless = true\n"
    );
    let mass_matrix = || Functions::Chosen(vec![FunctionKind::MassMatrix]);
    for (text, solves) in [(WRIST, true), (&idle, false), (PENDULUM, true)] {
        let source = Source { name: "wrist.toml".to_owned(), text: text.to_owned() };
        for functions in [Functions::Usual, mass_matrix()] {
            let has_matrix = functions == mass_matrix();
            let options = Options { functions, ..Options::default() };
            let code = robot_build::generate(&source, &options).unwrap().code;
            let lists = |name: &str| {
                let start = code.find("Also available").unwrap();
                let end = code[start..].find("pub mod").unwrap();
                code[start..start + end].contains(&format!("`{name}`"))
            };
            for name in ["forward_dynamics", "forward_dynamics_derivatives"] {
                assert_eq!(lists(name), solves, "{name} of {}", source.text);
            }
            assert_eq!(lists("mass_matrix"), !has_matrix);
            assert_eq!(lists("inverse_dynamics"), has_matrix);
            assert!(lists("forward_kinematics"));
        }
    }
}
