//! Tables of named columns of numbers, and their CSV.

use std::io::BufRead;

use robot_model::diagnostic::quote;

use crate::csv::{
    Lines, cells, miscounted, number, numbers, push_number, wrong_header, wrong_number,
};
use crate::error::Error;

/// Named columns of numbers, all with the same length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<(String, Vec<f64>)>,
}

/// The number of messages about a table after which reading stops.
const MAX_MESSAGES: usize = 100;

impl Table {
    /// Adds a column.
    pub(crate) fn push(&mut self, name: &str, values: Vec<f64>) {
        self.columns.push((name.to_owned(), values));
    }

    /// Adds a column for each entry of the samples: `q1`, `q2`, ….
    pub(crate) fn push_numbered(&mut self, name: &str, samples: &[impl AsRef<[f64]>]) {
        let count = samples.first().map_or(0, |sample| sample.as_ref().len());
        for entry in 0..count {
            let values = samples.iter().filter_map(|sample| sample.as_ref().get(entry).copied());
            self.columns.push((format!("{name}{}", entry + 1), values.collect()));
        }
    }

    /// The names of the columns, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|(name, _)| name.as_str())
    }

    /// The column with this name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let found = self.columns.iter().find(|(known, _)| known == name);
        found.map(|(_, values)| values.as_slice())
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, values)| values.len())
    }

    /// Writes CSV: a header, and a line for each row. Numbers are read back exactly.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = self.header();
        self.push_rows(&mut text);
        text
    }

    /// The header of the CSV, with its line end.
    #[must_use]
    pub fn header(&self) -> String {
        format!("{}\n", self.names().collect::<Vec<_>>().join(","))
    }

    /// Appends all rows as lines of CSV.
    pub fn push_rows(&self, text: &mut String) {
        for row in 0..self.rows() {
            self.push_row(row, text);
        }
    }

    /// Appends one row as a line of CSV.
    pub fn push_row(&self, row: usize, text: &mut String) {
        let cells = self.columns.iter().filter_map(|(_, values)| values.get(row));
        for (column, value) in cells.enumerate() {
            if column > 0 {
                text.push(',');
            }
            push_number(text, *value);
        }
        text.push('\n');
    }

    /// Reads CSV: a header of names, and lines of finite numbers. `source` is the name of the file in messages.
    ///
    /// # Errors
    ///
    /// The errors in the header and in the lines below it, with the numbers of the lines, up to a limit.
    pub fn read(source: &str, text: &str) -> Result<Table, Error> {
        Table::read_from(source, text.as_bytes())
    }

    /// Like [`Table::read`], from a reader.
    ///
    /// # Errors
    ///
    /// The errors of [`Table::read`], failures of the reader, and text that is not UTF-8.
    pub fn read_from(source: &str, reader: impl BufRead) -> Result<Table, Error> {
        let table = TableReader::new(source, reader)?.rows(usize::MAX)?;
        Ok(table.unwrap_or_default())
    }
}

/// A table that is read a few rows at a time.
#[derive(Debug)]
pub(crate) struct TableReader<R> {
    source: String,
    lines: Lines<R>,
    names: Vec<String>,
    /// The numbers of the current line.
    found: Vec<f64>,
    /// The number of rows that have been read.
    count: usize,
    wrong: Vec<String>,
}

impl<R: BufRead> TableReader<R> {
    /// Reads the header.
    pub(crate) fn new(source: &str, reader: R) -> Result<TableReader<R>, Error> {
        let mut lines = Lines::new(source, reader);
        let Some((_, header)) = lines.next_line()? else {
            return Err(Error::input(format!(
                "{source}: there is no header, the line with the names of the columns"
            )));
        };
        if let Some(wrong) = wrong_header(header) {
            return Err(Error::input(format!("{source}: {wrong}")));
        }
        let names: Vec<String> = cells(header).into_iter().map(str::to_owned).collect();
        let twice = names.iter().enumerate().filter(|(index, name)| names[..*index].contains(name));
        let twice = twice
            .map(|(_, name)| format!("{source}: `{}` appears twice in the header", quote(name)));
        let (wrong, source) = (twice.collect(), source.to_owned());
        Ok(TableReader { source, lines, names, found: vec![], count: 0, wrong })
    }

