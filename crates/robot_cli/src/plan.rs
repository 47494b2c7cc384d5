//! The plan of the recursion with which commands compute.

use robot_build::{Error, Errors, Options, RobotFile, search_code};
use robot_dynamics::economical::search::{Found, Measure};

use crate::Terminal;
use crate::failure::{Failure, in_command_words};
use crate::progress::watched;

/// Returns the options with the pinned plan of the robot file.
///
/// If the pinned plan cannot be used, because it is stale or invalid, a warning is printed and a plan is searched for
/// this call. Results are correct with any plan.
pub(crate) fn pinned_or_searched(
    file: &RobotFile,
    options: Options,
    terminal: &mut Terminal<'_>,
) -> Result<Options, Failure> {
    let errors = match file.with_pin(&options) {
        Ok(options) => return Ok(options),
        Err(errors) => errors,
    };
    if !is_of_pin(&errors) {
        return Err(errors.into());
    }
    let robot = robot_build::read_with(&file.source, &options)?.robot;
    let find = || search_code(&robot, Measure::Operations, options.snap);
    let found = watched("searching for a plan", terminal, find)?;
    let instead = match &found {
        Some(Found { operations, .. }) => format!(
            "using a plan from a new search, with which inverse dynamics takes {operations} \
             operations"
        ),
        None => "using the default form".to_owned(),
    };
    let shown: Vec<String> = errors.as_slice().iter().map(in_command_words).collect();
    let shown = shown.join("\n");
    writeln!(terminal.errors, "warning: {shown}\n  {instead}; builds refuse the pinned plan")?;
    Ok(Options { plan: found.map(|found| found.plan), search: false, ..options })
}

/// Whether all errors concern the pinned plan.
pub(crate) fn is_of_pin(errors: &Errors) -> bool {
    errors.as_slice().iter().all(|error| matches!(error, Error::Pin { .. }))
}
