//! `[parameters]`: the symbols that remain in equations and code.

use robot_symbolic::Rational;
use toml::de::DeValue;

use super::input_limits::MAX_PARAMETERS;
use super::locations::ParameterLocation;
use super::names::Kind;
use super::reader::{Known, Reader};
use super::shape::PARAMETER;
use super::strings;
use super::table::{Table, Value};
use crate::diagnostic::{Diagnostic, code};
use crate::robot::Parameter;
use crate::unit::{Unit, UnitError, known_units};

/// Reads the table and defines its names for the expressions that follow.
pub(super) fn read(
    reader: &mut Reader<'_>,
    root: &mut Table<'_>,
) -> (Vec<Parameter>, Vec<ParameterLocation>) {
    let (mut parameters, mut places) = (Vec::new(), Vec::new());
    let Some(entry) = root.get("parameters") else {
        return (parameters, places);
    };
    let DeValue::Table(keys) = entry.value.get_ref() else {
        reader.wrong_type(entry.value, "a table `[parameters]`");
        return (parameters, places);
    };
    if keys.len() > MAX_PARAMETERS {
        let message =
            format!("at most {MAX_PARAMETERS} parameters are allowed; found {}", keys.len());
        reader.report(
            Diagnostic::error(code::LIMIT, message)
                .at(&entry.key, "this table")
                .help("write values that never change as numbers"),
        );
        return (parameters, places);
    }
    for (key, value) in keys {
        let named = reader.check_name(key.get_ref(), &key.span(), "a parameter", Kind::Identifier);
        let (mut parameter, mut place) = one(reader, value);
        let Some(named) = named else { continue };
        if let Some(diagnostic) = reader.symbols.add(&named) {
            reader.report(diagnostic);
        }
        if let Some(value) = reader.options.value(&named.name) {
            parameter.value = Some(value.clone());
        }
        parameter.name.clone_from(&named.name);
        place.name = named.span.clone();
        reader.define(Known {
            name: named.name,
            span: named.span,
            value: parameter.value.clone(),
            unit: parameter.unit.clone(),
            used: false,
        });
        parameters.push(parameter);
        places.push(place);
    }
    (parameters, places)
}

/// Reads one parameter, except for its name.
fn one(reader: &mut Reader<'_>, value: Value<'_>) -> (Parameter, ParameterLocation) {
    let mut place = ParameterLocation::default();
    let mut parameter =
        Parameter { name: String::new(), value: None, unit: None, latex: None, doc: None };
    match value.get_ref() {
        DeValue::Integer(_) | DeValue::Float(_) => {
            parameter.value = reader.number(value, "a number");
            place.value = Some(value.span());
        }
        DeValue::Table(keys) => {
            let mut table = Table::new(keys, value.span(), &PARAMETER);
            if let Some(entry) = table.get("value") {
                parameter.value = nominal(reader, entry.value);
                place.value = Some(entry.value.span());
            }
            if let Some(entry) = table.get("unit") {
                parameter.unit = unit(reader, entry.value, parameter.value.as_ref());
                place.unit = Some(entry.value.span());
            }
            parameter.latex = table.get("latex").and_then(|entry| reader.latex(entry.value));
            parameter.doc = table.get("doc").and_then(|entry| reader.prose(entry.value));
            table.finish(reader);
        }
        DeValue::String(_) => {
            nominal(reader, value);
        }
        _ => reader.wrong_type(value, "a number, or a table `{ value = 0.35, unit = \"m\" }`"),
    }
    (parameter, place)
}

/// Reads a nominal value. It must be a number, because a value computed from other parameters would not be a parameter.
fn nominal(reader: &mut Reader<'_>, value: Value<'_>) -> Option<Rational> {
    if let DeValue::String(_) = value.get_ref() {
        reader.report(
            Diagnostic::error(code::WRONG_TYPE, "expected a number, found a string")
                .at(&value.span(), "the nominal value is a number")
                .help(
                    "a parameter is a symbol of its own; write the expression over parameters \
                     where the value is used",
                ),
        );
        return None;
    }
    reader.number(value, "a number")
}

fn unit(reader: &mut Reader<'_>, value: Value<'_>, nominal: Option<&Rational>) -> Option<Unit> {
    let text = reader.string(value, "a unit in quotes, such as \"kg m^2\"")?;
    let (file, span) = (reader.text, value.span());
    let place = |range| strings::place(file, &span, text, range);
    let diagnostic = match Unit::parse(text) {
        Ok(unit) => return Some(unit),
        Err(UnitError::Unknown(range, message)) => {
            Diagnostic::error(code::UNIT, message).at(&place(range), "").help(format!(
                "units are products of powers of {}, such as \"kg m^2\" or \"N s/m\"",
                known_units().join(", ")
            ))
        }
        Err(UnitError::NotSi { span, unit, factor }) => {
            let value = nominal.zip(factor.as_ref()).map(|(value, factor)| value * factor);
            let remedy = match (value, factor) {
                (Some(value), _) => {
                    format!("write `value = {}, unit = \"{unit}\"`", decimal(&value))
                }
                (None, Some(factor)) => {
                    format!("write \"{unit}\" and multiply values by {}", decimal(&factor))
                }
                (None, None) => format!(
                    "write \"{unit}\" and convert the values: 1 deg is pi/180 rad, 1 rev is 2*pi rad, 1 rpm is \
                     pi/30 rad/s"
                ),
            };
            Diagnostic::error(code::UNIT_NOT_SI, "this unit is not a coherent SI unit")
                .at(&place(span), "not coherent")
                .because("values are never converted silently")
                .help(remedy)
        }
    };
    reader.report(diagnostic);
    None
}

/// A number as text: a decimal if it is a short one, otherwise a fraction.
fn decimal(value: &Rational) -> String {
    let float = value.to_f64().to_string();
    match Rational::from_decimal(&float) {
        Some(same) if same == *value => float,
        _ => value.to_string(),
    }
}
