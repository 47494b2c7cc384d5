//! Formulas computed from formulas: exact numbers if all operands are numbers, otherwise text.

use robot_symbolic::{Formula, Rational};

/// Computes a formula from `operands`: a number if all of them are numbers, otherwise `pattern` with each `#i` replaced
/// by the text of operand i. `None` if the text is longer than a formula may be.
pub(super) fn compute(
    operands: &[&Formula],
    pattern: &str,
    number: impl Fn(&[&Rational]) -> Rational,
) -> Option<Formula> {
    let numbers: Vec<_> = operands.iter().map(|operand| operand.as_number()).collect();
    let rationals: Vec<_> =
        numbers.iter().filter_map(|number| number.as_ref()?.as_rational()).collect();
    if rationals.len() == operands.len() {
        return Some(Formula::number(&number(&rationals)));
    }
    let mut text = pattern.to_owned();
    for (index, operand) in operands.iter().enumerate() {
        text = text.replace(&format!("#{index}"), operand.text());
    }
    Formula::parse(&text).ok()
}

/// The product a · b; `None` if its text is too long.
pub(super) fn product(a: &Formula, b: &Formula) -> Option<Formula> {
    compute(&[a, b], "(#0)*(#1)", |v| v[0] * v[1])
}

/// The sum a + b; `None` if its text is too long.
pub(super) fn sum(a: &Formula, b: &Formula) -> Option<Formula> {
    compute(&[a, b], "(#0) + (#1)", |v| v[0] + v[1])
}