    /// Reads the next rows, up to `most`; `None` at the end. If there is an error in the file, reading goes on to
    /// find further ones, up to a limit.
    pub(crate) fn rows(&mut self, most: usize) -> Result<Option<Table>, Error> {
        let columns = self.names.iter().map(|name| (name.clone(), vec![]));
        let mut table = Table { columns: columns.collect() };
        while table.rows() < most && self.wrong.len() <= MAX_MESSAGES {
            let Some((number, line)) = self.lines.next_line()? else { break };
            if numbers(line, &mut self.found) && self.found.len() == self.names.len() {
                if self.wrong.is_empty() {
                    let columns = table.columns.iter_mut().zip(&self.found);
                    columns.for_each(|((_, values), number)| values.push(*number));
                    self.count += 1;
                }
            } else {
                let place = format!("{}: line {number}", self.source);
                self.wrong.extend(wrong_cells(&place, &self.names, line));
                table = Table::default();
            }
        }
        if self.count == 0 && self.wrong.is_empty() {
            self.wrong.push(format!("{}: there are no lines below the header", self.source));
        }
        Error::check(std::mem::take(&mut self.wrong), ())?;
        Ok(Some(table).filter(|table| table.rows() > 0))
    }
}

/// The errors in a line without a number for each name.
fn wrong_cells(place: &str, names: &[String], line: &str) -> Vec<String> {
    let cells = cells(line);
    let (found, expected) = (cells.len(), names.len());
    if found != expected {
        return vec![miscounted(place, line, found, expected)];
    }
    let wrong = names.iter().zip(cells).filter(|(_, cell)| number(cell).is_none());
    wrong.map(|(name, cell)| format!("{place}: {}", wrong_number(name, cell))).collect()
}

/// The check of the column `t` of a table, row by row: it must exist, and its values must increase.
#[derive(Debug, Default)]
pub(crate) struct Times {
    rows: usize,
    last: Option<f64>,
    pub(crate) wrong: Option<String>,
}

impl Times {
    /// Continues with further rows of the table.
    pub(crate) fn check(&mut self, source: &str, table: &Table) {
        let Some(times) = table.column("t") else {
            self.wrong = Some(format!("{source}: there is no column `t`, the time in s"));
            return;
        };
        for time in times {
            self.rows += 1;
            if self.wrong.is_none() && self.last.is_some_and(|last| last >= *time) {
                let row = self.rows;
                self.wrong = Some(format!(
                    "{source}: the time does not increase at row {row} below the header; in place of a jump, write a steep change"
                ));
            }
            self.last = Some(*time);
        }
    }
}

/// The error in the column `t` of a table, if there is one: it must exist, and its values must increase.
pub(crate) fn check_times(source: &str, table: &Table) -> Vec<String> {
    let mut times = Times::default();
    times.check(source, table);
    times.wrong.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_reads_back_to_the_last_bit() {
        let mut table = Table::default();
        table.push("t", vec![0.0, 0.1, 1e300]);
        table.push_numbered("q", &[vec![1.0 / 3.0, -0.0], vec![5e-324, 2.0], vec![0.1 + 0.2, 7.0]]);
        let csv = table.csv();
        assert!(csv.starts_with("t,q1,q2\n0.0,0.3333333333333333,-0.0\n"), "{csv}");
        assert_eq!(Table::read("here", &csv).unwrap(), table);
        let spaced = csv.replace(',', " , ").replace('\n', "\r\n\r\n");
        assert_eq!(Table::read("here", &format!("\u{feff}{spaced}")).unwrap(), table);
    }

    #[test]
    fn everything_that_is_wrong_is_named() {
        let message = |text: &str| Table::read("a.csv", text).unwrap_err().to_string();
        assert_eq!(
            message(" \n"),
            "a.csv: there is no header, the line with the names of the columns"
        );
        assert_eq!(message("t,q1\n"), "a.csv: there are no lines below the header");
        assert_eq!(
            message("t,q1,q1\n0,1\n\n0,nan,x\n"),
            "a.csv: `q1` appears twice in the header\na.csv: line 2: 2 entries, but the header has 3\n\
             a.csv: line 4: `q1` is `nan`, not a number\na.csv: line 4: `q1` is `x`, not a number"
        );
    }

    #[test]
    fn times_must_rise() {
        let wrong = |text: &str| check_times("a", &Table::read("a", text).unwrap());
        assert_eq!(wrong("t\n0\n1\n"), [""; 0]);
        assert_eq!(
            wrong("t\n0\n1\n1\n"),
            [
                "a: the time does not increase at row 3 below the header; in place of a jump, write a steep change"
            ]
        );
        assert_eq!(wrong("q1\n0\n"), ["a: there is no column `t`, the time in s"]);
        // Times must also increase from one part of a table to the next.
        let mut times = Times::default();
        for part in ["t\n0\n1\n", "t\n1\n2\n"] {
            times.check("a", &Table::read("a", part).unwrap());
        }
        let expected = "a: the time does not increase at row 3 below the header; in place of a jump, write a steep change";
        assert_eq!(times.wrong.as_deref(), Some(expected));
    }
}
