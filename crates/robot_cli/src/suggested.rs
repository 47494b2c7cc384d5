//! Values of options that help and completions list, but that the command checks itself.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use robot_build::{ALL_FUNCTIONS, FunctionKind};
use robot_dynamics::quantity::Kind;
use robot_model::diagnostic::code;

/// A parser that accepts any word, because the command gives a better message about a wrong one than a fixed list.
#[derive(Clone, Copy)]
pub(crate) struct Suggested(fn() -> Vec<PossibleValue>);

/// The names of functions. Functions of single frames depend on the robot and are not listed.
pub(crate) const FUNCTION: Suggested =
    Suggested(|| FunctionKind::ALL.iter().map(|kind| PossibleValue::new(kind.name())).collect());

/// The names of functions, and the word for all.
pub(crate) const FUNCTIONS: Suggested =
    Suggested(|| [(FUNCTION.0)(), vec![PossibleValue::new(ALL_FUNCTIONS)]].concat());

/// The names of quantities of the equations, and the word for all.
pub(crate) const QUANTITY: Suggested = Suggested(|| {
    let names = Kind::ALL.iter().map(|kind| kind.name());
    names.chain(["all"]).map(PossibleValue::new).collect()
});

/// The codes of diagnostics, with their titles.
pub(crate) const CODE: Suggested = Suggested(|| {
    code::TABLE.iter().map(|(code, title)| PossibleValue::new(*code).help(*title)).collect()
});

impl TypedValueParser for Suggested {
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
        Some(Box::new((self.0)().into_iter()))
    }
}
