//! Writes the robots for the other programs, and times the generated code in the same way.
//!
//! ```text
//! calls models FOLDER      FOLDER/<robot>.txt for each robot of the comparison
//! calls time NAME          a line of JSON for each figure, NAME before "standard" or "polynomial"
//! ```

mod forms;
mod robot_data;
mod timing;

use std::error::Error;
use std::hint::black_box;

use calls::{BATCH, Calls, Name, Random, STATES};

use crate::timing::nanoseconds;

/// The robots of the comparison: those without parameters.
const ROBOTS: [&str; 6] = ["puma560", "ur5", "stanford", "scara", "iiwa", "panda"];

/// Larger robots, for which only some functions are compared.
const LARGE: [(&str, &str); 3] = [
    ("quadruped", "../../tests/fixtures/limbs/quadruped.toml"),
    ("humanoid", "robots/humanoid.toml"),
    ("chain", "robots/chain.toml"),
];

/// The functions of the comparison.
const FUNCTIONS: [&str; 10] = [
    "mass_matrix_lower",
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "inverse_dynamics_derivatives",
    "forward_dynamics_derivatives",
    "bias",
    "gravity",
    "regressor",
    "pose_and_jacobian",
];

/// Prints times; `compiled` names the target for which the code is compiled.
struct Timer {
    compiled: String,
}

impl Timer {
    fn report(&self, (robot, sine, function): Name, suffix: &str, ns: f64) {
        let compiled = &self.compiled;
        println!(
            r#"{{"peer": "{compiled} {sine}", "robot": "{robot}", "function": "{function}{suffix}", "ns": {ns:.2}}}"#
        );
    }
}

impl Calls for Timer {
    fn call<I: Copy, R>(
        &mut self,
        name: Name,
        inputs: impl Fn(&mut Random) -> I,
        call: impl Fn(&I) -> R,
        waits: impl Fn(&mut I) -> &mut [f64],
        first: impl Fn(&R) -> f64,
    ) {
        let is_large = LARGE.iter().any(|(robot, _)| *robot == name.0);
        if !(is_large || ROBOTS.contains(&name.0)) || !FUNCTIONS.contains(&name.2) {
            return;
        }
        let mut random = Random::default();
        let states: Vec<I> = (0..STATES).map(|_| inputs(&mut random)).collect();
        let throughput = nanoseconds(STATES, |i| {
            black_box(call(&states[i]));
        });
        self.report(name, "", throughput);
        let mut previous = 0.0;
        let latency = nanoseconds(STATES, |i| {
            let mut state = states[i];
            waits(&mut state).iter_mut().for_each(|number| *number += previous * 0.0);
            previous = first(&black_box(call(&state)));
        });
        self.report(name, " latency", latency);
    }

    fn batch<const N: usize>(
        &mut self,
        name: Name,
        call: impl Fn(&[[f64; N]], &[[f64; N]], &[[f64; N]], &mut [[f64; N]]),
    ) {
        if !ROBOTS.contains(&name.0) {
            return;
        }
        let mut random = Random::default();
        let [q, qd, qdd, mut tau] =
            [(); 4].map(|()| (0..BATCH).map(|_| random.array()).collect::<Vec<_>>());
        let ns = nanoseconds(1, |_| {
            call(black_box(&q), black_box(&qd), black_box(&qdd), &mut tau);
            black_box(&tau);
        });
        self.report(name, "", ns / BATCH as f64);
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["models", folder] => {
            for robot in ROBOTS {
                let path = format!("{}/../../robots/{robot}.toml", env!("CARGO_MANIFEST_DIR"));
                std::fs::write(format!("{folder}/{robot}.txt"), robot_data::of_file(robot, &path)?)?;
            }
            std::fs::create_dir_all(format!("{folder}/large"))?;
            for (robot, path) in LARGE {
                let path = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
                std::fs::write(format!("{folder}/large/{robot}.txt"), robot_data::of_file(robot, &path)?)?;
            }
        }
        ["time", name] => {
            let mut timer = Timer { compiled: (*name).to_owned() };
            calls::all(&mut timer);
            forms::time(|function, ns| timer.report(("ur5", "polynomial", function), "", ns));
        }
        _ => return Err("calls models FOLDER | calls time NAME".into()),
    }
    Ok(())
}
