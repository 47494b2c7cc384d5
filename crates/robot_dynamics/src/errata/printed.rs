//! Reading printed equations: lines of `(number) quantity = terms`.

use std::ops::Range;

use robot_symbolic::Formula;

/// A printed equation: one scalar quantity and what the print says it is.
#[derive(Clone, Debug)]
pub struct PrintedEquation {
    /// The equation's number in print, without parentheses; empty where it has none.
    pub number: String,
    /// The quantity on the left: `M_l4.z`, `Q1`.
    pub quantity: String,
    /// The line of the file, from 1.
    pub line: usize,
    /// The terms of the right-hand side in printed order, brackets unopened.
    pub terms: Vec<PrintedTerm>,
}

/// A summand of a printed equation, sign included.
#[derive(Clone, Debug)]
pub struct PrintedTerm {
    /// The text, `- 2*cos(q2)*q3`.
    pub text: String,
    /// The value.
    pub formula: Formula,
}

/// A line that is no printed equation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct PrintedError {
    /// The line of the file, from 1.
    pub line: usize,
    /// What is wrong and what was expected.
    pub message: String,
}

/// Reads a file of printed equations.
///
/// Comment lines start with `#`; a line that starts with a space continues the one before. The
/// number in parentheses may be left out.
///
/// # Errors
///
/// Every line that cannot be read.
pub fn read_printed(text: &str) -> Result<Vec<PrintedEquation>, Vec<PrintedError>> {
    let mut equations = vec![];
    let mut errors = vec![];
    for (line, entry) in entries(text) {
        match read_entry(&entry, line) {
            Ok(equation) => equations.push(equation),
            Err(message) => errors.push(PrintedError { line, message }),
        }
    }
    if errors.is_empty() { Ok(equations) } else { Err(errors) }
}

/// Entries with the numbers of their first lines, continuation lines joined.
fn entries(text: &str) -> Vec<(usize, String)> {
    let mut entries: Vec<(usize, String)> = vec![];
    for (index, line) in text.lines().enumerate() {
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        match entries.last_mut() {
            Some((_, entry)) if line.starts_with([' ', '\t']) => {
                entry.push(' ');
                entry.push_str(line.trim());
            }
            _ => entries.push((index + 1, line.trim().to_owned())),
        }
    }
    entries
}

fn read_entry(entry: &str, line: usize) -> Result<PrintedEquation, String> {
    let (left, right) =
        entry.split_once('=').ok_or("expected `(number) quantity = terms`, found no `=`")?;
    let left = left.trim();
    let (number, quantity) = match left.strip_prefix('(').and_then(|rest| rest.split_once(')')) {
        Some((number, quantity)) => (number.trim(), quantity.trim()),
        None => ("", left),
    };
    if quantity.is_empty() || quantity.contains(char::is_whitespace) {
        return Err(format!("expected a quantity such as `F_l5.x` or `Q1`, found `{quantity}`"));
    }
    let mut terms = vec![];
    for range in split_terms(right) {
        let text = right[range].trim();
        let formula = Formula::parse_with_dots(text.strip_prefix('+').unwrap_or(text))
            .map_err(|error| format!("in the term `{text}`: {}", error.message))?;
        terms.push(PrintedTerm { text: text.to_owned(), formula });
    }
    if terms.is_empty() {
        return Err(format!("`{quantity}` has no right-hand side"));
    }
    Ok(PrintedEquation { number: number.to_owned(), quantity: quantity.to_owned(), line, terms })
}

/// The summands of a sum: it is cut before each sign outside of brackets that follows an operand.
fn split_terms(text: &str) -> Vec<Range<usize>> {
    let mut ranges = vec![];
    let (mut depth, mut start, mut after_operand) = (0_usize, 0, false);
    for (index, character) in text.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            '+' | '-' if depth == 0 && after_operand => {
                ranges.push(start..index);
                start = index;
            }
            _ => {}
        }
        if !character.is_whitespace() {
            after_operand = character.is_alphanumeric() || character == ')' || character == '_';
        }
    }
    if !text[start..].trim().is_empty() {
        ranges.push(start..text.len());
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_continue_and_split_into_terms() {
        let text = "# head\n(45) M_l2.x = sin(q5)*l6 - q3*(l2 - l3)\n  + 2*q4\nQ1 = -F_l1.y\n";
        let equations = read_printed(text).unwrap();
        assert_eq!(equations.len(), 2);
        let texts: Vec<_> = equations[0].terms.iter().map(|term| term.text.as_str()).collect();
        assert_eq!(texts, ["sin(q5)*l6", "- q3*(l2 - l3)", "+ 2*q4"]);
        assert_eq!((equations[0].number.as_str(), equations[0].line), ("45", 2));
        assert_eq!(equations[1].number, "");
    }

    #[test]
    fn every_bad_line_is_reported() {
        let errors = read_printed("Q1\nQ2 = 2q3\nQ3 =\nQ 4 = q1\n").unwrap_err();
        let lines: Vec<usize> = errors.iter().map(|error| error.line).collect();
        assert_eq!(lines, [1, 2, 3, 4]);
    }
}
