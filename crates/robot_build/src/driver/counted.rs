//! The operations of the code that a plan leads to.

use robot_dynamics::economical::search::Found;
use robot_model::functions::{Effects, FunctionKind, Functions};
use robot_model::robot::Robot;

use crate::driver::options::Options;
use crate::driver::programs::programs_of;
use crate::error::Errors;

/// The result of a search with the counts of the code. The search itself counts the operations of expressions, of which
/// the code of a robot with parameters needs some fewer.
///
/// # Errors
///
/// If no code can be generated with the plan.
pub fn counted(robot: &Robot, found: Found, snap: Option<f64>) -> Result<Found, Errors> {
    let count = |fused| -> Result<usize, Errors> {
        let options = Options {
            functions: Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]),
            plan: Some(found.plan.clone()),
            snap,
            fused,
            ..Options::default()
        };
        let module = programs_of(robot.clone(), &robot.name, &options)?.module;
        let counts = module.functions.iter().map(|function| module.counts(function).call);
        Ok(counts.map(|counts| counts.operations() - if fused { counts.fused } else { 0 }).sum())
    };
    let [operations, instructions] = [count(false)?, count(true)?];
    Ok(Found { operations, instructions, ..found })
}
