//! Motions of whole robots.

#![allow(clippy::unwrap_used, clippy::panic)]

mod contributions;
mod energy;
mod friction;
mod inputs;
mod sticking;

use robot_build::{Functions, Options, Programs, Source, programs};
use robot_simulation::{Motion, RobotProgram, SimulationOptions, State, TorqueLaw, simulate};

/// A rod of 1 kg and 1 m that rotates about its end.
const PENDULUM: &str = r#"
format = 1
[robot]
name = "pendulum"
gravity = [0, "-g", 0]
[parameters]
g = { value = 9.81, unit = "m/s^2" }
[[link]]
name = "1"
joint = { type = "revolute", axis = "z" }
mass = 1
center_of_mass = [0.5, 0, 0]
inertia = { zz = "1/12", unchecked = true }
"#;

/// The text of a robot file of the project.
fn robot_file(name: &str) -> String {
    let path = format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

/// The programs that simulations of a robot need.
fn compiled(text: &str, friction: bool) -> Programs {
    let source = Source { name: "robot.toml".to_owned(), text: text.to_owned() };
    let functions = Functions::Chosen(RobotProgram::functions(friction));
    programs(&source, &Options { functions, ..Options::default() }).unwrap()
}

/// A state of rest.
fn rest(q: &[f64]) -> State {
    State { q: q.to_vec(), qd: vec![0.0; q.len()] }
}

/// The motion of this duration, in s.
fn motion(
    program: &RobotProgram<'_>,
    torques: &impl TorqueLaw,
    start: &State,
    duration: f64,
    tolerance: f64,
    step: f64,
) -> Motion {
    let options = SimulationOptions { duration, tolerance, step, ..SimulationOptions::default() };
    simulate(program, torques, start, &options, &mut |_| {}).unwrap()
}
