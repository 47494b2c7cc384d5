//! Checks that the regressor of the base parameters, times the base parameters, gives the joint torques with friction.

use robot_dynamics::base_parameters::{BaseParameter, base_parameters};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::out_of_reach;
use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::{BaseFrames, Robot};
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::{Expr, Formula, Graph, Rational};

use crate::{STATES, TOLERANCE};
use robot_testing::place::{Layout, Off};
use robot_testing::solver::{expected, state};
use robot_testing::{evaluate, magnitude, robot};

fn output<'g>(derivation: &Derivation<'_, 'g>, kind: FunctionKind) -> Vec<Expr<'g>> {
    let functions = derivation.functions(kind).into_iter();
    functions.flat_map(|function| function.outputs).flat_map(|output| output.values).collect()
}

/// Checks a robot and returns the number of its base parameters.
fn check(robot: &Robot, name: &str, seed: u64) -> usize {
    let mut robot = robot.clone();
    for link in &mut robot.links {
        // Friction that depends on the contact force is not linear in the parameters.
        link.friction.coulomb = Formula::number(&Rational::ZERO);
    }
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
    let columns = output(&derivation, FunctionKind::RegressorBase);
    let values = output(&derivation, FunctionKind::BaseParameters);
    let mut random = Random::new(seed);
    let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
    for _ in 0..STATES {
        let state = state(&mut random, &solver, &robot);
        let expected =
            expected(&robot, &solver, FunctionKind::InverseDynamics(Effects::FRICTION), &state);
        let columns = evaluate(&robot, &columns, &state);
        let values = evaluate(&robot, &values, &state);
        let product = |row: &[f64]| row.iter().zip(&values).map(|(y, p)| y * p).sum::<f64>();
        let forces: Vec<f64> = columns.chunks(values.len()).map(product).collect();
        let layout = Layout::per_joint(&robot, "Y β");
        let off = Off::of(&layout, &forces, &expected, magnitude(&expected).max(1e-3));
        assert!(off.error <= TOLERANCE, "{name}, {}: {off}", robot.base_frames.name());
    }
    values.len()
}

/// A component √(1 − c²) of an axis has values only at |c| ≤ 1, and what vanishes is recognized there, whatever the
/// parameter is called.
#[test]
fn axes_with_roots_of_parameters() {
    for name in ["b", "c", "k", "w", "c1", "cx"] {
        for (first, drive, count) in [("[1, 0, 0]", "0", 10), ("[0.3, 0.7, 1]", "0.1", 11)] {
            let body = "mass = 1.5\ncenter_of_mass = [0.1, 0.2, 0]\ninertia = { xx = 0.1, yy = 0.1, zz = 0.1 }";
            let text = format!(
                "format = 1\n[robot]\nname = \"skew\"\n[parameters]\n{name} = 0.6\n[[link]]\nname = \"1\"\n\
                 joint = {{ type = \"revolute\", axis = {first} }}\n{body}\n[[link]]\nname = \"2\"\n\
                 joint = {{ type = \"revolute\", axis = [\"{name}\", 0, \"sqrt(1 - {name}^2)\"] }}\n\
                 origin = {{ xyz = [0.3, 0, 0] }}\ndrive = {{ armature = {drive} }}\n{body}\n"
            );
            let robot = robot_testing::read(name, &text);
            assert_eq!(check(&robot, name, 5), count, "{name}, {first}");
        }
    }
}

/// The rotor of a joint that mimics another turns by the ratio of the joint times the coordinate.
#[test]
fn base_parameters_of_rotors_that_follow_others() {
    let followers = (60..68).map(|seed| {
        let recipe = Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(6) };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        check(&robot, "tree", seed);
        robot.links.iter().filter(|it| it.drive.gyroscopic && it.joint.ratio.text() != "1").count()
    });
    assert!(followers.sum::<usize>() > 0);
}

#[test]
fn base_parameters_give_the_joint_torques() {
    for (name, robot, seed) in crate::robots() {
        for base_frames in BaseFrames::ALL {
            let robot = Robot { base_frames, ..robot.clone() };
            if out_of_reach(&robot).is_none() {
                check(&robot, &name, seed);
            }
        }
    }
}

