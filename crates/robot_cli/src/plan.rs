//! The plan of the recursion that commands compute under.

use robot_build::{Error, Errors, Options, RobotFile};
use robot_dynamics::economical::search::{Found, Measure, search};
use robot_dynamics::mechanism::MechanismOptions;

use crate::Terminal;
use crate::failure::Failure;
use crate::progress::watched;

/// The options with the plan that is pinned beside the robot file.
///
/// A pin that cannot be taken, because it is stale or no plan, is warned of: what is computed is right under
/// every plan, and one searched for this call is used instead.
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
    let mechanism = MechanismOptions::ROUNDED.with_snap(options.snap, &robot);
    let find = || search(&robot, &mechanism, Measure::Operations);
    let found = watched("searching a plan", terminal, find);
    let instead = match &found {
        Some(Found { operations, .. }) => format!(
            "taken for this call: a plan searched now, under which inverse dynamics takes {operations} operations"
        ),
        None => "taken for this call: the default form".to_owned(),
    };
    writeln!(terminal.errors, "warning: {errors}\n  {instead}; builds refuse the pinned one")?;
    Ok(Options { plan: found.map(|found| found.plan), search: false, ..options })
}

/// Whether all that is wrong is the pin beside the file.
pub(crate) fn is_of_pin(errors: &Errors) -> bool {
    errors.as_slice().iter().all(|error| matches!(error, Error::Pin { .. }))
}
