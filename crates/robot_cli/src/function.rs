//! Names of functions on the command line.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use robot_build::{ALL_FUNCTIONS, Bundle, FunctionKind, Functions, functions::named};
use robot_model::robot::Robot;

use crate::failure::Failure;

/// Takes any name, for the robot says which frames there are, and lists the functions of all robots in help
/// and completions.
#[derive(Clone, Copy)]
pub(crate) struct FunctionName {
    /// Whether the word for all functions may stand.
    pub(crate) all: bool,
}

impl TypedValueParser for FunctionName {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let kinds = FunctionKind::ALL.iter().map(|kind| kind.name());
        let names = kinds.chain(self.all.then_some(ALL_FUNCTIONS));
        Some(Box::new(names.map(PossibleValue::new)))
    }
}

/// The functions of a robot of those names.
pub(crate) fn functions(names: &[String], robot: &Robot) -> Result<Functions, Failure> {
    let (all, names): (Vec<_>, Vec<_>) =
        names.iter().cloned().partition(|name| name == ALL_FUNCTIONS);
    let kinds = kinds(&names, robot)?;
    Ok(if all.is_empty() { Functions::Chosen(kinds) } else { Functions::All })
}

/// The bundles, their functions those of a robot.
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
