//! Small operations on sorted terms.

use super::accumulator::{Term, Terms};
use super::monomial::Monomial;
use crate::expr::Expr;
use crate::graph::Graph;
use crate::number::Number;

/// The polynomial that is one number.
pub(super) fn constant(number: Number) -> Terms {
    if number.is_zero() { vec![] } else { vec![(Monomial::one(), number)] }
}

/// `factor · terms`, without reduction of anything.
pub(super) fn scaled(terms: &[Term], factor: &Number) -> Terms {
    terms
        .iter()
        .map(|(monomial, coefficient)| (monomial.clone(), coefficient * factor))
        .filter(|(_, coefficient)| !coefficient.is_zero())
        .collect()
}

/// The number that the terms are, if they are one.
pub(super) fn as_number(terms: &[Term]) -> Option<Number> {
    match terms {
        [] => Some(Number::integer(0)),
        [(monomial, number)] if monomial.is_one() => Some(number.clone()),
        _ => None,
    }
}

/// Whether the first term has a minus sign: the sign that odd functions give away.
pub(super) fn leads_negative(terms: &[Term]) -> bool {
    terms.first().is_some_and(|(_, coefficient)| coefficient.is_negative())
}

/// The expression of the sum, in the order of the terms.
pub(super) fn to_expr<'g>(terms: &[Term], graph: &'g Graph) -> Expr<'g> {
    terms.iter().fold(graph.zero(), |sum, (monomial, number)| {
        sum + graph.number(number.clone()) * monomial_expr(monomial, graph)
    })
}

/// The expression of a monomial, a quotient if it has negative powers.
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
