//! A payload that is set at run time, compared with the numeric solver for the body as a separate link.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::Matrix3;
use robot_build::{
    Effects, FunctionKind, Functions, Options, RobotFile, Scalar, Source, generate, programs,
};
use robot_codegen::Interpreter;
use robot_dynamics::economical::pin::Pin;
use robot_model::robot::Robot;
use robot_numeric::random::Random;
use robot_numeric::robots::parameterized;
use robot_numeric::{self, Joint, Link, Pose};

use crate::package::{Package, dependency};

const STATES: usize = 20;
const TOLERANCE: f64 = 1e-12;
/// The tolerance for numbers with 24 bits after some hundred operations.
const SINGLE_TOLERANCE: f64 = 2e-5;

const MASS: f64 = 2.7;
const CENTER: [f64; 3] = [0.03, -0.08, 0.11];
/// The inertia tensor: xx, yy, zz, xy, xz, yz.
const INERTIA: [f64; 6] = [0.021, 0.017, 0.013, 0.004, -0.002, 0.003];
const NAMES: [&str; 10] = ["mass", "x", "y", "z", "xx", "yy", "zz", "xy", "xz", "yz"];

fn robot_file(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("robots/{name}"));
    std::fs::read_to_string(path).unwrap()
}

/// A robot file with a payload on the given link or frame, or by default on the last link.
fn source(name: &str, parent: Option<&str>) -> Source {
    let parent = parent.map(|parent| format!("parent = \"{parent}\"\n")).unwrap_or_default();
    let text = format!("{}\n[payload]\n{parent}", robot_file(&format!("{name}.toml")));
    Source { name: format!("{name}.toml"), text }
}

/// The solver for the robot with the body as a fixed link.
fn solver(robot: &Robot, carrier: usize, placement: Pose) -> robot_numeric::Mechanism {
    let [xx, yy, zz, xy, xz, yz] = INERTIA;
    let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let alone = robot_numeric::Mechanism::nominal(robot).unwrap();
    let mut links = alone.links().to_vec();
    let body = Link::new(Some(carrier), placement, Joint::fixed(), MASS, CENTER.into(), inertia);
    links.push(body);
    robot_numeric::Mechanism::new(*alone.gravity(), links, alone.frames().to_vec()).unwrap()
}

/// States and the torques in them.
fn expected(solver: &robot_numeric::Mechanism) -> Vec<([Vec<f64>; 3], Vec<f64>)> {
    let mut random = Random::new(17);
    let state = |_| {
        let n = solver.coordinates();
        let motion: [Vec<f64>; 3] =
            std::array::from_fn(|_| (0..n).map(|_| random.uniform(-2.0, 2.0)).collect());
        let torques = solver.inverse_dynamics(&motion[0], &motion[1], &motion[2]).unwrap();
        (motion, torques.iter().copied().collect())
    };
    (0..STATES).map(state).collect()
}

fn worst(found: &[Vec<f64>], expected: &[([Vec<f64>; 3], Vec<f64>)]) -> f64 {
    let torques = || expected.iter().flat_map(|(_, torques)| torques);
    let size = torques().fold(0.0_f64, |size, tau| size.max(tau.abs()));
    let errors = found.iter().flatten().zip(torques()).map(|(a, b)| (a - b).abs() / size);
    assert_eq!(found.iter().flatten().count(), torques().count());
    errors.fold(0.0, f64::max)
}

fn options() -> Options {
    let functions = Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]);
    Options { functions, ..Options::default() }
}

/// Compares the interpreter's torques for the default plan and for the plan that is pinned for the robot without the
/// payload.
#[test]
fn every_plan_carries_a_payload() {
    for (name, parent) in [
        ("puma560", None),
        ("ur5", None),
        ("ur5", Some("tool0")),
        ("iiwa", None),
        ("panda", Some("panda_link7")),
        ("panda", Some("panda_hand")),
        ("stanford", None),
        ("trttr1", Some("4")),
    ] {
        let source = source(name, parent);
        let pin = Pin::from_text(&robot_file(&format!("{name}.plan"))).unwrap();
        for plan in [None, Some(pin.plan)] {
            let programs = programs(&source, &Options { plan, ..options() }).unwrap();
            let robot = &programs.robot;
            let alone = robot_numeric::Mechanism::nominal(robot).unwrap();
            let frame = robot.frames.iter().position(|frame| Some(frame.name.as_str()) == parent);
            let link = robot.links.iter().position(|link| Some(link.name.as_str()) == parent);
            let (carrier, placement) = match frame {
                Some(frame) => (robot.frames[frame].link, alone.frames()[frame].placement),
                None => (link.or(Some(robot.links.len() - 1)), Pose::identity()),
            };
            let expected = expected(&solver(robot, carrier.unwrap(), placement));
            let values: Vec<f64> = [MASS].into_iter().chain(CENTER).chain(INERTIA).collect();
            let names = NAMES.map(|name| format!("payload_{name}"));
            let given: Vec<(&str, f64)> = names.iter().map(String::as_str).zip(values).collect();
            let interpreter = Interpreter::new(&programs.module, &given).unwrap();
            let torques = expected.iter().map(|([q, qd, qdd], _)| {
                let inputs = [("q", &q[..]), ("qd", qd), ("qdd", qdd)];
                interpreter.call("inverse_dynamics", &inputs).unwrap().remove(0).values
            });
            let torques: Vec<Vec<f64>> = torques.collect();
            let error = worst(&torques, &expected);
            assert!(error <= TOLERANCE, "{name} {parent:?}: off by {error:e}");
        }
    }
}

