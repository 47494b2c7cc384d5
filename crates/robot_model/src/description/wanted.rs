//! `[code]`: the functions that are generated if the caller names none.

use std::collections::BTreeSet;

use toml::de::DeValue;

use super::input_limits::MAX_BUNDLES;
use super::names::{Kind, MAX_NAME, Registry, is_identifier, reserved};
use super::reader::{Named, Reader};
use super::shape::CODE;
use super::table::{Entry, Table, Value};
use crate::diagnostic::{Diagnostic, Span, code, quote};
use crate::functions::{self, ALL_FUNCTIONS, Bundle, FunctionKind, Functions, is_of_frame};
use crate::robot::Robot;

/// The functions that a file selects for generated code.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Code {
    /// The functions that are generated separately; none if the file selects only bundles.
    pub functions: Functions,
    /// The bundles: several functions computed in one call.
    pub bundles: Vec<Bundle>,
}

/// The selection as in the file: names of functions, including functions of single frames.
#[derive(Clone, Default)]
pub(super) struct Wanted {
    /// `None` if the file has no `functions`.
    functions: Option<Vec<Named>>,
    bundles: Vec<(String, Vec<Named>)>,
}

/// Checks whether a bundle may have a name.
///
/// # Errors
///
/// The reason why it may not, as the end of a sentence.
pub fn check_bundle_name(name: &str) -> Result<(), String> {
    if !is_identifier(name) {
        return Err(format!(
            "names have at most {MAX_NAME} letters, digits and `_`, and begin with a letter"
        ));
    }
    let owner = reserved(name).or_else(|| Bundle::owner_of(name).map(str::to_owned));
    owner.map_or(Ok(()), |owner| Err(format!("it is reserved: {owner}")))
}

/// Reads `[code]`.
pub(super) fn read(reader: &mut Reader<'_>, root: &mut Table<'_>) -> Wanted {
    let mut wanted = Wanted::default();
    let Some(entry) = root.get("code") else { return wanted };
    let Some(mut table) = reader.table(entry.value, &CODE) else { return wanted };
    if let Some(entry) = table.get("functions") {
        let names = names(reader, entry.value, &[ALL_FUNCTIONS]);
        let all = names.iter().find(|named| named.name == ALL_FUNCTIONS);
        if let Some(all) = all.filter(|_| names.len() > 1) {
            let message = format!(
                "`{ALL_FUNCTIONS}` must be the only entry, but other functions are named too"
            );
            reader.report(
                Diagnostic::error(code::DUPLICATE, message)
                    .at(&all.span, "selects every function except the Jacobians of single links")
                    .help("leave the others out, or name each function instead"),
            );
        }
        wanted.functions = Some(names);
    }
    if let Some(entry) = table.get("bundles") {
        wanted.bundles(reader, &entry);
    }
    table.finish(reader);
    wanted
}

