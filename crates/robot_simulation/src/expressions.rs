//! Named expressions from text: `q1 = sin(t)`.

use std::collections::BTreeMap;

use robot_model::diagnostic::quote;
use robot_model::robot::Robot;
use robot_symbolic::Formula;

/// The values of a robot's parameters: those that `given` names, the others nominal.
pub(crate) fn parameters(robot: &Robot, given: &[(&str, f64)]) -> BTreeMap<String, f64> {
    let nominal = robot
        .parameters
        .iter()
        .filter_map(|parameter| Some((parameter.name.clone(), parameter.value.as_ref()?.to_f64())));
    let given = given.iter().map(|(name, value)| ((*name).to_owned(), *value));
    nominal.chain(given).collect()
}

/// `NAME = FORMULA`, the formula's names among those that `is_known` knows; `known` says which these
/// are. What is wrong is a message.
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
        let help = error.help.map(|help| format!("; {help}")).unwrap_or_default();
        format!("`{shown}`: {}{help}", error.message)
    })?;
    let unknown = formula.symbols().map(|(name, _)| name).find(|name| !is_known(name));
    if let Some(unknown) = unknown {
        let unknown = quote(unknown);
        return Err(format!("`{shown}`: `{unknown}` is not known here; known are {known}"));
    }
    Ok((name.trim(), formula))
}