/// If all ten values of the link are parameters anyway, a payload adds no operations to a call.
#[test]
fn a_payload_costs_no_operation_at_a_call() {
    for name in ["puma560", "ur5", "iiwa", "panda"] {
        let count = |text: String| {
            let source = Source { name: "arm.toml".to_owned(), text };
            let robot = parameterized(&robot_build::read(&source).unwrap().robot);
            let programs = robot_build::programs_of(robot, "arm.toml", &options()).unwrap();
            let module = &programs.module;
            module.counts(&module.functions[0]).call
        };
        let text = robot_file(&format!("{name}.toml"));
        // A center of mass at the origin would be treated as the constant 0, so it is replaced.
        let text = text.replace("center_of_mass = [0, 0, 0]", "center_of_mass = [0.1, 0.2, 0.3]");
        let with = count(format!("{text}\n[payload]\n"));
        assert_eq!(with.operations(), count(text).operations(), "{name}");
    }
}

#[test]
fn a_pin_made_without_the_payload_is_stale() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("payload-pin");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("ur5.toml");
    std::fs::write(&path, source("ur5", None).text).unwrap();
    std::fs::write(path.with_extension("plan"), robot_file("ur5.plan")).unwrap();
    let error = RobotFile::read(&path).unwrap().with_pin(&options()).unwrap_err().to_string();
    assert!(error.contains("stale") && error.contains("search for a plan again"), "{error}");
}

/// Models with the payload, and calls in the states, in `f64` and `f32`.
#[test]
fn compiled_models_carry_a_payload() {
    let runtime = dependency("robot_runtime", "");
    let package = Package::new("payload", &format!("[dependencies]\n{runtime}"));
    let mut text = "#![deny(warnings, missing_docs, clippy::all)]\n//! Torques.\n".to_owned();
    let mut main = "fn main() {\n".to_owned();
    let body = format!("{MASS:?}, {CENTER:?}, {INERTIA:?}");
    let mut cases = vec![];
    for name in ["ur5", "trttr1"] {
        let source = source(name, None);
        let robot = robot_build::read(&source).unwrap().robot;
        let states = expected(&solver(&robot, robot.links.len() - 1, Pose::identity()));
        for (scalar, tolerance) in [(Scalar::F64, TOLERANCE), (Scalar::F32, SINGLE_TOLERANCE)] {
            let code = generate(&source, &Options { scalar, ..options() }).unwrap().code;
            let module = format!("{name}_{}", scalar_name(scalar));
            writeln!(text, "/// A case.\npub mod {module} {{\n{code}\n}}").unwrap();
            let path = format!("{module}::{name}");
            writeln!(
                main,
                "let m = {path}::Model::with_payload({body});\n\
                 assert_eq!(m, {path}::Model::new(&{path}::Parameters::NOMINAL\
                 .with_payload(9.0, [1.0; 3], [2.0; 6]).with_payload({body})));"
            )
            .unwrap();
            for ([q, qd, qdd], _) in &states {
                writeln!(
                    main,
                    "println!(\"{{:?}}\", m.inverse_dynamics(&{q:?}, &{qd:?}, &{qdd:?}));"
                )
                .unwrap();
            }
            cases.push((module, states.clone(), tolerance));
        }
    }
    package.write("src/main.rs", &format!("{text}{main}}}\n"));
    let shown = package.run(&["run"]);
    let mut lines = shown.lines();
    for (module, states, tolerance) in cases {
        let line = |line: &str| {
            let entries = line.trim_matches(['[', ']']).split(", ");
            entries.map(|entry| entry.parse().unwrap()).collect()
        };
        let found: Vec<Vec<f64>> = lines.by_ref().take(STATES).map(line).collect();
        let error = worst(&found, &states);
        assert!(error <= tolerance, "{module} is off by {error:e}");
    }
}

fn scalar_name(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::F64 => "f64",
        Scalar::F32 => "f32",
    }
}
