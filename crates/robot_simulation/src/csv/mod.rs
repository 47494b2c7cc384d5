//! CSV files as this project reads and writes them, line by line, with only one line in memory.
//!
//! Cells are separated by commas and can have spaces and quotes around them; a comma in quotes does not separate. Blank
//! lines are ignored.

use robot_symbolic::is_below_range;

mod advice;
mod lines;
mod number;

pub use self::advice::{miscounted, unit, wrong_header, wrong_number};
pub use self::lines::{Lines, is_blank, not_utf8};
pub use self::number::push_number;

/// The cells of a line.
#[must_use]
pub fn cells(line: &str) -> Vec<&str> {
    let mut found = vec![];
    let mut rest = Some(line);
    while let Some(line) = rest {
        let text = first(line);
        found.push(cell(text));
        rest = line.get(text.len() + 1..);
    }
    found
}

/// The text before the first comma that is not in quotes.
fn first(line: &str) -> &str {
    let mut is_quoted = false;
    let end = line.find(|character| {
        is_quoted ^= character == '"';
        character == ',' && !is_quoted
    });
    line.split_at(end.unwrap_or(line.len())).0
}

/// A cell without the spaces and the quotes around it. Quotes without a partner stay.
fn cell(text: &str) -> &str {
    let text = text.trim();
    text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(text)
}

/// The number in a cell; `None` if it is not a number in the range of `f64`.
#[must_use]
pub fn number(cell: &str) -> Option<f64> {
    let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
    number.filter(|number| !is_below_range(cell, *number))
}

/// Replaces the content of `found` by the numbers in the cells of a line and returns whether all cells are finite
/// numbers. If not, [`cells`] and [`number`] show which cell is wrong.
pub fn numbers(line: &str, found: &mut Vec<f64>) -> bool {
    found.clear();
    let mut rest = line.trim_end();
    loop {
        let length = match fast_float2::parse_partial::<f64, _>(rest) {
            Ok((number, length))
                if number.is_finite()
                    && !is_below_range(rest.get(..length).unwrap_or_default(), number)
                    && matches!(rest.as_bytes().get(length), None | Some(b',')) =>
            {
                found.push(number);
                length
            }
            // The cell has spaces or quotes around it, or is not a number.
            _ => {
                let text = first(rest);
                let Some(number) = number(cell(text)) else { return false };
                found.push(number);
                text.len()
            }
        };
        match rest.get(length + 1..) {
            Some(next) => rest = next,
            None => return true,
        }
    }
}

#[cfg(test)]
mod tests;
