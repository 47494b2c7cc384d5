//! `[code]`: which functions are generated where the caller names none.

use std::collections::BTreeSet;

use toml::de::DeValue;

use super::limits::MAX_BUNDLES;
use super::names::{Kind, Registry, is_identifier, reserved};
use super::reader::{Named, Reader};
use super::shape::CODE;
use super::table::{Entry, Table, Value};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::functions::{ALL_FUNCTIONS, Bundle, FunctionKind, Functions};
use crate::model::Robot;

/// Which functions a file wants to be generated.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Code {
    /// The functions, each by itself; where only bundles are named, none.
    pub functions: Functions,
    /// Functions in one call.
    pub bundles: Vec<Bundle>,
}

/// The same with the places where functions are named.
#[derive(Clone, Default)]
pub(super) struct Wanted {
    pub(super) code: Code,
    named: Vec<(FunctionKind, Span)>,
}

/// Whether a bundle may have a name.
///
/// # Errors
///
/// Why it may not, as the end of a sentence.
pub fn check_bundle_name(name: &str) -> Result<(), String> {
    if !is_identifier(name) {
        return Err("names are letters, digits and `_`, the first not a digit".to_owned());
    }
    let owner = reserved(name).or_else(|| Bundle::owner_of(name).map(str::to_owned));
    owner.map_or(Ok(()), |owner| Err(format!("this is {owner}")))
}

/// Reads the table.
pub(super) fn read(reader: &mut Reader<'_>, root: &mut Table<'_>) -> Wanted {
    let mut wanted = Wanted::default();
    let Some(entry) = root.get("code") else { return wanted };
    let Some(mut table) = reader.table(entry.value, &CODE) else { return wanted };
    if let Some(entry) = table.get("functions") {
        let all = is_all(entry.value);
        let kinds = wanted.kinds(reader, entry.value, &[ALL_FUNCTIONS]);
        wanted.code.functions = if all { Functions::All } else { Functions::Chosen(kinds) };
    }
    if let Some(entry) = table.get("bundles") {
        wanted.bundles(reader, &entry);
    }
    table.finish(reader);
    wanted
}

/// Whether a list has the word for all functions.
fn is_all(value: Value<'_>) -> bool {
    let is_word = |value: &Value<'_>| matches!(value.get_ref(), DeValue::String(text) if text == ALL_FUNCTIONS);
    matches!(value.get_ref(), DeValue::Array(entries) if entries.iter().any(|entry| is_word(&entry)))
}

impl Wanted {
    /// Reads a list of functions, in which some further words may stand.
    fn kinds(
        &mut self,
        reader: &mut Reader<'_>,
        value: Value<'_>,
        more: &[&'static str],
    ) -> Vec<FunctionKind> {
        let expected = "a list of functions, such as `[\"mass_matrix\", \"bias\"]`";
        let Some(entries) = reader.list(value, expected) else { return Vec::new() };
        let names: Vec<&str> =
            FunctionKind::ALL.iter().map(|kind| kind.name()).chain(more.iter().copied()).collect();
        if entries.is_empty() || entries.len() > names.len() {
            let (count, most) = (entries.len(), names.len());
            reader.report(
                Diagnostic::error(code::WRONG_COUNT, format!("{count} functions are named here"))
                    .at(&value.span(), format!("1 to {most} are possible"))
                    .help("name each function once, or leave the key out"),
            );
            return Vec::new();
        }
        let (mut kinds, mut seen) = (Vec::new(), BTreeSet::new());
        for entry in entries {
            let Some(word) = reader.word(entry, "a function", &names) else { continue };
            if !seen.insert(word) {
                reader.report(
                    Diagnostic::error(code::DUPLICATE, format!("`{word}` is named twice"))
                        .at(&entry.span(), "again here")
                        .help("name each function once"),
                );
            }
            if let Some(kind) = FunctionKind::from_name(word) {
                kinds.push(kind);
                self.named.push((kind, entry.span()));
            }
        }
        kinds
    }

    /// Reads `bundles`.
    fn bundles(&mut self, reader: &mut Reader<'_>, entry: &Entry<'_>) {
        let DeValue::Table(keys) = entry.value.get_ref() else {
            let expected = "bundles as a table, `{ dynamics = [\"mass_matrix\", \"bias\"] }`";
            return reader.wrong_type(entry.value, expected);
        };
        if keys.len() > MAX_BUNDLES {
            let message = format!("{} bundles; at most {MAX_BUNDLES}", keys.len());
            let diagnostic = Diagnostic::error(code::LIMIT, message).at(&entry.key, "this table");
            return reader.report(diagnostic.help("put more functions into one bundle"));
        }
        let mut names = Registry::new("bundle");
        for (key, value) in keys {
            let named = bundle_name(reader, key.get_ref(), &key.span(), &mut names);
            let functions = self.kinds(reader, value, &[]);
            if let Some(Named { name, .. }) = named {
                self.code.bundles.push(Bundle { name, functions });
            }
        }
    }

    /// Reports the functions that the robot lacks.
    pub(super) fn check(&self, reader: &mut Reader<'_>, robot: &Robot) {
        for (kind, place) in &self.named {
            let Some(why) = kind.missing_in(robot) else { continue };
            let message = format!("{} has no function `{}`", robot.name, kind.name());
            let diagnostic = Diagnostic::error(code::LACKING, message).at(place, "");
            reader.report(diagnostic.because(why).help("or take it from the list"));
        }
    }
}

fn bundle_name(
    reader: &mut Reader<'_>,
    name: &str,
    span: &Span,
    names: &mut Registry,
) -> Option<Named> {
    let named = reader.check_name(name, span, "a bundle", Kind::Identifier)?;
    if let Some(owner) = Bundle::owner_of(name) {
        let message = format!("`{name}` cannot name a bundle");
        let diagnostic = Diagnostic::error(code::RESERVED, message);
        reader.report(
            diagnostic
                .at(span, format!("this is {owner}"))
                .help("choose another name, such as `dynamics`"),
        );
        return None;
    }
    match names.add(&named) {
        Some(diagnostic) => {
            reader.report(diagnostic);
            None
        }
        None => Some(named),
    }
}