/// A chain of three joints with an angle d and a length e before each.
fn chain(kinds: usize, axes: usize, turned: usize, parameters: &str) -> Robot {
    let link = |number: usize| {
        let is_prismatic = number > 0 && (kinds >> (number - 1)) & 1 == 1;
        let kind = if is_prismatic { "prismatic" } else { "revolute" };
        let axis = ["x", "y", "z"][axes / 3_usize.pow(number as u32) % 3];
        let mut rpy = ["0", "0", "0"];
        rpy[turned] = "d";
        let [roll, pitch, yaw] = rpy;
        format!(
            "[[link]]\nname = \"{number}\"\njoint = {{ type = \"{kind}\", axis = \"{axis}\" }}\n\
             origin = {{ xyz = [0.1, \"e\", 0], rpy = [\"{roll}\", \"{pitch}\", \"{yaw}\"] }}\nmass = 1\n\
             center_of_mass = [0.1, 0.2, 0.3]\ninertia = {{ xx = 0.1, yy = 0.11, zz = 0.12 }}\n"
        )
    };
    let links: String = (0..3).map(link).collect();
    let text = format!("format = 1\n[robot]\nname = \"arm\"\n{parameters}{links}");
    let text = match parameters {
        "" => text.replace("\"d\"", "0").replace("\"e\"", "0"),
        _ => text,
    };
    robot_model::description::read_toml("arm.toml", &text).unwrap().robot
}

/// Angles and lengths that are parameters with the nominal value 0 are not divisors of base parameters, unless the robot
/// has fewer base parameters at these values than in general.
#[test]
fn base_parameters_are_finite_if_angles_and_lengths_are_nominally_zero() {
    let (mut finite, mut fewer) = (0, 0);
    for (kinds, axes, turned) in [1, 3].into_iter().flat_map(|kinds| {
        (0..27).flat_map(move |axes| (0..3).map(move |turned| (kinds, axes, turned)))
    }) {
        let zero = chain(kinds, axes, turned, "[parameters]\nd = 0\ne = 0\n");
        let count = |robot: &Robot| {
            let graph = Graph::new();
            let derivation = Derivation::new(robot, &graph, &MechanismOptions::ROUNDED, None);
            base_parameters(&derivation).unwrap().base.len()
        };
        if count(&chain(kinds, axes, turned, "")) < count(&zero) {
            fewer += 1;
        } else {
            check(&zero, &format!("{kinds} {axes} {turned}"), 7);
            finite += 1;
        }
    }
    assert!(finite > 80 && finite + fewer == 162, "{finite} {fewer}");
}

/// Checks the numbers of base parameters of arms that are known from the literature.
#[test]
fn base_parameters_are_as_many_as_known() {
    for (name, count) in [("puma560", 36), ("stanford", 33)] {
        assert_eq!(check(&robot(name), name, 5), count, "{name}");
    }
}

/// Standard parameters for which one base parameter is 1 have 0 for all others, and each of their coefficients is needed.
#[test]
fn a_unit_of_a_base_parameter_is_not_another() {
    for name in ["puma560", "stanford", "panda"] {
        for base_frames in BaseFrames::ALL {
            let robot = Robot { base_frames, ..robot(name) };
            let graph = Graph::new();
            let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
            let base = base_parameters(&derivation).unwrap().base;
            let mut random = Random::new(3);
            let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
            let state = state(&mut random, &solver, &robot);
            let numbers = |terms: &[(usize, Expr<'_>)]| -> Vec<(usize, f64)> {
                let (places, values): (Vec<usize>, Vec<Expr<'_>>) = terms.iter().copied().unzip();
                places.into_iter().zip(evaluate(&robot, &values, &state)).collect()
            };
            let rows: Vec<_> = base.iter().map(|one| numbers(&one.terms)).collect();
            for (number, parameter) in base.iter().enumerate() {
                let unit = numbers(&parameter.unit);
                assert!(unit.iter().all(|(_, value)| *value != 0.0), "{name}: {unit:?}");
                for (other, row) in rows.iter().enumerate() {
                    let products = row.iter().map(|(place, coefficient)| {
                        let given = unit.iter().find(|(of_unit, _)| of_unit == place);
                        given.map_or(0.0, |(_, value)| coefficient * value)
                    });
                    let (found, expected): (f64, _) =
                        (products.sum(), if other == number { 1.0 } else { 0.0 });
                    let names = [&base[other], parameter].map(BaseParameter::name);
                    assert!((found - expected).abs() < 1e-9, "{name}: {names:?} {found}");
                }
            }
        }
    }
}

/// Only parameters to which others are added have an R in their names.
#[test]
fn regrouped_parameters_are_marked() {
    let robot = robot("planar_2r");
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
    let base = base_parameters(&derivation).unwrap();
    let names: Vec<String> = base.base.iter().map(BaseParameter::name).collect();
    assert_eq!(names, ["MXR_1", "MY_1", "ZZR_1", "MX_2", "MY_2", "ZZ_2"]);
}
