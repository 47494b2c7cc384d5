//! The meaning of the keys and parameters at a place of a robot file in TOML, for editors.

use toml::de::{DeTable, DeValue};

use super::MAX_BYTES;
use super::shape::{Content, Key, PARAMETER, ROBOT_FILE, Shape};
use crate::diagnostic::Span;

/// A key or a parameter at a place of a file.
#[derive(Clone, Debug)]
pub struct Meaning {
    /// The bytes of the name.
    pub span: Span,
    /// The key or the parameter that the name denotes.
    pub subject: Subject,
}

/// The subject of a name at a place of a file.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A key of the format.
    Key(&'static Key),
    /// A parameter of the file, where it is defined or used.
    Parameter(ParameterText),
}

/// A parameter as the file has it; the texts are not checked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ParameterText {
    /// The name.
    pub name: String,
    /// The nominal value, as written.
    pub value: Option<String>,
    /// The unit.
    pub unit: Option<String>,
    /// The explanation.
    pub doc: Option<String>,
}

/// Finds the key or the parameter at a byte of a robot file in TOML, which may have errors. Returns `None` for other
/// places, unknown keys and files that are too large to be read.
#[must_use]
pub fn meaning_at(text: &str, byte: usize) -> Option<Meaning> {
    if text.len() > MAX_BYTES {
        return None;
    }
    let (root, _) = DeTable::parse_recoverable(text);
    Search { text, byte, root: root.get_ref() }.in_table(root.get_ref(), &ROBOT_FILE)
}

struct Search<'t> {
    text: &'t str,
    byte: usize,
    root: &'t DeTable<'t>,
}

impl Search<'_> {
    /// Whether the place is in a span or directly after it.
    fn is_in(&self, span: &Span) -> bool {
        (span.start..=span.end).contains(&self.byte)
    }

    /// Searches a table. The depth is that of the format, not that of the file.
    fn in_table(&self, table: &DeTable<'_>, shape: &'static Shape) -> Option<Meaning> {
        table.iter().find_map(|(name, value)| {
            let key = shape.key(name.get_ref())?;
            if self.is_in(&name.span()) {
                return Some(Meaning { span: name.span(), subject: Subject::Key(key) });
            }
            self.in_value(value.get_ref(), value.span(), key)
        })
    }

    fn in_value(&self, value: &DeValue<'_>, span: Span, key: &'static Key) -> Option<Meaning> {
        match (key.content, value) {
            (
                Content::Table(shape)
                | Content::List(shape)
                | Content::OneOrMany(shape)
                | Content::Components(shape),
                DeValue::Table(table),
            ) => self.in_table(table, shape),
            (Content::Parameters(_), DeValue::Table(table)) => self.in_parameters(table),
            (
                Content::List(_)
                | Content::OneOrMany(_)
                | Content::Components(_)
                | Content::Vector
                | Content::Axis,
                DeValue::Array(entries),
            ) => entries.iter().find_map(|entry| {
                // The span of a table with a header of its own is that of the header.
                let is_header =
                    self.text.get(entry.span()).is_some_and(|text| text.starts_with("[["));
                if is_header && self.is_in(&entry.span()) {
                    return Some(Meaning { span: entry.span(), subject: Subject::Key(key) });
                }
                match entry.get_ref() {
                    DeValue::Array(_) => None,
                    one => self.in_value(one, entry.span(), key),
                }
            }),
            (Content::Formula | Content::Vector | Content::Axis, DeValue::String(_))
                if self.is_in(&span) =>
            {
                self.used()
            }
            _ => None,
        }
    }

    fn in_parameters(&self, table: &DeTable<'_>) -> Option<Meaning> {
        table.iter().find_map(|(name, value)| {
            if self.is_in(&name.span()) {
                let subject = Subject::Parameter(self.parameter(name.get_ref())?);
                return Some(Meaning { span: name.span(), subject });
            }
            match value.get_ref() {
                DeValue::Table(table) => self.in_table(table, &PARAMETER),
                _ => None,
            }
        })
    }

    /// The parameter whose name is at the place, in an expression.
    fn used(&self) -> Option<Meaning> {
        let is_of_name = |one: char| one.is_ascii_alphanumeric() || one == '_';
        let (before, after) = (self.text.get(..self.byte)?, self.text.get(self.byte..)?);
        let start = before.trim_end_matches(is_of_name).len();
        let end = self.text.len() - after.trim_start_matches(is_of_name).len();
        let subject = Subject::Parameter(self.parameter(self.text.get(start..end)?)?);
        Some(Meaning { span: start..end, subject })
    }

    /// The parameter of this name.
    fn parameter(&self, name: &str) -> Option<ParameterText> {
        let DeValue::Table(all) = self.root.get("parameters")?.get_ref() else { return None };
        let found = all.get(name)?;
        let written = |span: Span| self.text.get(span).map(str::to_owned);
        let name = name.to_owned();
        let DeValue::Table(table) = found.get_ref() else {
            return Some(ParameterText {
                name,
                value: written(found.span()),
                ..ParameterText::default()
            });
        };
        let text = |key: &str| match table.get(key)?.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            _ => None,
        };
        let value = table.get("value").and_then(|value| written(value.span()));
        Some(ParameterText { name, value, unit: text("unit"), doc: text("doc") })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARM: &str = "format = 1
