//! Infix text of expressions and polynomials, and helpers for printers of other notations.
//!
//! Text can be parsed again: [`crate::Graph::parse`] gives the same expression for the text of an expression, and an
//! expression with the same polynomial for the text of a polynomial. This holds within the limits of the parser on
//! nesting and length, and a floating-point constant becomes the decimal number that was printed. No function recurses
//! over expressions. An expression whose parts are shared so often that its text would fill the memory is refused
//! beforehand.

mod number;
mod polynomial;
#[cfg(test)]
mod tests;
mod text;

use std::borrow::Cow;

use rustc_hash::FxHashMap;

use crate::expr::{Expr, View};
use crate::walk;

pub use number::{Magnitude, coefficient_text, exact_text, scientific};
pub use polynomial::{
    ArrangedFactor, ArrangedTerm, arranged_text, arranged_value, atoms, default_rank,
};
pub use text::{to_text, to_text_limited};

/// The largest number of operations and operands of an expression that is printed; shared ones count at every use.
pub const MAX_OPERATIONS: u64 = 1_000_000;

/// The error for an expression that is too long to be written out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "written out, the expression has {operations} operations and operands, more than {limit}; \
     introduce names for parts of it"
)]
pub struct TooLarge {
    /// The number of operations and operands, or the largest `u64` if there are more.
    pub operations: u64,
    /// The largest number that was allowed.
    pub limit: u64,
}

/// The precedence of a piece of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Level {
    Sum,
    Product,
    Power,
    Atom,
}

/// A piece of the text of an expression.
pub(crate) enum Piece<'g> {
    Text(Cow<'static, str>),
    /// An operand, which is put in parentheses if it binds less tightly than the level.
    Operand(Expr<'g>, Level),
}

/// Writes an expression in a notation, which gives the level and the pieces of each node.
pub(crate) fn write<'g>(
    root: Expr<'g>,
    limit: u64,
    notation: impl Fn(Expr<'g>) -> (Level, Vec<Piece<'g>>),
) -> Result<String, TooLarge> {
    check_length(root, limit)?;
    let mut text = String::new();
    let mut pending = vec![Piece::Operand(root, Level::Sum)];
    while let Some(piece) = pending.pop() {
        match piece {
            Piece::Text(piece) => text.push_str(&piece),
            Piece::Operand(expr, least) => {
                let (level, pieces) = notation(expr);
                let wrapped = level < least;
                if wrapped {
                    text.push('(');
                    pending.push(Piece::Text(")".into()));
                }
                pending.extend(pieces.into_iter().rev());
            }
        }
    }
    Ok(text)
}

/// Checks that an expression is not too long to be written out.
///
/// # Errors
///
/// If it has more than `limit` operations, with a shared operation counted at every use.
pub fn check_length(expr: Expr<'_>, limit: u64) -> Result<(), TooLarge> {
    let operations = written_operations(expr);
    if operations > limit { Err(TooLarge { operations, limit }) } else { Ok(()) }
}

/// The number of nodes of an expression as a tree, with a shared node counted at every use.
fn written_operations(root: Expr<'_>) -> u64 {
    let mut sizes: FxHashMap<_, u64> = FxHashMap::default();
    for expr in walk::reachable(&[root]) {
        let operands = expr.operands();
        let size = operands
            .iter()
            .map(|operand| sizes.get(&operand.id()).copied().unwrap_or_default())
            .fold(1, u64::saturating_add);
        sizes.insert(expr.id(), size);
    }
    sizes.get(&root.id()).copied().unwrap_or_default()
}

/// The largest exponent that is printed as a power: the largest that the parser accepts.
const MAX_POWER: u32 = crate::formula::MAX_EXPONENT as u32;

/// Returns `(x, n)` if the expression is the product that [`Expr::powi`] makes of `x` and `n`; otherwise the expression
/// and 1.
#[must_use]
pub fn as_power(expr: Expr<'_>) -> (Expr<'_>, u32) {
    power_within(expr, MAX_POWER)
}

/// Like [`as_power`], for exponents up to `most`, which is halved at each of the at most six levels of recursion.
fn power_within(expr: Expr<'_>, most: u32) -> (Expr<'_>, u32) {
    let View::Mul(a, b) = expr.view() else {
        return (expr, 1);
    };
    if most < 2 || a.as_number().is_some() {
        return (expr, 1);
    }
    let ((x, m), (y, n)) = (power_within(a, most / 2), power_within(b, most / 2));
    let (high, low) = (m.max(n), m.min(n));
    // The last step of repeated squaring squares a power of two, or multiplies by the highest power of two in the
    // exponent.
    if x == y && high.is_power_of_two() && m + n <= most { (x, high + low) } else { (expr, 1) }
}
