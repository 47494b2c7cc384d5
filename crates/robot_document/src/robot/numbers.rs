//! Short numbers for tables.

use robot_symbolic::Rational;

use crate::layout::number;
use crate::math::{Fence, Math};

/// The number of bytes of text above which a constant is rounded in tables.
const LONG: usize = 10;

/// The number of digits of rounded values in tables.
pub(super) const DIGITS: usize = 6;

/// Whether a constant with this text is rounded in tables.
pub(super) const fn is_long(text: &str) -> bool {
    text.len() > LONG
}

/// Whether the rounded value in a table differs from the constant with this text.
pub(super) fn is_cut(value: &Rational, text: &str) -> bool {
    is_long(text) && Rational::from_decimal(&six(value.to_f64())).as_ref() != Some(value)
}

/// Rounds a number to six significant digits, but not before the decimal point.
pub(super) fn rounded(number: f64) -> Math {
    signed(&six(number))
}

fn six(number: f64) -> String {
    if number != 0.0 && number.abs() < 1e-4 {
        let text = format!("{number:.5e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'));
    }
    let places = (5.0 - number.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    let digits = format!("{number:.places$}");
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => digits,
    }
}

/// The layout of a number given as text, with a minus sign if there is one.
pub(super) fn signed(text: &str) -> Math {
    match text.strip_prefix('-') {
        Some(digits) => Math::Row(vec![Math::Sign('-'), number(digits)]),
        None => number(text),
    }
}

/// A vector: its components in parentheses.
pub(super) fn vector(components: &[Math; 3]) -> Math {
    let mut pieces = vec![];
    for component in components {
        if !pieces.is_empty() {
            pieces.push(Math::Sign(','));
        }
        pieces.extend_from_slice(component.pieces());
    }
    Math::Fenced(Fence::Parentheses, Box::new(Math::Row(pieces)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::formula;

    #[test]
    fn long_numbers_have_six_digits() {
        let shown = [1.0 / 3.0, -1_234.567_891, 0.000_123_456_78, 1200.0, 2e7].map(rounded);
        let shown = shown.map(|math| formula(&math));
        assert_eq!(shown, ["0.333333", "-1234.57", "0.000123457", "1200", "20000000"]);
        let cut = |text: &str| is_cut(&Rational::from_decimal(text).unwrap(), text);
        let small = [0.000_018_738_2, -4.6e-16, 1e-5].map(rounded);
        let small = small.map(|math| formula(&math).replace(' ', ""));
        assert_eq!(small, [r"1.87382\cdot10^{-5}", r"-{4.6\cdot10^{-16}}", "10^{-5}"]);
        assert!(cut("1.1550000000000002") && cut("-0.12345678") && !cut("0.00000123456"));
    }
}