/// Reads a list of functions, in which the words `more` are also allowed.
fn names(reader: &mut Reader<'_>, value: Value<'_>, more: &[&'static str]) -> Vec<Named> {
    let expected = "a list of functions, such as `[\"mass_matrix\", \"bias\"]`";
    let Some(entries) = reader.list(value, expected) else { return Vec::new() };
    if entries.is_empty() {
        reader.report(
            Diagnostic::error(code::WRONG_COUNT, "no functions are named")
                .at(&value.span(), "this list is empty")
                .help("name at least one function, or leave out the key"),
        );
    }
    let (mut names, mut seen) = (Vec::new(), BTreeSet::new());
    for entry in entries {
        let Some(named) = function(reader, entry, more) else { continue };
        if !seen.insert(named.name.clone()) {
            let message = format!("`{}` is named twice", quote(&named.name));
            reader.report(
                Diagnostic::error(code::DUPLICATE, message)
                    .at(&named.span, "again here")
                    .help("name each function once"),
            );
        }
        names.push(named);
    }
    names
}

/// Reads the name of a function or one of the words `more`. The name of a function of a single frame is resolved later,
/// when the robot is known.
pub(super) fn function(reader: &mut Reader<'_>, value: Value<'_>, more: &[&str]) -> Option<Named> {
    let kinds = FunctionKind::ALL.iter().map(|kind| kind.name());
    let words: Vec<&str> = kinds.chain(more.iter().copied()).collect();
    let of_frame = match value.get_ref() {
        DeValue::String(text) => is_of_frame(text),
        _ => false,
    };
    let name = match of_frame {
        true => reader.string(value, "a function")?.to_string(),
        false => reader.word(value, "a function", &words)?.to_owned(),
    };
    Some(Named { name, span: value.span() })
}

/// The function with a name, if the robot has it; otherwise reports an error.
pub(super) fn known(reader: &mut Reader<'_>, robot: &Robot, named: &Named) -> Option<FunctionKind> {
    let diagnostic = match functions::named(robot, &named.name) {
        Ok(kind) => {
            let Some(why) = kind.missing_in(robot) else { return Some(kind) };
            let message = format!("{} has no function `{}`", robot.name, kind.name());
            Diagnostic::error(code::LACKING, message)
                .because(why)
                .help("otherwise do not name this function")
        }
        Err(wrong) => {
            let near = wrong.near.as_ref().map(|near| format!(" Did you mean `{near}`?"));
            let message = format!("`{}` is not a function of this robot", quote(&named.name));
            let help = match wrong.several {
                true => wrong.to_string(),
                false => format!(
                    "functions of frames are `jacobian_` and `jacobian_dot_qd_` followed by the \
                     name of a frame or a moving link.{}",
                    near.unwrap_or_default()
                ),
            };
            Diagnostic::error(code::LACKING, message).help(help)
        }
    };
    reader.report(diagnostic.at(&named.span, ""));
    None
}

impl Wanted {
    /// Reads `bundles`.
    fn bundles(&mut self, reader: &mut Reader<'_>, entry: &Entry<'_>) {
        let DeValue::Table(keys) = entry.value.get_ref() else {
            let expected = "bundles as a table, `{ dynamics = [\"mass_matrix\", \"bias\"] }`";
            return reader.wrong_type(entry.value, expected);
        };
        if keys.len() > MAX_BUNDLES {
            let message =
                format!("at most {MAX_BUNDLES} bundles are allowed; found {}", keys.len());
            let diagnostic = Diagnostic::error(code::LIMIT, message).at(&entry.key, "this table");
            return reader.report(diagnostic.help("put the functions of several bundles into one"));
        }
        let mut names = Registry::new("bundle");
        for (key, value) in keys {
            let named = bundle_name(reader, key.get_ref(), &key.span(), &mut names);
            let functions = self::names(reader, value, &[]);
            if let Some(Named { name, .. }) = named {
                self.bundles.push((name, functions));
            }
        }
    }

    /// The names of the bundles.
    pub(super) fn bundle_names(&self) -> Vec<&str> {
        self.bundles.iter().map(|(name, _)| name.as_str()).collect()
    }

    /// The selected functions of the robot. Reports functions that the robot does not have.
    pub(super) fn code(&self, reader: &mut Reader<'_>, robot: &Robot) -> Code {
        let mut all = |names: &[Named]| -> Vec<FunctionKind> {
            let names = names.iter().filter(|named| named.name != ALL_FUNCTIONS);
            names.filter_map(|named| known(reader, robot, named)).collect()
        };
        let functions = self.functions.as_ref().map(|names| {
            let kinds = all(names);
            match names.iter().any(|named| named.name == ALL_FUNCTIONS) {
                true => Functions::All,
                false => Functions::Chosen(kinds),
            }
        });
        let bundle = |(name, names): &(String, Vec<Named>)| Bundle {
            name: name.clone(),
            functions: all(names),
        };
        let bundles = self.bundles.iter().map(bundle).collect();
        Code { functions: functions.unwrap_or_default(), bundles }
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
        let message = format!("`{name}` cannot be the name of a bundle");
        let diagnostic = Diagnostic::error(code::RESERVED, message);
        reader.report(
            diagnostic
                .at(span, format!("reserved: {owner}"))
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
