//! Assignments of expressions, given as text: `q1 = sin(t)`.

use std::collections::BTreeMap;

use robot_model::description::undefined;
use robot_model::diagnostic::quote;
use robot_model::robot::Robot;
use robot_symbolic::Formula;

/// The values of a robot's parameters: those in `given`, and the nominal values of the others.
pub(crate) fn parameters(robot: &Robot, given: &[(&str, f64)]) -> BTreeMap<String, f64> {
    let nominal = robot
        .parameters
        .iter()
        .filter_map(|parameter| Some((parameter.name.clone(), parameter.value.as_ref()?.to_f64())));
    let given = given.iter().map(|(name, value)| ((*name).to_owned(), *value));
    nominal.chain(given).collect()
}

/// Reads `NAME = FORMULA`. The names in the formula must satisfy `is_known`; `known` describes the allowed names in the
/// message for other ones.
pub(crate) fn assignment<'t>(
    text: &'t str,
    is_known: impl Fn(&str) -> bool,
    known: &str,
) -> Result<(&'t str, Formula), String> {
    let shown = quote(text);
    let Some((name, formula)) = text.split_once('=') else {
        return Err(format!("`{shown}` is not an assignment; write NAME = EXPRESSION"));
    };
    let formula = Formula::parse(formula.trim()).map_err(|error| {
        let help = match formula.contains('=') {
            true => Some("give each assignment by itself".to_owned()),
            false => error.help,
        };
        let help = help.map(|help| format!("; {help}")).unwrap_or_default();
        format!("`{shown}`: {}{help}", error.message)
    })?;
    let unknown = formula.symbols().map(|(name, _)| name).find(|name| !is_known(name));
    if let Some(unknown) = unknown {
        let unknown = quote(unknown);
        return Err(format!(
            "`{shown}`: `{unknown}` is not known here; the known names are {known}"
        ));
    }
    if let Some(reason) = undefined(&formula) {
        return Err(format!("`{shown}` does not have a value: {reason}"));
    }
    Ok((name.trim(), formula))
}
