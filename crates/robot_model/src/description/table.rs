//! A table of the file, read key by key; what is left over is an error.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::reader::Reader;
use super::shape::{Presence, Shape};
use crate::diagnostic::{Diagnostic, Span, code, quote};

/// A value of the file with its place.
pub(super) type Value<'a> = &'a Spanned<DeValue<'a>>;

/// A key of a table with its value.
#[derive(Clone)]
pub(super) struct Entry<'a> {
    pub(super) key: Span,
    pub(super) value: Value<'a>,
}

/// A table that is being read.
pub(super) struct Table<'a> {
    keys: &'a DeTable<'a>,
    /// The braces of an inline table, or the header of any other.
    pub(super) span: Span,
    shape: &'static Shape,
    known: Vec<&'static str>,
}

impl<'a> Table<'a> {
    pub(super) fn new(keys: &'a DeTable<'a>, span: Span, shape: &'static Shape) -> Table<'a> {
        Table { keys, span, shape, known: Vec::new() }
    }

    /// The value of a key, which is known from now on.
    pub(super) fn get(&mut self, key: &'static str) -> Option<Entry<'a>> {
        debug_assert!(self.shape.key(key).is_some(), "{} has no `{key}`", self.shape.what);
        self.misplaced(key)
    }

    /// The value of a key that has no place in the table, of which more can be said than that it is
    /// not known.
    pub(super) fn misplaced(&mut self, key: &'static str) -> Option<Entry<'a>> {
        self.known.push(key);
        self.keys.get_key_value(key).map(|(key, value)| Entry { key: key.span(), value })
    }

    /// The number of keys, known or not.
    pub(super) fn len(&self) -> usize {
        self.keys.len()
    }

    /// Whether the key is there, without making it known.
    pub(super) fn has(&self, key: &str) -> bool {
        self.keys.contains_key(key)
    }

    /// The value of a key that must be there. `example` is the line to add.
    pub(super) fn require(
        &mut self,
        reader: &mut Reader<'_>,
        key: &'static str,
        example: &str,
    ) -> Option<Entry<'a>> {
        self.require_with(reader, key, &format!("add `{example}`"))
    }

    /// The value of a key that must be there, with what to do if it is not.
    pub(super) fn require_with(
        &mut self,
        reader: &mut Reader<'_>,
        key: &'static str,
        help: &str,
    ) -> Option<Entry<'a>> {
        debug_assert!(
            self.shape.key(key).is_some_and(|key| key.presence != Presence::Optional),
            "`{key}` of {} is optional",
            self.shape.what
        );
        let entry = self.get(key);
        if entry.is_none() {
            reader.report(
                Diagnostic::error(
                    code::MISSING_KEY,
                    format!("{} must have `{key}`", self.shape.what),
                )
                .at(&self.span, format!("`{key}` is missing"))
                .help(help),
            );
        }
        entry
    }

    /// Reports the keys that nobody asked for.
    pub(super) fn finish(self, reader: &mut Reader<'_>) {
        for (key, _) in self.keys {
            let name = key.get_ref().as_ref();
            if self.known.contains(&name) {
                continue;
            }
            let absent = |known: &&str| !self.keys.contains_key(*known);
            let near = reader.nearest(name, self.known.iter().copied().filter(absent));
            let label = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => "unknown key".to_owned(),
            };
            let message = format!("`{}` is not a key of {}", quote(name), self.shape.what);
            reader.report(
                Diagnostic::error(code::UNKNOWN_KEY, message).at(&key.span(), label).help(format!(
                    "the keys of {} are {}",
                    self.shape.what,
                    list(&self.known)
                )),
            );
        }
    }
}

/// `a`, `b` and `c`, each once.
pub(super) fn list(words: &[&str]) -> String {
    let mut quoted: Vec<String> = Vec::new();
    for word in words {
        let word = format!("`{word}`");
        if !quoted.contains(&word) {
            quoted.push(word);
        }
    }
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => "none".to_owned(),
    }
}
