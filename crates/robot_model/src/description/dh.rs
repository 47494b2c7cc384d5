//! `[dh]`: the joints of a whole arm in one table, a row for each link without a frame of its own.

use super::joint;
use super::placement::{Row, convention, row};
use super::reader::Reader;
use super::shape::{DH_TABLE, DH_TABLE_ROW};
use super::table;
use crate::diagnostic::{Diagnostic, Span, code};
use crate::robot::{DhConvention, JointKind};

/// The rows of the table, handed out one by one in the order of the links.
pub(super) struct Table {
    convention: DhConvention,
    rows: std::vec::IntoIter<LinkRow>,
    /// The place of `rows`.
    place: Span,
    /// The number of rows that are written; `None` if they cannot be read.
    count: Option<usize>,
    taken: usize,
}

/// A row of Denavit–Hartenberg parameters with its convention, joint type and place in the file.
pub(super) struct LinkRow {
    pub(super) convention: DhConvention,
    /// `None` for a fixed link.
    pub(super) kind: Option<JointKind>,
    pub(super) row: Row,
    pub(super) place: Span,
}

/// Reads the table, if the file has one. If its rows cannot be read, each link has a placeholder.
pub(super) fn read(reader: &mut Reader<'_>, root: &mut table::Table<'_>) -> Option<Table> {
    let entry = root.get("dh")?;
    let mut read = Table {
        // An invalid convention is reported; this placeholder stands in for it.
        convention: DhConvention::Standard,
        place: entry.key.clone(),
        count: None,
        taken: 0,
        rows: vec![].into_iter(),
    };
    let Some(mut table) = reader.table(entry.value, &DH_TABLE) else { return Some(read) };
    read.convention = convention(reader, &mut table).unwrap_or(read.convention);
    let example = "rows = [{ type = \"revolute\", a = 0, alpha = \"pi/2\", d = 0.5 }]";
    let rows = table.require(reader, "rows", example);
    table.finish(reader);
    let list = "a list of rows `{ a = …, alpha = …, d = … }`";
    let Some(values) = rows.and_then(|rows| reader.list(rows.value, list)) else {
        return Some(read);
    };
    let tables = values.iter().filter_map(|value| reader.table(value, &DH_TABLE_ROW));
    let tables: Vec<_> = tables.collect();
    let rows: Vec<LinkRow> =
        tables.into_iter().map(|table| link_row(reader, table, read.convention)).collect();
    read.count = Some(values.len());
    read.rows = rows.into_iter();
    Some(read)
}

fn link_row(
    reader: &mut Reader<'_>,
    mut table: table::Table<'_>,
    convention: DhConvention,
) -> LinkRow {
    let kind = match table.get("type") {
        Some(entry) => joint::kind(reader, &entry)
            .unwrap_or_else(|| Some(joint::probable_kind(reader, &entry))),
        None => Some(JointKind::Revolute),
    };
    let place = table.span.clone();
    let row = row(reader, &mut table);
    table.finish(reader);
    LinkRow { convention, kind, row, place }
}

impl Table {
    /// The row of the next link. If all rows are used up, an empty placeholder.
    pub(super) fn next_row(&mut self) -> LinkRow {
        self.taken += 1;
        self.rows.next().unwrap_or_else(|| LinkRow {
            convention: self.convention,
            kind: Some(JointKind::Revolute),
            row: Row {
                a: Reader::unknown(),
                alpha: Reader::unknown(),
                d: Reader::unknown(),
                theta: Reader::unknown(),
            },
            place: self.place.clone(),
        })
    }

    /// Reports an error if the number of rows is not the number of links without a frame of their
    /// own.
    pub(super) fn finish(self, reader: &mut Reader<'_>) {
        let Some(rows) = self.count.filter(|rows| *rows != self.taken) else { return };
        let links = self.taken;
        let plural = if rows == 1 { "" } else { "s" };
        let message = format!(
            "the DH table has {rows} row{plural}, but the number of links that take a row is {links}"
        );
        reader.report(
            Diagnostic::error(code::WRONG_COUNT, message)
                .at(&self.place, "this table")
                .help("give one row for each `[[link]]` that has neither `origin` nor `dh`"),
        );
    }
}
