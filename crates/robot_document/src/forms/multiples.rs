//! Sums that are multiples of other sums.

use std::cell::RefCell;

use robot_symbolic::{Expr, Graph, Id, Rational, View, walk};
use rustc_hash::FxHashMap;

/// The terms of a sum by their factors, in the order of the factors. Numbers are no factors.
type Terms = Vec<(Vec<Id>, Rational)>;

/// The largest number of terms, and of factors of a term, of a sum that is compared with others.
const MOST: usize = 12;

/// Sums with the expressions that stand for them.
#[derive(Clone, Default)]
pub(super) struct Multiples<'g> {
    known: FxHashMap<Terms, (Expr<'g>, Rational)>,
    /// The keys of the known ones, in their order.
    keys: Vec<Terms>,
    /// The places of the keys whose first term has these factors.
    places: FxHashMap<Vec<Id>, Vec<usize>>,
}

impl<'g> Multiples<'g> {
    /// Remembers that an expression stands for a sum, unless one stands for a multiple of it.
    pub(super) fn insert(&mut self, sum: Expr<'_>, name: Expr<'g>) {
        if let Some((terms, factor)) = terms(sum).and_then(primitive) {
            self.known.entry(terms).or_insert_with_key(|terms| {
                let first = terms.first().map(|(factors, _)| factors.clone()).unwrap_or_default();
                self.places.entry(first).or_default().push(self.keys.len());
                self.keys.push(terms.clone());
                (name, factor)
            });
        }
    }

    /// The multiple of a known expression that equals a sum.
    fn of(&self, sum: Expr<'g>) -> Option<Expr<'g>> {
        let (View::Add(..) | View::Sub(..)) = sum.view() else { return None };
        let (terms, factor) = terms(sum).and_then(primitive)?;
        let (name, own) = self.known.get(&terms)?;
        Some(*name * sum.graph().number(&factor * &own.recip()?))
    }

    /// The sum with a known expression in place of some of its terms.
    fn of_some(&self, sum: Expr<'g>) -> Option<Expr<'g>> {
        let (View::Add(..) | View::Sub(..)) = sum.view() else { return None };
        let (graph, terms) = (sum.graph(), terms(sum)?);
        let number = |key: &[Id]| {
            let place = terms.binary_search_by(|(factors, _)| factors.as_slice().cmp(key)).ok()?;
            terms.get(place).map(|(_, number)| number)
        };
        let ratio = |key: &Terms| {
            let (first, _) = key.first()?;
            let ratio = number(first)?;
            let is_same = |(factors, own): &(Vec<Id>, Rational)| {
                number(factors).is_some_and(|number| *number == ratio * own)
            };
            (key.len() < terms.len() && key.iter().all(is_same)).then_some(ratio)
        };
        // The first of the keys that are part of the sum.
        let begin = terms.iter().filter_map(|(factors, _)| self.places.get(factors));
        let mut places: Vec<usize> = begin.flatten().copied().collect();
        places.sort_unstable();
        let keys = places.into_iter().filter_map(|place| self.keys.get(place));
        let (key, ratio) = keys.clone().find_map(|key| Some((key, ratio(key)?)))?;
        let (name, own) = self.known.get(key)?;
        let is_left = |factors: &Vec<Id>| !key.iter().any(|(known, _)| known == factors);
        let left = terms.iter().filter(|(factors, _)| is_left(factors));
        let left = left.map(|(factors, number)| {
            let factors = factors.iter().map(|factor| graph.expr(*factor));
            factors.fold(graph.number(number.clone()), |product, factor| product * factor)
        });
        Some(left.fold(*name * graph.number(ratio * &own.recip()?), |sum, term| sum + term))
    }

    /// The expression with known expressions in place of sums.
    pub(super) fn within(&self, expr: Expr<'g>) -> Expr<'g> {
        if self.keys.is_empty() {
            return expr;
        }
        let replace = |part| self.of(part).or_else(|| self.of_some(part)).unwrap_or(part);
        walk::rebuild_upward(&[expr], expr.graph(), replace).pop().unwrap_or(expr)
    }
}

/// Writes sums that are multiples of earlier sums, such as 0.5 cos q₂ q̈₁ − sin q₂ q̇₁ q̇₂ beside
/// cos q₂ q̈₁ − 2 sin q₂ q̇₁ q̇₂, as these multiples, so that one name serves both. Otherwise a parameter
/// that cancels between the two could seem to have an effect.
pub(super) fn united<'g>(values: &[Expr<'g>], graph: &'g Graph) -> Vec<Expr<'g>> {
    let known: RefCell<Multiples<'g>> = RefCell::default();
    walk::rebuild_upward(values, graph, |part| {
        let found = known.borrow().of(part);
        if found.is_none() {
            known.borrow_mut().insert(part, part);
        }
        found.unwrap_or(part)
    })
}

/// The terms divided by the coefficient of the first, and this coefficient; `None` of a single term.
fn primitive(terms: Terms) -> Option<(Terms, Rational)> {
    let [(_, first), _, ..] = terms.as_slice() else { return None };
    let (first, inverse) = (first.clone(), first.recip()?);
    Some((
        terms.into_iter().map(|(factors, number)| (factors, &number * &inverse)).collect(),
        first,
    ))
}

/// The terms of a sum; `None` if there are too many.
fn terms(sum: Expr<'_>) -> Option<Terms> {
    let mut found: Terms = vec![];
    let mut pending = vec![(sum, Rational::ONE)];
    let mut visited = 0;
    while let Some((part, number)) = pending.pop() {
        visited += 1;
        if visited > 2 * MOST {
            return None;
        }
        match part.view() {
            View::Neg(a) => pending.push((a, -&number)),
            View::Add(a, b) => pending.extend([(a, number.clone()), (b, number)]),
            View::Sub(a, b) => pending.extend([(b, -&number), (a, number)]),
            _ => {
                let (factors, own) = factors(part)?;
                let number = &number * &own;
                match found.iter_mut().find(|(known, _)| *known == factors) {
                    Some((_, known)) => *known = &*known + &number,
                    None => found.push((factors, number)),
                }
            }
        }
    }
    found.retain(|(_, number)| !number.is_zero());
    found.sort_by(|(a, _), (b, _)| a.cmp(b));
    Some(found)
}

/// The factors of a product, sorted, and its number; `None` if there are too many.
fn factors(product: Expr<'_>) -> Option<(Vec<Id>, Rational)> {
    let (mut factors, mut number) = (vec![], Rational::ONE);
    let mut pending = vec![product];
    while let Some(part) = pending.pop() {
        if factors.len() + pending.len() > MOST {
            return None;
        }
        match part.view() {
            View::Neg(a) => {
                number = -&number;
                pending.push(a);
            }
            View::Mul(a, b) => pending.extend([a, b]),
            // Rounded numbers have no exact ratio.
            View::Number(one) => number = &number * one.as_rational()?,
            _ => factors.push(part.id()),
        }
    }
    factors.sort_unstable();
    Some((factors, number))
}
