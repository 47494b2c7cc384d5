//! Fractions wider than a line. Lines cannot break within a fraction, so a wide numerator is written after it, as a
//! factor: (a + b + …)/d is 1/d (a + b + …).

use crate::layout::math::{Fence, Math};
use crate::layout::width::width;

/// The formula with the numerators of fractions wider than `limit`, in pt, beside these fractions; nothing if it has no
/// such fraction.
pub(super) fn split(math: &Math, limit: f64) -> Option<Math> {
    let mut pieces = vec![];
    for piece in math.pieces() {
        match piece {
            Math::Fraction(parts) if width(piece) > limit => {
                let [numerator, denominator] = &**parts;
                pieces.extend(beside(numerator, denominator, limit));
            }
            Math::Fenced(fence, inside) => {
                let inside = split(inside, limit).unwrap_or_else(|| (**inside).clone());
                pieces.push(Math::Fenced(*fence, Box::new(inside)));
            }
            other => pieces.push(other.clone()),
        }
    }
    (pieces != math.pieces()).then(|| Math::row(pieces))
}

/// A fraction of the numerator's first number, or 1, and then its other factors.
fn beside(numerator: &Math, denominator: &Math, limit: f64) -> Vec<Math> {
    let fraction = |above: Math| Math::Fraction(Box::new([above, denominator.clone()]));
    let numerator = split(numerator, limit).unwrap_or_else(|| numerator.clone());
    let pieces = numerator.pieces();
    if pieces.iter().any(|piece| matches!(piece, Math::Sign('+' | '-'))) {
        let sum = Math::Fenced(Fence::Parentheses, Box::new(numerator));
        return vec![fraction(Math::integer(1)), sum];
    }
    match pieces {
        [number @ Math::Number(_), Math::Sign('·'), rest @ ..]
        | [number @ Math::Number(_), rest @ ..]
            if !rest.is_empty() =>
        {
            std::iter::once(fraction(number.clone())).chain(rest.iter().cloned()).collect()
        }
        [_, _, ..] | [Math::Fenced(Fence::Parentheses, _)] => {
            std::iter::once(fraction(Math::integer(1))).chain(pieces.iter().cloned()).collect()
        }
        _ => vec![fraction(numerator.clone())],
    }
}
