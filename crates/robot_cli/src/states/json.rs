//! States from JSON, read one element at a time: `[{"q": […], "qd": […], "qdd": […], "wrench": […]}, …]`.

use std::fmt;
use std::io::Read;
use std::ops::ControlFlow;

use robot_model::diagnostic::quote;
use serde::de::{Deserialize, DeserializeSeed, Deserializer, IgnoredAny, SeqAccess, Visitor};
use serde_json::error::Category;

use super::input::Budget;
use super::node::Node;
use super::{Layout, Place, Sink, State};
use crate::failure::Failure;
use crate::text;

/// Reads the states; `is_array` is whether the text starts as an array.
pub(super) fn read<'l>(
    text: impl Read,
    is_array: bool,
    budget: &Budget,
    layout: &'l Layout,
    sink: &mut dyn Sink<'l>,
) -> Result<(), Failure> {
    let mut json = serde_json::Deserializer::from_reader(text);
    let mut elements = Elements { layout, sink, budget, has_stopped: false };
    let read = match is_array {
        true => (&mut elements).deserialize(&mut json),
        false => IgnoredAny::deserialize(&mut json).map(|_| ()),
    };
    let has_stopped = elements.has_stopped;
    match read.and_then(|()| if has_stopped { Ok(()) } else { json.end() }) {
        Ok(()) if is_array => {}
        Ok(()) => sink.no_states("expected an array of states, [{\"q\": […], …}, …]".to_owned()),
        Err(_) if has_stopped => {}
        Err(error) if error.classify() == Category::Io => {
            return Err(Failure::input(std::io::Error::from(error).to_string()));
        }
        Err(error) => sink.no_states(fault(&error)),
    }
    Ok(())
}

/// The message for a text that cannot be read as JSON.
fn fault(error: &serde_json::Error) -> String {
    let place = format!("line {}, column {}", error.line(), error.column());
    let text = error.to_string();
    let text = text.split(" at line ").next().unwrap_or_default();
    match text {
        "recursion limit exceeded" => {
            format!("brackets are nested too deeply at {place}; expected an array of states")
        }
        "number out of range" => format!("the number at {place} is too large"),
        _ if error.is_eof() => {
            format!("the text ends too early, at {place}; close all brackets and quotes")
        }
        _ => format!("this is not JSON at {place}: {text}"),
    }
}

/// Reads the elements of an array and passes them to the sink one by one.
struct Elements<'l, 's> {
    layout: &'l Layout,
    sink: &'s mut dyn Sink<'l>,
    budget: &'s Budget,
    has_stopped: bool,
}

impl<'de> DeserializeSeed<'de> for &mut Elements<'_, '_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for &mut Elements<'_, '_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an array of states")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<(), A::Error> {
        let mut given = State::new(self.layout);
        let mut number = 1;
        while let Some(element) = elements.next_element()? {
            let place = Place::Element(number);
            number += 1;
            self.budget.renew(number);
            let Node::Object(object) = element else {
                self.sink.error(format!("{place}: expected an object, not {}", element.kind()));
                continue;
            };
            given.clear(place);
            state(&object, self.layout, &mut given, self.sink);
            if let ControlFlow::Break(()) = self.sink.state(&mut given) {
                self.has_stopped = true;
                return Ok(());
            }
        }
        Ok(())
    }
}

/// Sets the arrays of a state from an object.
fn state<'l>(
    object: &[(String, Node)],
    layout: &'l Layout,
    state: &mut State<'l>,
    sink: &mut dyn Sink<'l>,
) {
    let place = state.place;
    for (index, (key, value)) in object.iter().enumerate() {
        if object[..index].iter().any(|(earlier, _)| earlier == key) {
            sink.error(format!("{place}: `{}` is given twice; leave one out", quote(key)));
            continue;
        }
        let Some(index) = layout.position(key) else {
            let meant = text::meant(key, &layout.names());
            sink.error(format!("{place}: unknown key `{}`.{meant}", quote(key)));
            continue;
        };
        let found = entries(value, layout.arrays[index].columns.len(), state.begin_array(index));
        found.into_iter().for_each(|error| sink.error(format!("{place}: `{key}` {error}")));
    }
}

/// Stores the numbers in `entries`; returns their errors.
fn entries(value: &Node, expected: usize, entries: &mut Vec<f64>) -> Vec<String> {
    let Node::Array(elements) = value else {
        return vec![format!("is {}, not an array of {expected} numbers", value.kind())];
    };
    let mut errors = vec![];
    for (index, element) in elements.iter().enumerate() {
        match element {
            Node::Number(entry) if entry.is_finite() => entries.push(*entry),
            other => {
                errors.push(format!("has {} at entry {}, not a number", other.kind(), index + 1));
            }
        }
    }
    if elements.len() != expected {
        let count = elements.len();
        let words = if count == 1 { "entry" } else { "entries" };
        errors.push(format!("has {count} {words}, not {expected}"));
    }
    errors
}
