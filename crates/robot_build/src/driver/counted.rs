//! The operations of the code that a plan leads to.

use robot_codegen::Counts;
use robot_dynamics::economical::search::Found;
use robot_model::functions::{Effects, FunctionKind, Functions};
use robot_model::robot::Robot;

use crate::driver::options::Options;
use crate::driver::programs::{Programs, programs_of};
use crate::error::Errors;

/// The result of a search with the counts of the code. The search itself counts the operations of expressions, of which
/// the code of a robot with parameters needs some fewer.
///
/// # Errors
///
/// If no code can be generated with the plan.
pub fn counted(robot: &Robot, found: Found, snap: Option<f64>) -> Result<Found, Errors> {
    let count = |fused| {
        let plan = Some(found.plan.clone());
        inverse_dynamics(robot, Options { plan, snap, fused, ..Options::default() })
    };
    let (operations, fused) = (count(false)?.1.operations(), count(true)?.1);
    Ok(Found { operations, instructions: fused.operations() - fused.fused, ..found })
}

/// The programs of inverse dynamics with these options, and the counts of a call.
pub(super) fn inverse_dynamics(
    robot: &Robot,
    options: Options,
) -> Result<(Programs, Counts), Errors> {
    let functions = Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]);
    let programs = programs_of(robot.clone(), &robot.name, &Options { functions, ..options })?;
    let module = &programs.module;
    let counts = module.functions.first().map(|function| module.counts(function).call);
    Ok((programs, counts.unwrap_or_default()))
}
