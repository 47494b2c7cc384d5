//! Numbers as text.

use std::fmt::Write as _;

/// Appends a number as `{:?}` writes it: the shortest decimals that read back to the last bit.
pub fn push_number(text: &mut String, number: f64) {
    // Beyond these `{:?}` has other exponents than the fast printer.
    if number == 0.0 || (1e-4..1e16).contains(&number.abs()) {
        let mut buffer = zmij::Buffer::new();
        let shortest = buffer.format_finite(number);
        if !is_midway(number, shortest) {
            text.push_str(shortest);
            return;
        }
    }
    // Writing to a string does not fail.
    let _ = write!(text, "{number:?}");
}

/// Whether the exact value lies in the middle between two shortest decimals, of which printers choose different ones:
/// it has then one place more than these. A binary fraction has as many decimal places as binary ones.
fn is_midway(number: f64, shortest: &str) -> bool {
    let bits = number.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
    let binary = 1075 - exponent - i64::from((fraction | 1 << 52).trailing_zeros());
    let point = shortest.bytes().rev().position(|byte| byte == b'.');
    point.is_some_and(|places| binary == places as i64 + 1)
}
