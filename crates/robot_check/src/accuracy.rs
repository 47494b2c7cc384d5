//! Compares programs with the numeric solver.

use robot_build::Programs;
use robot_codegen::Interpreter;
use robot_model::variable::JointVariable::{Acceleration, Position, Torque, Velocity};
use robot_numeric::random::Random;
use robot_numeric::{Mechanism, NumericError};

/// The number of states in which the program is compared with the numeric solver.
const STATES: usize = 1000;
/// The seed of the states.
const SEED: u64 = 61;

/// Describes the states in words.
#[must_use]
pub fn states() -> String {
    format!(
        "{STATES} random states (seed {SEED}; angles in ±π, distances in ±0.5 m, velocities in ±2, \
         accelerations in ±5), nominal parameters"
    )
}

/// For inverse dynamics, the mass matrix and, if the programs contain it, forward dynamics: the largest error of any
/// component of the result, as a fraction of the largest component.
///
/// # Errors
///
/// The reason why the programs could not be compared with the solver: parameters without values, a missing
/// function, or a state for which the solver has no result.
pub fn worst(programs: &Programs) -> Result<Vec<(&'static str, f64)>, String> {
    let mechanism = Mechanism::nominal(&programs.robot).map_err(|error| error.to_string())?;
    let interpreter = Interpreter::new(&programs.module, &[]).map_err(|error| error.to_string())?;
    let call = |function: &str, inputs: &[(&str, &[f64])]| -> Result<Vec<f64>, String> {
        let function = interpreter.function(function).map_err(|error| error.to_string())?;
        function.call(inputs).map_err(|error| error.to_string())
    };
    let mut random = Random::new(SEED);
    // A robot with a singular mass matrix has no forward dynamics.
    let solves = programs.module.function("forward_dynamics").is_some();
    let mut errors = vec![("inverse_dynamics", 0.0f64), ("mass_matrix", 0.0)];
    errors.extend(solves.then_some(("forward_dynamics", 0.0)));
    for _ in 0..STATES {
        let state = random.state(&mechanism);
        let [q, qd, qdd, tau] = [&state.q, &state.qd, &state.qdd, &state.tau].map(Vec::as_slice);
        let failed = |error: NumericError| error.to_string();
        let torques = mechanism.inverse_dynamics(q, qd, qdd).map_err(failed)?;
        let masses = mechanism.mass_matrix(q).map_err(failed)?;
        let [q, qd, qdd, tau] = [(Position, q), (Velocity, qd), (Acceleration, qdd), (Torque, tau)]
            .map(|(variable, values)| (variable.name(), values));
        let mut found = vec![
            (call("inverse_dynamics", &[q, qd, qdd])?, torques.as_slice()),
            // The matrix is symmetric, so its columns are also its rows.
            (call("mass_matrix", &[q])?, masses.as_slice()),
        ];
        let rates;
        if solves {
            rates = mechanism.forward_dynamics(q.1, qd.1, tau.1, &[]).map_err(failed)?;
            let called = call("forward_dynamics", &[q, qd, tau])?;
            found.push((called, rates.as_slice()));
        }
        for ((_, error), (values, expected)) in errors.iter_mut().zip(&found) {
            *error = error.max(difference(values, expected));
        }
    }
    Ok(errors)
}

/// The largest difference, as a fraction of the largest expected value.
fn difference(values: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().fold(0.0f64, |size, value| size.max(value.abs()));
    let pairs = values.iter().zip(expected);
    let largest = pairs.map(|(value, expected)| (value - expected).abs());
    let largest =
        largest.fold(0.0, |largest, one| if one.is_nan() { f64::NAN } else { one.max(largest) });
    if values.len() != expected.len() || largest.is_nan() {
        return f64::INFINITY;
    }
    if size > 0.0 { largest / size } else { largest }
}
