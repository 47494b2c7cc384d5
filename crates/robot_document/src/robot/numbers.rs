//! Numbers in tables: short, with fractions of π and of roots as people write them.

use crate::math::{Fence, Math};

/// Constants of more bytes of text are rounded in tables.
const LONG: usize = 10;
/// Fractions of π and of roots have no larger denominators.
const LARGEST: u64 = 12;

/// Whether a constant of that text is rounded in tables.
pub(super) const fn is_long(text: &str) -> bool {
    text.len() > LONG
}

/// A number to six digits.
pub(super) fn rounded(number: f64) -> Math {
    let places = (5.0 - number.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    let digits = format!("{number:.places$}");
    let digits = match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => &digits,
    };
    signed(digits)
}

/// The text of a number, a minus as the sign.
pub(super) fn signed(text: &str) -> Math {
    match text.strip_prefix('-') {
        Some(digits) => Math::Row(vec![Math::Sign('-'), Math::Number(digits.to_owned())]),
        None => Math::Number(text.to_owned()),
    }
}

/// Components in parentheses.
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

/// A formula with `π/2` for `0.5 π`, and ½ √2 for `0.5 √2`.
pub(super) fn tidied(math: Math) -> Math {
    match math {
        Math::Row(pieces) => Math::Row(row(pieces)),
        Math::Fenced(fence, inside) => Math::Fenced(fence, Box::new(tidied(*inside))),
        Math::Fraction(parts) => Math::Fraction(Box::new(parts.map(tidied))),
        other => other,
    }
}

fn row(pieces: Vec<Math>) -> Vec<Math> {
    let mut tidy = vec![];
    let mut pieces = pieces.into_iter().map(tidied).peekable();
    while let Some(piece) = pieces.next() {
        let parts = match &piece {
            Math::Number(digits) => quotient(digits),
            _ => None,
        };
        match (parts, pieces.peek()) {
            (Some([above, below]), Some(Math::Letter('π'))) => {
                if above > 1 {
                    tidy.push(Math::Number(above.to_string()));
                }
                tidy.extend(pieces.next());
                tidy.extend([Math::Sign('/'), Math::Number(below.to_string())]);
            }
            (Some(parts), Some(Math::Root(_))) => {
                let parts = parts.map(|part| Math::Number(part.to_string()));
                tidy.push(Math::Fraction(Box::new(parts)));
            }
            _ => tidy.push(piece),
        }
    }
    tidy
}

/// A decimal as a fraction with a small denominator, if it is one and no integer.
fn quotient(digits: &str) -> Option<[u64; 2]> {
    let (whole, part) = digits.split_once('.')?;
    let below = 10_u64.checked_pow(u32::try_from(part.len()).ok()?)?;
    let above: u64 = format!("{whole}{part}").parse().ok()?;
    let fraction = (2..=LARGEST).find_map(|denominator| {
        let product = above.checked_mul(denominator)?;
        product.is_multiple_of(below).then_some([product / below, denominator])
    });
    fraction.filter(|_| !above.is_multiple_of(below))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::{formula, read};

    #[test]
    fn parts_of_pi_and_of_roots_are_fractions() {
        for (given, expected) in [
            (r"0.5 \pi", r"\pi/ 2"),
            (r"-0.75 \pi", r"-3 \pi/ 4"),
            (r"2 \pi + 1.5 \pi", r"2 \pi+ 3 \pi/ 2"),
            (r"0.5 \sqrt{2}", r"\frac{1}{2} \sqrt{2}"),
            (r"l_1 \left(0.25 \pi\right)", r"l_1 \left(\pi/ 4\right)"),
            (r"0.123 \pi + 0.5 q", r"0.123 \pi+ 0.5 q"),
        ] {
            assert_eq!(formula(&tidied(read(given).unwrap())), expected, "{given}");
        }
    }

    #[test]
    fn long_numbers_have_six_digits() {
        let shown = [1.0 / 3.0, -1_234.567_891, 0.000_123_456_78, 1200.0, 2e7].map(rounded);
        let shown = shown.map(|math| formula(&math));
        assert_eq!(shown, ["0.333333", "-1234.57", "0.000123457", "1200", "20000000"]);
    }
}
