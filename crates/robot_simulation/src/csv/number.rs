//! Formatting of numbers.

use std::fmt::Write as _;

/// Appends a number as `{:?}` formats it: the shortest decimal number that is read back exactly.
pub fn push_number(text: &mut String, number: f64) {
    // Outside this range, `{:?}` writes exponents differently from the fast printer.
    if number == 0.0 || (1e-4..1e16).contains(&number.abs()) {
        let mut buffer = zmij::Buffer::new();
        let shortest = buffer.format_finite(number);
        if !is_midway(number, shortest) {
            text.push_str(shortest);
            return;
        }
    }
    // Writing to a string cannot fail.
    let _ = write!(text, "{number:?}");
}

/// Whether the exact value is halfway between two shortest decimals, of which different printers choose different ones.
/// The exact value then has one decimal place more than these; a binary fraction has as many decimal places as binary
/// ones.
fn is_midway(number: f64, shortest: &str) -> bool {
    let bits = number.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
    let binary = 1075 - exponent - i64::from((fraction | 1 << 52).trailing_zeros());
    let point = shortest.bytes().rev().position(|byte| byte == b'.');
    point.is_some_and(|places| binary == places as i64 + 1)
}
