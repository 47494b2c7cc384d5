//! The generated programs against values computed by Pinocchio (see `tests/fixtures/oracle`).
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod common;

use common::{largest_difference, magnitude};
use robot_build::{Options, programs_of};
use robot_codegen::Interpreter;

/// The files of the project hold angles as multiples of π/2 where the URDF prints eleven digits.
const TOLERANCE: f64 = 1e-9;

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn inverse_dynamics_of_six_arms() {
    for name in ["ur5", "panda", "iiwa", "puma560", "stanford", "scara"] {
        let path = format!("{}/tests/fixtures/oracle/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let fixture: serde_json::Value = serde_json::from_str(&text).unwrap();
        let programs = programs_of(common::robot(name), name, &Options::default()).unwrap();
        let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
        let states = fixture["states"].as_array().unwrap();
        assert!(states.len() >= 8);
        let mut worst = 0.0_f64;
        for state in states {
            let [q, qd, qdd, expected] = ["q", "v", "a", "tau"].map(|key| numbers(&state[key]));
            let inputs: [(&str, &[f64]); 3] = [("q", &q), ("qd", &qd), ("qdd", &qdd)];
            let tau = &interpreter.call("inverse_dynamics", &inputs).unwrap()[0].values;
            let error = largest_difference(tau, &expected) / magnitude(&expected);
            assert!(error <= TOLERANCE, "{name}: off by {error:e}");
            worst = worst.max(error);
        }
        println!("{name}: worst error {worst:.1e}");
    }
}
