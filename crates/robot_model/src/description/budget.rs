//! `[[budget]]`: limits on the operations and the stack of generated code.

use super::frames::tables;
use super::reader::{Named, Reader};
use super::shape::BUDGET;
use super::table::{Entry, Table};
use super::wanted::{function, known};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::functions::FunctionKind;
use crate::robot::Robot;

/// The limits of a function in generated code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The name of the function or bundle; `None` for every generated function.
    pub function: Option<String>,
    /// The maximum number of operations of a call: multiplications, additions and divisions.
    pub max_operations: Option<Limit>,
    /// The maximum stack of a call, bytes.
    pub max_stack: Option<Limit>,
}

/// A limit with its place in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limit {
    /// The value of the limit.
    pub value: u64,
    /// Its place in the file.
    pub place: Span,
}

/// Reads every `[[budget]]`. A budget of a bundle must name one of `bundles`.
pub(super) fn read(
    reader: &mut Reader<'_>,
    root: &mut Table<'_>,
    bundles: &[&str],
) -> Vec<(Budget, Option<Named>)> {
    let Some(entry) = root.get("budget") else { return Vec::new() };
    let tables = tables(reader, &entry, &BUDGET);
    tables.into_iter().map(|table| budget(reader, table, bundles)).collect()
}

/// Reads a budget. The name is returned too if it may be that of a function of one frame, which is resolved later.
fn budget(
    reader: &mut Reader<'_>,
    mut table: Table<'_>,
    bundles: &[&str],
) -> (Budget, Option<Named>) {
    let named = table.get("function").and_then(|entry| function(reader, entry.value, bundles));
    let max_operations = table.get("max_operations").and_then(|entry| limit(reader, &entry));
    let max_stack = table.get("max_stack").and_then(|entry| limit(reader, &entry));
    // A table with a misspelled key is not empty; `finish` reports the key.
    if table.len() == usize::from(table.has("function")) {
        reader.report(
            Diagnostic::error(code::MISSING_KEY, "the budget sets no limit")
                .at(&table.span, "neither `max_operations` nor `max_stack` is present")
                .help("add `max_operations` or `max_stack`, or remove the budget"),
        );
    }
    table.finish(reader);
    let function = named.as_ref().map(|named| named.name.clone());
    let is_kind = |named: &Named| FunctionKind::from_name(&named.name).is_some();
    let of_frame = named.filter(|named| !is_kind(named) && !bundles.contains(&&*named.name));
    (Budget { function, max_operations, max_stack }, of_frame)
}

/// Returns the budgets with the full names of functions of single frames, and reports functions that the robot lacks.
pub(super) fn of_robot(
    reader: &mut Reader<'_>,
    robot: &Robot,
    budgets: Vec<(Budget, Option<Named>)>,
) -> Vec<Budget> {
    let own = |(budget, named): (Budget, Option<Named>)| match named {
        None => budget,
        Some(named) => {
            let kind = known(reader, robot, &named);
            let function = kind.map(|kind| kind.full_name(robot)).or(budget.function);
            Budget { function, ..budget }
        }
    };
    budgets.into_iter().map(own).collect()
}

/// Reads a non-negative whole number.
fn limit(reader: &mut Reader<'_>, entry: &Entry<'_>) -> Option<Limit> {
    let place = entry.value.span();
    let number = reader.number(entry.value, "a whole number")?.to_f64();
    let is_whole = (0.0..=9e15).contains(&number) && number.fract() == 0.0;
    if !is_whole {
        reader.report(
            Diagnostic::error(code::NUMBER, "a limit must be a whole number from 0 to 9e15")
                .at(&place, "")
                .help(
                    "give `max_operations` as a number of operations and `max_stack` as a \
                    number of bytes",
                ),
        );
        return None;
    }
    Some(Limit { value: number as u64, place })
}
