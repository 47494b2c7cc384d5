//! CSV as this project reads and writes it: lines one by one, in memory for one line.
//!
//! Cells are separated by commas, may have spaces and quotes around them, and hold no commas; lines of spaces alone
//! do not count.

mod lines;
mod number;

pub use self::lines::{Lines, is_blank, not_utf8};
pub use self::number::push_number;

/// The cells of a line.
#[must_use]
pub fn cells(line: &str) -> Vec<&str> {
    line.split(',').map(cell).collect()
}

fn cell(text: &str) -> &str {
    text.trim().trim_matches('"')
}

/// The number in a cell, if there is one and it is finite.
#[must_use]
pub fn number(cell: &str) -> Option<f64> {
    cell.parse::<f64>().ok().filter(|number| number.is_finite())
}

/// Puts the numbers of a line's cells in place of what is in `found`; whether all cells are numbers. If not,
/// [`cells`] and [`number`] show which.
pub fn numbers(line: &str, found: &mut Vec<f64>) -> bool {
    found.clear();
    let mut rest = line.trim_end();
    loop {
        let length = match fast_float2::parse_partial::<f64, _>(rest) {
            Ok((number, length))
                if number.is_finite()
                    && matches!(rest.as_bytes().get(length), None | Some(b',')) =>
            {
                found.push(number);
                length
            }
            // It has spaces or quotes around it, or is not a number.
            _ => {
                let text = rest.split(',').next().unwrap_or_default();
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
