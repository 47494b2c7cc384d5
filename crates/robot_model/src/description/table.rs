//! A table of the file that is read key by key; keys that remain unread are errors.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::reader::Reader;
use super::shape::{Presence, Shape};
use crate::diagnostic::{Diagnostic, Span, code, quote};

/// A value of the file with its place.
pub(super) type Value<'a> = &'a Spanned<DeValue<'a>>;

/// A key of a table, with its value.
#[derive(Clone)]
pub(super) struct Entry<'a> {
    pub(super) key: Span,
    pub(super) value: Value<'a>,
}

/// A table that is being read.
pub(super) struct Table<'a> {
    keys: &'a DeTable<'a>,
    /// The place of the braces of an inline table, or of the header of any other table.
    pub(super) span: Span,
    shape: &'static Shape,
    known: Vec<&'static str>,
}

impl<'a> Table<'a> {
    pub(super) fn new(keys: &'a DeTable<'a>, span: Span, shape: &'static Shape) -> Table<'a> {
        Table { keys, span, shape, known: Vec::new() }
    }

    /// The value of a key. The key counts as known from now on.
    pub(super) fn get(&mut self, key: &'static str) -> Option<Entry<'a>> {
        debug_assert!(self.shape.key(key).is_some(), "{} has no `{key}`", self.shape.what);
        self.misplaced(key)
    }

    /// The value of a key that does not belong in the table, so that a more helpful message than "unknown key" is
    /// possible.
    pub(super) fn misplaced(&mut self, key: &'static str) -> Option<Entry<'a>> {
        self.known.push(key);
        self.keys.get_key_value(key).map(|(key, value)| Entry { key: key.span(), value })
    }

    /// The number of keys, whether known or not.
    pub(super) fn len(&self) -> usize {
        self.keys.len()
    }

    /// Whether the table has the key. The key does not become known by this.
    pub(super) fn has(&self, key: &str) -> bool {
        self.keys.contains_key(key)
    }

    /// Whether the value of a key is a table that has another key. Neither key becomes known by this.
    pub(super) fn has_within(&self, key: &str, inner: &str) -> bool {
        let value = self.keys.get(key).map(Spanned::get_ref);
        matches!(value, Some(DeValue::Table(table)) if table.contains_key(inner))
    }

    /// Whether the table has an unknown key in place of this one, such as `masss`, which is reported as an unknown key.
    pub(super) fn misspells(&self, reader: &Reader<'_>, key: &str) -> bool {
        let absent = self.shape.keys.iter().map(|known| known.name).filter(|name| !self.has(name));
        let absent: Vec<&str> = absent.collect();
        self.keys.iter().any(|(written, _)| {
            let written = written.get_ref().as_ref();
            let is_unknown = self.shape.key(written).is_none();
            is_unknown && reader.nearest(written, absent.iter().copied()) == Some(key)
        })
    }

    /// The value of a required key. `example` is the line to add if it is missing.
    pub(super) fn require(
        &mut self,
        reader: &mut Reader<'_>,
        key: &'static str,
        example: &str,
    ) -> Option<Entry<'a>> {
        self.require_with(reader, key, &format!("add `{example}`"))
    }

    /// The value of a required key. `help` is the remedy if it is missing.
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
        if entry.is_none() && !self.misspells(reader, key) {
            reader.report(
                Diagnostic::error(
                    code::MISSING_KEY,
                    format!("{} must have the key `{key}`", self.shape.what),
                )
                .at(&self.span, format!("`{key}` is missing"))
                .help(help),
            );
        }
        entry
    }

    /// Reports the keys of the table that are not known.
    pub(super) fn finish(self, reader: &mut Reader<'_>) {
        let is_own = |known: &&str| self.shape.key(known).is_some();
        let own: Vec<&str> = self.known.iter().copied().filter(is_own).collect();
        for (key, _) in self.keys {
            let name = key.get_ref().as_ref();
            if self.known.contains(&name) {
                continue;
            }
            let absent = |known: &&str| !self.keys.contains_key(*known);
            let near = reader.nearest(name, own.iter().copied().filter(absent));
            let label = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => "unknown key".to_owned(),
            };
            let what = self.shape.what;
            let message = format!("`{}` is not a key of {what}", quote(name));
            let help = match own.as_slice() {
                [only] => format!("the only key of {what} is `{only}`"),
                known => format!("the keys of {what} are {}", list(known)),
            };
            let help = match self.shape.owners(name).as_slice() {
                owners @ [_, ..] if near.is_none() => {
                    format!("`{name}` is a key of {}; {help}", owners.join(" and "))
                }
                _ => help,
            };
            let error = Diagnostic::error(code::UNKNOWN_KEY, message);
            reader.report(error.at(&key.span(), label).help(help));
        }
    }
}

/// The words as a list, such as `a`, `b` and `c`, without repetitions.
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
