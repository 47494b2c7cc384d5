//! Named columns of numbers, and CSV.

use std::fmt::Write as _;

use robot_model::diagnostic::quote;

use crate::error::Error;

/// Named columns of numbers, all of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<(String, Vec<f64>)>,
}

/// More messages than this are not collected from one table.
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

    /// The names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|(name, _)| name.as_str())
    }

    /// The column of that name.
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

    /// CSV: a header, then a line for each row. Numbers read back to the last bit.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = self.names().collect::<Vec<_>>().join(",");
        text.push('\n');
        for row in 0..self.rows() {
            let cells = self.columns.iter().filter_map(|(_, values)| values.get(row));
            for (column, value) in cells.enumerate() {
                let comma = if column == 0 { "" } else { "," };
                // Writing to a string does not fail.
                let _ = write!(text, "{comma}{value:?}");
            }
            text.push('\n');
        }
        text
    }

    /// Reads CSV: a header of names, then lines of finite numbers. `source` is the file's name in
    /// messages.
    ///
    /// # Errors
    ///
    /// Everything that is wrong, each with its line.
    pub fn read(source: &str, text: &str) -> Result<Table, Error> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
        let Some((header, _)) = lines.next() else {
            return Err(Error::input(format!("{source}: there is no header, such as t,q1,q2")));
        };
        let names = cells(header);
        let (mut table, mut wrong) = (Table::default(), vec![]);
        for name in names {
            if table.column(name).is_some() {
                wrong.push(format!("{source}: `{}` appears twice in the header", quote(name)));
            }
            table.push(name, vec![]);
        }
        for (line, number) in lines {
            if wrong.len() > MAX_MESSAGES {
                break;
            }
            table.read_line(&format!("{source}: line {number}"), line, &mut wrong);
        }
        if table.rows() == 0 && wrong.is_empty() {
            wrong.push(format!("{source}: there are no lines below the header"));
        }
        Error::check(wrong, table)
    }

    fn read_line(&mut self, place: &str, line: &str, wrong: &mut Vec<String>) {
        let cells = cells(line);
        let (found, expected) = (cells.len(), self.columns.len());
        if found != expected {
            wrong.push(format!("{place}: {found} entries, but the header has {expected}"));
            return;
        }
        for ((name, values), cell) in self.columns.iter_mut().zip(cells) {
            let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
            if number.is_none() {
                let (name, cell) = (quote(name), quote(cell));
                wrong.push(format!("{place}: `{name}` is `{cell}`, not a number"));
            }
            values.extend(number);
        }
    }
}

fn cells(line: &str) -> Vec<&str> {
    line.split(',').map(|cell| cell.trim().trim_matches('"')).collect()
}

/// The problem with the column `t` of a table: it must exist and ascend.
pub(crate) fn check_times(source: &str, table: &Table) -> Vec<String> {
    let Some(times) = table.column("t") else {
        return vec![format!("{source}: there is no column `t`, the time in s")];
    };
    let falls = times.windows(2).position(|pair| pair[0] >= pair[1]);
    let message = falls.map(|row| {
        format!("{source}: the time does not increase at row {} below the header", row + 2)
    });
    message.into_iter().collect()
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
        assert_eq!(message(" \n"), "a.csv: there is no header, such as t,q1,q2");
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
            ["a: the time does not increase at row 3 below the header"]
        );
        assert_eq!(wrong("q1\n0\n"), ["a: there is no column `t`, the time in s"]);
    }
}
