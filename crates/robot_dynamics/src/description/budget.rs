//! `[[budget]]`: what generated code may cost.

use super::frames::tables;
use super::reader::Reader;
use super::shape::BUDGET;
use super::table::{Entry, Table};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::functions::{Bundle, FunctionKind};

/// What a function of generated code may cost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The name of the function or bundle; `None` for every one that is generated.
    pub function: Option<String>,
    /// The most operations of a call: multiplications, additions and divisions.
    pub max_operations: Option<Limit>,
    /// The most bytes of stack of a call.
    pub max_stack: Option<Limit>,
}

/// A limit with its place in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limit {
    /// The limit.
    pub value: u64,
    /// Its place.
    pub place: Span,
}

/// Reads every `[[budget]]`; those of bundles name one of the file.
pub(super) fn read(
    reader: &mut Reader<'_>,
    root: &mut Table<'_>,
    bundles: &[Bundle],
) -> Vec<Budget> {
    let Some(entry) = root.get("budget") else { return Vec::new() };
    let kinds = FunctionKind::ALL.iter().map(|kind| kind.name());
    let names: Vec<&str> = kinds.chain(bundles.iter().map(|one| one.name.as_str())).collect();
    let tables = tables(reader, &entry, &BUDGET);
    tables.into_iter().map(|table| budget(reader, table, &names)).collect()
}

fn budget(reader: &mut Reader<'_>, mut table: Table<'_>, names: &[&str]) -> Budget {
    let function = table
        .get("function")
        .and_then(|entry| reader.word(entry.value, "a function", names).map(str::to_owned));
    let max_operations = table.get("max_operations").and_then(|entry| limit(reader, &entry));
    let max_stack = table.get("max_stack").and_then(|entry| limit(reader, &entry));
    table.finish(reader);
    Budget { function, max_operations, max_stack }
}

/// A whole number that is not negative.
fn limit(reader: &mut Reader<'_>, entry: &Entry<'_>) -> Option<Limit> {
    let place = entry.value.span();
    let number = reader.number(entry.value, "a whole number")?.to_f64();
    let is_whole = (0.0..=9e15).contains(&number) && number.fract() == 0.0;
    if !is_whole {
        reader.report(
            Diagnostic::error(code::NUMBER, "a limit is a whole number that is not negative")
                .at(&place, "")
                .help("count operations in `max_operations`, bytes in `max_stack`"),
        );
        return None;
    }
    Some(Limit { value: number as u64, place })
}
