//! States from JSON: `[{"q": […], "qd": […], "qdd": […], "wrench": […]}, …]`.

use robot_model::diagnostic::quote;

use super::node::Node;
use super::{Layout, State};
use crate::text;

pub(super) fn read(text: &str, layout: &Layout) -> (Vec<State>, Vec<String>) {
    let elements = match serde_json::from_str(text) {
        Ok(Node::Array(elements)) => elements,
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
            Node::Object(object) => states.push(state(place, object, layout, &mut errors)),
            other => errors.push(format!("{place}: expected an object, not {}", other.kind())),
        }
    }
    (states, errors)
}

fn state(
    place: String,
    object: &[(String, Node)],
    layout: &Layout,
    errors: &mut Vec<String>,
) -> State {
    let mut arrays = vec![];
    for (index, (key, value)) in object.iter().enumerate() {
        if object[..index].iter().any(|(earlier, _)| earlier == key) {
            errors.push(format!("{place}: `{}` is given twice", quote(key)));
            continue;
        }
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
fn entries(value: &Node, expected: usize) -> (Vec<f64>, Vec<String>) {
    let Node::Array(elements) = value else {
        return (vec![], vec![format!("is {}, not an array of {expected} numbers", value.kind())]);
    };
    let (mut entries, mut errors) = (vec![], vec![]);
    for (index, element) in elements.iter().enumerate() {
        match element {
            Node::Number(entry) if entry.is_finite() => entries.push(*entry),
            other => {
                errors.push(format!("has {} at entry {}, not a number", other.kind(), index + 1));
            }
        }
    }
    if elements.len() != expected {
        errors.push(format!("has {} entries, not {expected}", elements.len()));
    }
    (entries, errors)
}
