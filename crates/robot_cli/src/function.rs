//! Names of functions on the command line.

use robot_build::{ALL_FUNCTIONS, Bundle, FunctionKind, Functions, functions::named};
use robot_model::robot::Robot;

use crate::failure::Failure;

/// Finds the functions of a robot with these names.
pub(crate) fn functions(names: &[String], robot: &Robot) -> Result<Functions, Failure> {
    let (all, names): (Vec<_>, Vec<_>) =
        names.iter().cloned().partition(|name| name == ALL_FUNCTIONS);
    let kinds = kinds(&names, robot)?;
    Ok(if all.is_empty() { Functions::Chosen(kinds) } else { Functions::All })
}

/// Makes bundles from names, with the functions of a robot.
pub(crate) fn bundles(
    bundles: &[(String, Vec<String>)],
    robot: &Robot,
) -> Result<Vec<Bundle>, Failure> {
    let bundle = |(name, functions): &(String, Vec<String>)| {
        Ok(Bundle { name: name.clone(), functions: kinds(functions, robot)? })
    };
    bundles.iter().map(bundle).collect()
}

fn kinds(names: &[String], robot: &Robot) -> Result<Vec<FunctionKind>, Failure> {
    let (mut kinds, mut wrong) = (vec![], vec![]);
    for name in names {
        match named(robot, name) {
            Ok(kind) => kinds.push(kind),
            Err(error) => wrong.push(error.to_string()),
        }
    }
    if wrong.is_empty() { Ok(kinds) } else { Err(Failure::Usage(wrong)) }
}
