//! Small operations on sorted terms.

use super::accumulator::{Term, Terms};
use super::monomial::Monomial;
use crate::expr::Expr;
use crate::graph::Graph;
use crate::number::Number;

/// The terms of a constant polynomial.
pub(super) fn constant(number: Number) -> Terms {
    if number.is_zero() { vec![] } else { vec![(Monomial::one(), number)] }
}

/// Returns `factor · terms`; no squares are replaced.
pub(super) fn scaled(terms: &[Term], factor: &Number) -> Terms {
    terms
        .iter()
        .map(|(monomial, coefficient)| (monomial.clone(), coefficient * factor))
        .filter(|(_, coefficient)| !coefficient.is_zero())
        .collect()
}

/// Returns the number if the polynomial is constant.
pub(super) fn as_number(terms: &[Term]) -> Option<Number> {
    match terms {
        [] => Some(Number::integer(0)),
        [(monomial, number)] if monomial.is_one() => Some(number.clone()),
        _ => None,
    }
}

/// Whether the first coefficient is negative: its sign is moved out of odd functions.
pub(super) fn leads_negative(terms: &[Term]) -> bool {
    terms.first().is_some_and(|(_, coefficient)| coefficient.is_negative())
}

/// Converts terms to an expression that adds them in their order.
pub(super) fn to_expr<'g>(terms: &[Term], graph: &'g Graph) -> Expr<'g> {
    terms.iter().fold(graph.zero(), |sum, (monomial, number)| {
        sum + graph.number(number.clone()) * monomial_expr(monomial, graph)
    })
}

/// Converts a monomial to an expression: a quotient if it has negative exponents.
pub(super) fn monomial_expr<'g>(monomial: &Monomial, graph: &'g Graph) -> Expr<'g> {
    let product = |positive: bool| {
        monomial.factors().iter().filter(|factor| (factor.exponent() > 0) == positive).fold(
            graph.one(),
            |product, factor| {
                let power = i32::try_from(factor.exponent().unsigned_abs()).unwrap_or(i32::MAX);
                product * graph.expr(factor.atom()).powi(power)
            },
        )
    };
    product(true) / product(false)
}
