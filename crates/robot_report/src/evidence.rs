//! What stands behind the code: what the compiler made of it, and what the numeric solver says.

use robot_build::Programs;
use robot_codegen::Interpreter;
use robot_dynamics::numeric::Mechanism;
use robot_dynamics::numeric::random::Random;
use robot_evidence::{Evidence, Module};

use crate::html::{Element, Node, element, holding};
use crate::table::Table;

/// What the compiler made of the code.
#[derive(Clone, Debug)]
pub enum Compiled {
    /// Its objects were read.
    Read {
        /// The compiler, its version and target.
        compiler: String,
        /// What was read, for each profile.
        modules: Vec<Module>,
    },
    /// There is no evidence.
    Unread {
        /// Why.
        reason: String,
    },
}

/// The evidence of the object files.
pub(crate) fn compiled(compiled: &Compiled) -> Vec<Node> {
    match compiled {
        Compiled::Unread { reason } => {
            let words = format!("The machine code was not read: {reason}");
            vec![holding("p", words).class("note").into()]
        }
        Compiled::Read { compiler, modules } => {
            let words = format!(
                "The functions as {compiler} compiles them. A function is counted with all that it \
                 calls, each once; stack is that of the deepest chain of calls."
            );
            let words = Node::from(holding("p", words));
            std::iter::once(words).chain(modules.iter().map(|one| profile(one).into())).collect()
        }
    }
}

fn profile(module: &Module) -> Element {
    let columns = [
        "Function",
        "Claim",
        "Conditional jumps",
        "Panics",
        "Calls",
        "Instructions",
        "Bytes",
        "Stack, bytes",
    ];
    let mut table = Table::new(&format!("Profile {}", module.profile.name()), columns);
    for Evidence { name, figures, calls, violations, takes_slices } in &module.functions {
        let claim = match (violations.as_slice(), *takes_slices) {
            ([], false) => "flat".to_owned(),
            ([], true) => "loops over states".to_owned(),
            (violations, _) => {
                let all: Vec<String> = violations.iter().map(ToString::to_string).collect();
                format!("broken: {}", all.join("; "))
            }
        };
        let calls: Vec<String> =
            calls.iter().map(|(symbol, count)| format!("{count} {symbol}")).collect();
        let cells = [
            claim,
            figures.conditional_jumps.to_string(),
            figures.panics.to_string(),
            calls.join(", "),
            figures.instructions.to_string(),
            figures.bytes.to_string(),
            figures.stack.to_string(),
        ];
        table.row("", holding("code", name.as_str()), cells);
    }
    table.build()
}

/// States at which the program is held against the numeric solver.
const STATES: usize = 1000;
/// Their seed.
const SEED: u64 = 61;

/// The program's results against those of the numeric solver.
pub(crate) fn accuracy(programs: &Programs) -> Vec<Node> {
    match worst(programs) {
        Ok(worst) => {
            let caption = format!(
                "Straight-line programs against the numeric solver at {STATES} random states (seed \
                 {SEED}; angles in ±π, distances in ±0.5 m, velocities in ±2, accelerations in ±5), \
                 nominal parameters: the largest difference in a component as a share of the largest \
                 component of the result"
            );
            let mut table = Table::new(&caption, ["Function", "Worst error"]);
            for (function, error) in worst {
                table.row(
                    "",
                    holding("code", function),
                    [format!("{error:.1e}").replace('-', "−")],
                );
            }
            vec![table.build().into()]
        }
        Err(reason) => {
            let words = format!("The programs were not held against the numeric solver: {reason}");
            vec![element("p").class("note").with(words).into()]
        }
    }
}

/// The worst relative error of each function.
fn worst(programs: &Programs) -> Result<Vec<(&'static str, f64)>, String> {
    let mechanism = Mechanism::nominal(&programs.robot).map_err(|error| error.to_string())?;
    let interpreter = Interpreter::new(&programs.module, &[]).map_err(|error| error.to_string())?;
    let call = |function: &str, inputs: &[(&str, &[f64])]| -> Result<Vec<f64>, String> {
        let outputs = interpreter.call(function, inputs).map_err(|error| error.to_string())?;
        Ok(outputs.into_iter().flat_map(|output| output.values).collect())
    };
    let mut random = Random::new(SEED);
    // A robot with a singular mass matrix has no forward dynamics.
    let solves = programs.module.function("forward_dynamics").is_some();
    let mut errors = vec![("inverse_dynamics", 0.0f64), ("mass_matrix", 0.0)];
    errors.extend(solves.then_some(("forward_dynamics", 0.0)));
    for _ in 0..STATES {
        let state = random.state(&mechanism);
        let [q, qd, qdd, tau] = [&state.q, &state.qd, &state.qdd, &state.tau].map(Vec::as_slice);
        let failed = |error: robot_dynamics::numeric::NumericError| error.to_string();
        let torques = mechanism.inverse_dynamics(q, qd, qdd).map_err(failed)?;
        let masses = mechanism.mass_matrix(q).map_err(failed)?;
        let mut found = vec![
            (call("inverse_dynamics", &[("q", q), ("qd", qd), ("qdd", qdd)])?, torques.as_slice()),
            // Symmetric, so that its columns are its rows.
            (call("mass_matrix", &[("q", q)])?, masses.as_slice()),
        ];
        let rates;
        if solves {
            rates = mechanism.forward_dynamics(q, qd, tau, &[]).map_err(failed)?;
            let called = call("forward_dynamics", &[("q", q), ("qd", qd), ("tau", tau)])?;
            found.push((called, rates.as_slice()));
        }
        for ((_, error), (values, expected)) in errors.iter_mut().zip(&found) {
            *error = error.max(difference(values, expected));
        }
    }
    Ok(errors)
}

/// The largest difference as a share of the largest expected value.
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
