//! The operations of the code that a plan leads to.

use robot_codegen::Counts;
use robot_dynamics::economical::search::{Found, Measure, search};
use robot_model::functions::{Effects, FunctionKind, Functions};
use robot_model::robot::Robot;

use crate::driver::options::Options;
use crate::driver::programs::{Programs, programs_of};
use crate::error::Errors;

/// Searches for the plan whose code is cheapest; the result has the counts of the code. `None` if the economical
/// recursion does not apply because a joint axis depends on parameters.
///
/// Which products the code joins with a sum is known when the code is compiled. Of the plans with the fewest
/// instructions and with the fewest operations of expressions, the one whose code has fewer instructions is therefore the
/// result if instructions are counted.
///
/// # Errors
///
/// If no code can be generated with the plan.
pub fn search_code(
    robot: &Robot,
    measure: Measure,
    snap: Option<f64>,
) -> Result<Option<Found>, Errors> {
    let options = Options { snap, ..Options::default() }.mechanism(robot);
    let searched = |measure| search(robot, &options, measure);
    let Some(found) = searched(measure) else { return Ok(None) };
    let found = counted(robot, found, snap)?;
    if measure == Measure::Operations {
        return Ok(Some(found));
    }
    let Some(other) = searched(Measure::Operations) else { return Ok(Some(found)) };
    let tried = found.tried + other.tried;
    let cut_short = found.cut_short || other.cut_short;
    let other = counted(robot, other, snap)?;
    let cheaper = if other.instructions < found.instructions { other } else { found };
    Ok(Some(Found { measure, tried, cut_short, ..cheaper }))
}

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

#[cfg(test)]
mod tests {
    use super::*;

    /// The form with the fewest multiply-adds of expressions has more of them in the code than the usual one.
    #[test]
    fn fewer_instructions_are_those_of_the_code() {
        let text = "format = 1\n[robot]\nname = \"skew\"\ngravity = [0, \"-g\", 0]\n\
             [parameters]\ng = 9.81\nm1 = 1\nm2 = 1.5\n\
             [[link]]\nname = \"1\"\njoint = { type = \"revolute\", axis = [1, 1, 0] }\n\
             origin = { xyz = [0.2, 0.1, 0.2] }\nmass = \"m1\"\ncenter_of_mass = [0.1, -0.05, 0.1]\n\
             inertia = { xx = 0.3, yy = 0.35, zz = 0.4 }\n\
             [[link]]\nname = \"2\"\njoint = { type = \"revolute\", axis = [0, 0.6, 0.8] }\n\
             origin = { xyz = [0, 0.1, 0.3] }\nmass = \"m2\"\ncenter_of_mass = [0.2, 0, 0]\n\
             inertia = { xx = 0.3, yy = 0.35, zz = 0.4 }\n";
        let robot = robot_model::description::read("skew.toml", text).unwrap().robot;
        let found = |measure| search_code(&robot, measure, None).unwrap().unwrap();
        let (usual, fewest) = (found(Measure::Operations), found(Measure::Instructions));
        let options = Options::default().mechanism(&robot);
        let of_expressions = search(&robot, &options, Measure::Instructions).unwrap();
        let of_expressions = counted(&robot, of_expressions, None).unwrap();
        assert!(usual.instructions < of_expressions.instructions);
        assert_eq!(fewest.instructions, usual.instructions);
        assert_eq!(fewest.measure, Measure::Instructions);
    }
}
