//! Differences between the operations of two robots' functions.

use robot_build::{Functions, Options as CodeOptions, programs_of};
use robot_model::robot::Robot;

use crate::difference::{Options, Refusal};

/// A function whose number of operations differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operations {
    /// The name of the function.
    pub function: String,
    /// The multiplications, additions and divisions of a call for each robot; `None` if the robot does not have the
    /// function.
    pub counts: [Option<usize>; 2],
}

/// The functions whose numbers of operations differ, in the order of the first robot.
pub(crate) fn differing(
    a: &Robot,
    b: &Robot,
    options: &Options,
) -> Result<Vec<Operations>, Refusal> {
    let [of_a, of_b] = &options.code;
    let (before, after) = (counted(a, of_a)?, counted(b, of_b)?);
    let of = |counts: &[(String, usize)], name: &str| {
        counts.iter().find(|(function, _)| function == name).map(|(_, count)| *count)
    };
    let added = after.iter().filter(|(name, _)| of(&before, name).is_none());
    let names = before.iter().chain(added).map(|(name, _)| name);
    let all = names.map(|name| Operations {
        function: name.clone(),
        counts: [of(&before, name), of(&after, name)],
    });
    Ok(all.filter(|one| one.counts[0] != one.counts[1]).collect())
}

/// The number of operations of a call of each function.
fn counted(robot: &Robot, options: &CodeOptions) -> Result<Vec<(String, usize)>, Refusal> {
    let options = CodeOptions { functions: Functions::All, bundles: vec![], ..options.clone() };
    let programs =
        programs_of(robot.clone(), &robot.name, &options).map_err(|errors| errors.to_string())?;
    let module = &programs.module;
    let count = |function| module.counts(function).call.operations();
    Ok(module.functions.iter().map(|one| (one.name.clone(), count(one))).collect())
}
