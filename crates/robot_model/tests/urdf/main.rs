//! Robots from URDF: the meaning of files, agreement with Pinocchio, the files that import writes, and the messages
//! about invalid and malicious files.

#![allow(clippy::unwrap_used, clippy::panic)]

mod arms;
mod hostile;
#[path = "../hostility/mod.rs"]
mod hostility;
mod import;
mod meaning;
mod text;
mod trees;

use robot_model::description::{Described, Options, read_urdf, read_with};
use robot_model::diagnostic::Diagnostics;
use robot_model::robot::Robot;
use robot_numeric::Mechanism;
use robot_numeric::random::Random;

/// Reads a file that must be valid.
fn read(text: &str) -> Described {
    read_urdf("arm.urdf", text).unwrap_or_else(|found| panic!("{text}\n{found}"))
}

/// Reads a file that must be valid with the given options.
fn read_taking(text: &str, options: &Options) -> Described {
    read_with("arm.urdf", text, options).unwrap_or_else(|found| panic!("{text}\n{found}"))
}

/// The errors of a file that must be invalid.
fn errors(text: &str) -> Diagnostics {
    match read_urdf("arm.urdf", text) {
        Ok(_) => panic!("no error in\n{}", text.chars().take(2000).collect::<String>()),
        Err(found) => found,
    }
}

fn codes(found: &Diagnostics) -> Vec<&'static str> {
    found.iter().map(|diagnostic| diagnostic.code).collect()
}

/// The largest difference between the torques of two robots at several states, relative to the largest torque.
fn difference(one: &Robot, other: &Robot) -> f64 {
    let (one, other) = (Mechanism::nominal(one).unwrap(), Mechanism::nominal(other).unwrap());
    let mut random = Random::new(11);
    let (mut worst, mut largest) = (0.0_f64, f64::MIN_POSITIVE);
    for _ in 0..10 {
        let state = random.state(&one);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let expected = one.inverse_dynamics(q, qd, qdd).unwrap();
        let found = other.inverse_dynamics(q, qd, qdd).unwrap();
        worst = worst.max((found - &expected).amax());
        largest = largest.max(expected.amax());
    }
    worst / largest
}
