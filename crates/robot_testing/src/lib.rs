//! Code that the tests of several crates share: robots, states, values of expressions in states, and the pages of the
//! book.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "only tests use it, and a test that fails panics"
)]

pub mod complex_step;
pub mod energy;
pub mod pages;
pub mod place;
pub mod plans;
pub mod solver;

use std::path::Path;

use robot_model::description::read_toml;
use robot_model::robot::{Parameter, Robot};
use robot_model::variable::JointVariable;
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::{Expr, Formula, Rational, walk};

/// A robot file of the project: a planar arm with two links in a vertical plane.
pub const PLANAR_2R: &str = include_str!("../../../robots/planar_2r.toml");

/// The robot files of the project, by name.
pub fn robot_files() -> Vec<(String, String)> {
    // Both the tests of single crates and those of the whole project use this function.
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = own.ancestors().map(|folder| folder.join("robots")).find(|robots| robots.is_dir());
    let folder = folder.unwrap();
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| {
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            (name, std::fs::read_to_string(&path).unwrap())
        })
        .collect();
    files.sort();
    assert!(files.len() >= 9, "robot files are missing: {}", files.len());
    files
}

/// The robot of a file of the project.
pub fn robot(name: &str) -> Robot {
    let (_, text) = robot_files().into_iter().find(|(file, _)| file == name).unwrap();
    read(name, &text)
}

/// The robot that a text describes.
pub fn read(name: &str, text: &str) -> Robot {
    match read_toml(name, text) {
        Ok(described) => described.robot,
        Err(diagnostics) => panic!("{diagnostics}"),
    }
}

/// A random tree whose joint axes depend on parameters, so that working frames cannot be chosen for it.
pub fn with_free_axes(seed: u64) -> Robot {
    let recipe = Recipe { drives: true, mimic: true, ..Recipe::tree(1 + seed as usize % 4) };
    let mut robot = robots::robot(&mut Random::new(seed), &recipe);
    for (number, link) in (1..).zip(&mut robot.links) {
        let name = format!("lean{number}");
        link.joint.axis[1] = Formula::symbol(&name);
        let value = Rational::new(number, 7);
        robot.parameters.push(Parameter { name, value, unit: None, latex: None, doc: None });
    }
    robot
}

/// The nominal value of the parameter with the given name.
pub fn nominal(robot: &Robot, name: &str) -> f64 {
    robot.parameter(name).and_then(|parameter| parameter.value.as_ref()).unwrap().to_f64()
}

/// The values of expressions in a state, with one wrench for each tip and parameters at their nominal values.
pub fn evaluate(
    robot: &Robot,
    roots: &[Expr<'_>],
    state: &robot_numeric::random::State,
) -> Vec<f64> {
    let graph = roots[0].graph();
    walk::evaluate(roots, |symbol| {
        let name = graph.symbol_name(symbol);
        value_of(robot, &name, state).unwrap_or_else(|| panic!("no value for {name}"))
    })
}

/// The values of a joint variable in a state.
pub fn joint_values(state: &robot_numeric::random::State, variable: JointVariable) -> &[f64] {
    match variable {
        JointVariable::Position => &state.q,
        JointVariable::Velocity => &state.qd,
        JointVariable::Acceleration => &state.qdd,
        JointVariable::Torque => &state.tau,
    }
}

/// The value of a symbol in a state.
pub fn value_of(robot: &Robot, name: &str, state: &robot_numeric::random::State) -> Option<f64> {
    if let Some((variable, index)) = JointVariable::parse(name) {
        return joint_values(state, variable).get(index).copied();
    }
    for (index, frame) in robot.frames.iter().enumerate() {
        let Some(wrench) = &frame.wrench else { continue };
        let applied = &state.wrenches[index];
        for k in 0..3 {
            if wrench.force[k] == name {
                return Some(applied.force[k]);
            }
            if wrench.moment[k] == name {
                return Some(applied.moment[k]);
            }
        }
    }
    robot.parameter(name).map(|_| nominal(robot, name))
}

/// The largest magnitude of the values.
pub fn magnitude<'v>(values: impl IntoIterator<Item = &'v f64>) -> f64 {
    values.into_iter().fold(0.0, |size, value| value.abs().max(size))
}

/// The largest difference between corresponding values of two arrays; infinite if a value is NaN.
pub fn largest_difference(values: &[f64], reference: &[f64]) -> f64 {
    assert_eq!(values.len(), reference.len());
    let differences = values.iter().zip(reference).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |worst: f64, d| if d.is_nan() { f64::INFINITY } else { worst.max(d) })
}
