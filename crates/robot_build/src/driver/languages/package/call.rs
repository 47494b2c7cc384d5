//! Calls at the check states in scripting languages.

use robot_codegen::backend::flat::{Function, Tree};

use super::Parts;
use crate::driver::check::CheckValue;

/// Returns the functions that have check values, with these values.
pub(super) fn checked<'t>(
    parts: &'t Parts<'_>,
    tree: &'t Tree<'_>,
) -> impl Iterator<Item = (&'t Function<'t>, &'t CheckValue)> {
    parts.checks.iter().filter_map(|check| {
        let mut functions = tree.functions.iter();
        Some((functions.find(|function| function.source.name == check.function)?, check))
    })
}

/// Prints numbers such as `1.0, -0.5`.
pub(super) fn numbers(values: &[f64], separator: &str) -> String {
    let values = values.iter().map(|value| format!("{value:?}"));
    values.collect::<Vec<_>>().join(separator)
}

/// Prints the arguments of a call: the model if there are parameters, and the inputs of the check value, each as an
/// array in these brackets.
pub(super) fn arguments(
    tree: &Tree<'_>,
    check: &CheckValue,
    brackets: [&str; 2],
    separator: &str,
) -> String {
    let [open, close] = brackets;
    let model = tree.has_parameters().then(|| "model".to_owned());
    let inputs = check
        .inputs
        .iter()
        .map(|(_, values)| format!("{open}{}{close}", numbers(values, separator)));
    model.into_iter().chain(inputs).collect::<Vec<_>>().join(", ")
}
