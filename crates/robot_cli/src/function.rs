//! Names of functions on the command line.

use clap::ValueEnum;
use robot_build::{ALL_FUNCTIONS, Bundle, Error, FunctionKind, Functions, functions::named};
use robot_model::diagnostic::quote;
use robot_model::robot::Robot;

use crate::failure::Failure;

/// Returns an error for each of the names that an option has twice.
pub(crate) fn check_once(option: &str, names: &[String]) -> Result<(), Failure> {
    let is_again = |(index, name): &(usize, &String)| names[..*index].contains(name);
    let again = names.iter().enumerate().filter(is_again);
    let wrong =
        again.map(|(_, name)| format!("{option}: `{}` is given twice; leave one out", quote(name)));
    let wrong: Vec<String> = wrong.collect();
    if wrong.is_empty() { Ok(()) } else { Err(Failure::Usage(wrong)) }
}

/// Does the same as [`check_once`] for values of a fixed list.
pub(crate) fn check_values_once<T: ValueEnum>(option: &str, values: &[T]) -> Result<(), Failure> {
    let names = values.iter().filter_map(T::to_possible_value);
    let names: Vec<String> = names.map(|value| value.get_name().to_owned()).collect();
    check_once(option, &names)
}

/// Finds the functions of a robot with these names.
pub(crate) fn functions(names: &[String], robot: &Robot) -> Result<Functions, Failure> {
    check_once("--function", names)?;
    let (all, names): (Vec<_>, Vec<_>) =
        names.iter().cloned().partition(|name| name == ALL_FUNCTIONS);
    let functions = Functions::listed(!all.is_empty(), kinds(&names, robot)?);
    functions.ok_or_else(|| {
        Failure::Usage(vec![format!("--function: {}", Error::AllFunctionsAndOthers)])
    })
}

/// Makes bundles from names, with the functions of a robot.
pub(crate) fn bundles(
    bundles: &[(String, Vec<String>)],
    robot: &Robot,
) -> Result<Vec<Bundle>, Failure> {
    let bundle = |(name, functions): &(String, Vec<String>)| {
        check_once(&format!("--bundle {}", quote(name)), functions)?;
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