[robot]
name = \"arm\"
[parameters]
l1 = { value = 0.35, unit = \"m\", doc = \"Ärm\" }
m1 = 2.5
J = {}
[[link]]
name = \"1\"
joint = { type = \"revolute\", mimic.ratio = 2 }
[link.inertia]
xx = \"m1*l1^2 + Jz\"
[[link]]
origin.xyz = [0, \"l1\", 0]
frob = 1
mass = 
friction = { viscous = \"J\" }
";

    /// The name and what it means at the first occurrence of a text, with an offset.
    fn at(place: &str, offset: usize) -> Option<(&'static str, String)> {
        let byte = ARM.find(place).unwrap() + offset;
        let Meaning { span, subject } = meaning_at(ARM, byte)?;
        let shown = match subject {
            Subject::Key(key) => key.name.to_owned(),
            Subject::Parameter(ParameterText { name, value, unit, doc }) => {
                format!("{name} {value:?} {unit:?} {doc:?}")
            }
        };
        Some((&ARM[span], shown))
    }

    #[test]
    fn keys_and_parameters_have_meanings() {
        let l1 = "l1 Some(\"0.35\") Some(\"m\") Some(\"Ärm\")";
        for (place, offset, expected) in [
            ("format", 0, Some(("format", "format"))),
            ("format", 6, Some(("format", "format"))),
            ("robot]", 2, Some(("robot", "robot"))),
            ("l1 = {", 1, Some(("l1", l1))),
            ("unit =", 3, Some(("unit", "unit"))),
            ("m1 =", 0, Some(("m1", "m1 Some(\"2.5\") None None"))),
            ("[[link]]\nname", 3, Some(("link", "link"))),
            ("[[link]]\norigin", 3, Some(("[[link]]", "link"))),
            ("ratio", 2, Some(("ratio", "ratio"))),
            ("mimic", 2, Some(("mimic", "mimic"))),
            ("inertia", 2, Some(("inertia", "inertia"))),
            ("xx", 1, Some(("xx", "xx"))),
            ("*l1^2", 1, Some(("l1", l1))),
            ("*l1^2", 0, Some(("m1", "m1 Some(\"2.5\") None None"))),
            ("\"l1\"", 2, Some(("l1", l1))),
            ("viscous", 4, Some(("viscous", "viscous"))),
            ("\"J\"", 1, Some(("J", "J None None None"))),
            ("mass = ", 1, Some(("mass", "mass"))),
            ("frob", 1, None),
            ("Jz", 1, None),
            ("arm", 1, None),
            ("= 1", 1, None),
        ] {
            let found = at(place, offset);
            let found = found.as_ref().map(|(name, shown)| (*name, shown.as_str()));
            assert_eq!(found, expected, "{place} + {offset}");
        }
    }

    /// The name of a parameter denotes it in its definition and in expressions, but not in other texts or in comments.
    #[test]
    fn parameters_are_used_in_expressions_alone() {
        let text = "# l1
[parameters]
l1 = 0.35 # l1
[[link]]
name = \"l1\"
origin.xyz = [0, \"2*l1\", 0] # l1
mass = \"l1\"
";
        let places = text.match_indices("l1").map(|(byte, _)| meaning_at(text, byte).is_some());
        assert!(places.eq([false, true, false, false, true, false, true]));
    }

    #[test]
    fn hostile_texts_have_none() {
        let deep = "[".repeat(100_000);
        for text in ["", "é", "<robot/>", "parameters = 1\nrobot = \"x", deep.as_str()] {
            for byte in [0, 1, 5, text.len(), text.len() + 9] {
                assert!(meaning_at(text, byte).is_none_or(|found| found.span.end <= text.len()));
            }
        }
        let long = format!("format = 1 # {}", "x".repeat(MAX_BYTES));
        assert!(meaning_at(&long, 0).is_none());
    }
}
