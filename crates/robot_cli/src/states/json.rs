//! States from JSON: `[{"q": […], "qd": […], "qdd": […], "wrench": […]}, …]`.

use serde_json::{Map, Value};

use super::{Layout, State};
use crate::text;

pub(super) fn read(text: &str, layout: &Layout) -> (Vec<State>, Vec<String>) {
    let elements = match serde_json::from_str(text) {
        Ok(Value::Array(elements)) => elements,
        Ok(_) => {
            let message = "expected an array of states, [{\"q\": […], …}, …]";
            return (vec![], vec![message.to_owned()]);
        }
        Err(error) => return (vec![], vec![format!("this is not JSON: {error}")]),
    };
    let (mut states, mut errors) = (vec![], vec![]);
    for (index, element) in elements.iter().enumerate() {
        let place = format!("state {}", index + 1);
        match element {
            Value::Object(object) => states.push(state(place, object, layout, &mut errors)),
            other => errors.push(format!("{place}: expected an object, not {}", kind(other))),
        }
    }
    (states, errors)
}

fn state(
    place: String,
    object: &Map<String, Value>,
    layout: &Layout,
    errors: &mut Vec<String>,
) -> State {
    let mut arrays = vec![];
    for (key, value) in object {
        let Some(array) = layout.arrays.iter().find(|array| array.name == *key) else {
            errors.push(format!("{place}: {}", text::unknown("key", key, &layout.names())));
            continue;
        };
        let (entries, found) = entries(value, array.columns.len());
        errors.extend(found.into_iter().map(|error| format!("{place}: `{key}` {error}")));
        arrays.push((key.clone(), entries));
    }
    State { place, arrays }
}

/// The numbers, and what is wrong with them.
fn entries(value: &Value, expected: usize) -> (Vec<f64>, Vec<String>) {
    let Value::Array(elements) = value else {
        return (vec![], vec![format!("is {}, not an array of {expected} numbers", kind(value))]);
    };
    let (mut entries, mut errors) = (vec![], vec![]);
    for (index, element) in elements.iter().enumerate() {
        match element.as_f64().filter(|entry| entry.is_finite()) {
            Some(entry) => entries.push(entry),
            None => {
                errors.push(format!("has {} at entry {}, not a number", kind(element), index + 1));
            }
        }
    }
    if elements.len() != expected {
        errors.push(format!("has {} entries, not {expected}", elements.len()));
    }
    (entries, errors)
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "an array",
        Value::Object(_) => "an object",
    }
}
