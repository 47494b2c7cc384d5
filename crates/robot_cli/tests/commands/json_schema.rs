//! Validation by those keywords of JSON Schema (draft 7) that the schema of robot files uses. Crates that
//! support all keywords have fifty dependencies.

use regex_lite::Regex;
use serde_json::Value;

/// Checks that `value`, which is at `place`, is valid by `schema`; the error names the place and the reason. A keyword
/// that is not supported here fails the test.
pub(crate) fn validate(schema: &Value, value: &Value, place: &str) -> Result<(), String> {
    for (keyword, rule) in schema.as_object().unwrap() {
        let properties = schema.get("properties");
        if !holds(keyword, rule, value, properties, place)? {
            return Err(format!("{place}: {value} breaks `{keyword}`: {rule}"));
        }
    }
    Ok(())
}

/// Checks rules for the entries of a table and for the elements of a list.
fn parts_hold(
    keyword: &str,
    rule: &Value,
    value: &Value,
    properties: Option<&Value>,
    place: &str,
) -> Result<(), String> {
    match (keyword, value) {
        ("properties", Value::Object(table)) => {
            for (key, rule) in rule.as_object().unwrap() {
                if let Some(value) = table.get(key) {
                    validate(rule, value, &format!("{place}.{key}"))?;
                }
            }
        }
        ("additionalProperties", Value::Object(table)) => {
            for (key, value) in table {
                if properties.is_some_and(|known| known.get(key).is_some()) {
                    continue;
                }
                match rule {
                    Value::Bool(allowed) if !allowed => {
                        return Err(format!("{place}.{key} is not known"));
                    }
                    Value::Bool(_) => {}
                    rule => validate(rule, value, &format!("{place}.{key}"))?,
                }
            }
        }
        ("propertyNames", Value::Object(table)) => {
            for key in table.keys() {
                validate(rule, &Value::String(key.clone()), place)?;
            }
        }
        ("items", Value::Array(values)) => {
            for (index, value) in values.iter().enumerate() {
                validate(rule, value, &format!("{place}[{index}]"))?;
            }
        }
        _ => {}
    }
    Ok(())
}

/// Checks rules for the value itself. According to the standard, rules for other types than the value's hold.
fn holds(
    keyword: &str,
    rule: &Value,
    value: &Value,
    properties: Option<&Value>,
    place: &str,
) -> Result<bool, String> {
    let count = || usize::try_from(rule.as_u64().unwrap()).unwrap();
    Ok(match (keyword, value) {
        ("$schema" | "$comment" | "title" | "description", _) => true,
        ("type", _) => match rule {
            Value::Array(types) => types.iter().any(|one| is_of_type(one, value)),
            one => is_of_type(one, value),
        },
        ("const", _) => value == rule,
        ("enum", _) => rule.as_array().unwrap().contains(value),
        ("anyOf", _) => {
            rule.as_array().unwrap().iter().any(|one| validate(one, value, place).is_ok())
        }
        ("required", Value::Object(table)) => {
            rule.as_array().unwrap().iter().all(|key| table.contains_key(key.as_str().unwrap()))
        }
        ("properties" | "additionalProperties" | "propertyNames", Value::Object(_))
        | ("items", Value::Array(_)) => {
            parts_hold(keyword, rule, value, properties, place)?;
            true
        }
        ("minItems", Value::Array(values)) => values.len() >= count(),
        ("maxItems", Value::Array(values)) => values.len() <= count(),
        ("uniqueItems", Value::Array(values)) => {
            let is_first = |(index, value): (usize, &Value)| !values[..index].contains(value);
            values.iter().enumerate().all(is_first)
        }
        ("minimum", Value::Number(number)) => number.as_f64() >= rule.as_f64(),
        ("minLength", Value::String(text)) => text.chars().count() >= count(),
        ("pattern", Value::String(text)) => {
            Regex::new(rule.as_str().unwrap()).unwrap().is_match(text)
        }
        (
            "required"
            | "properties"
            | "additionalProperties"
            | "propertyNames"
            | "items"
            | "minItems"
            | "maxItems"
            | "uniqueItems"
            | "minimum"
            | "minLength"
            | "pattern",
            _,
        ) => true,
        (other, _) => panic!("the keyword `{other}` is not known here"),
    })
}

fn is_of_type(name: &Value, value: &Value) -> bool {
    match name.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        "boolean" => value.is_boolean(),
        other => panic!("the type `{other}` is not known here"),
    }
}
