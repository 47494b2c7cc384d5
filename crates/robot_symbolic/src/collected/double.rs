//! Sines and cosines of double angles: 2 sin x cos x is sin 2x, and 1 − 2 sin² x and 2 cos² x − 1 are cos 2x.

use std::cmp::Ordering;

use rustc_hash::FxHashMap;

use super::proved;
use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, Id};
use crate::number::Number;
use crate::polynomial::{Polynomial, PolynomialOptions};
use crate::print::{ArrangedFactor, ArrangedTerm, arranged_value};
use crate::walk;

type Factor<'g> = (ArrangedFactor<'g>, i32);

/// The terms with double angles; `None` if there are none to write, or if the result cannot be proved equal within the
/// limits. The factors of a term are in the order `compare`.
pub(super) fn joined<'g>(
    terms: &[ArrangedTerm<'g>],
    graph: &'g Graph,
    compare: impl Fn(&ArrangedFactor<'g>, &ArrangedFactor<'g>) -> Ordering,
) -> Option<Vec<ArrangedTerm<'g>>> {
    let mut writer = Writer { graph, compare, doubles: FxHashMap::default() };
    let mut doubled = terms.to_vec();
    writer.join(&mut doubled);
    if writer.doubles.is_empty() {
        return None;
    }
    // In the proof, double angles are written by single ones, because the sines of other multiples than integers do not
    // expand.
    let values = [terms, &doubled].map(|terms| arranged_value(terms, graph));
    let single = |part: Expr<'g>| writer.doubles.get(&part.id()).copied();
    let values = walk::rebuild_above(&values, graph, single);
    let [before, after] = values.as_slice() else { return None };
    let before = Polynomial::of(*before, &PolynomialOptions::default()).ok()?;
    proved(*after, &before).map(|_| doubled)
}

struct Writer<'g, F> {
    graph: &'g Graph,
    compare: F,
    /// The sines and cosines of double angles that were written, by those of angles in the terms before.
    doubles: FxHashMap<Id, Expr<'g>>,
}

impl<'g, F: Fn(&ArrangedFactor<'g>, &ArrangedFactor<'g>) -> Ordering> Writer<'g, F> {
    /// Writes double angles in the terms and in the sums in parentheses that are their factors.
    fn join(&mut self, terms: &mut Vec<ArrangedTerm<'g>>) {
        for term in terms.iter_mut() {
            for (factor, _) in &mut term.factors {
                if let ArrangedFactor::Sum(inner) = factor {
                    self.join(inner);
                }
            }
            lead_with_plus(term);
            if flatten(term) {
                term.factors.sort_by(|(a, _), (b, _)| (self.compare)(a, b));
            }
            self.join_sines(term);
        }
        while let Some((square, plain)) = square_and_plain(terms) {
            self.join_cosine(terms, square, plain);
        }
    }

    /// The sine or cosine of twice an angle, which may itself be a double angle.
    fn double(&mut self, function: Function, angle: Expr<'g>) -> Expr<'g> {
        let (one, two) = (self.graph.one(), self.graph.integer(2));
        let single = |function: Expr<'g>| self.doubles.get(&function.id()).copied();
        let [sine, cosine] =
            [angle.sin(), angle.cos()].map(|function| single(function).unwrap_or(function));
        let value = match function {
            Function::Sin => two * sine * cosine,
            _ => two * cosine * cosine - one,
        };
        let double = (two * angle).apply(function);
        self.doubles.insert(double.id(), value);
        double
    }

    /// Replaces each product of equal powers of sin x and cos x by that power of ½ sin 2x.
    fn join_sines(&mut self, term: &mut ArrangedTerm<'g>) {
        let half = Number::integer(2).recip();
        while let Some((sine, cosine, angle)) = sine_and_cosine(&term.factors) {
            let double = self.double(Function::Sin, angle);
            if let Some((factor, exponent)) = term.factors.get_mut(sine) {
                *factor = ArrangedFactor::Atom(double);
                for _ in 0..*exponent {
                    term.coefficient = &term.coefficient * &half;
                }
            }
            term.factors.remove(cosine);
        }
    }

    /// Replaces two terms by one with the cosine of a double angle, at the place of the first of them.
    fn join_cosine(&mut self, terms: &mut Vec<ArrangedTerm<'g>>, square: Square<'g>, plain: usize) {
        let Square { term, factor, function, angle } = square;
        let double = self.double(Function::Cos, angle);
        let [Some(mut joined), Some(other)] = [term, plain].map(|place| terms.get(place).cloned())
        else {
            return;
        };
        joined.negative ^= function == Function::Sin;
        joined.coefficient = other.coefficient;
        if let Some(place) = joined.factors.get_mut(factor) {
            *place = (ArrangedFactor::Atom(double), 1);
        }
        if let Some(place) = terms.get_mut(term.min(plain)) {
            *place = joined;
        }
        terms.remove(term.max(plain));
    }
}

/// Moves a minus sign at the beginning of a sum in parentheses in front of them.
fn lead_with_plus(term: &mut ArrangedTerm<'_>) {
    for (factor, exponent) in &mut term.factors {
        let ArrangedFactor::Sum(inner) = factor else { continue };
        if inner.first().is_some_and(|first| first.negative) {
            inner.iter_mut().for_each(|one| one.negative = !one.negative);
            term.negative ^= *exponent % 2 != 0;
        }
    }
}

/// Replaces each sum to the power 1 that has become a single term with the factors of this term, and multiplies its sign
/// and coefficient into `term`; returns whether there were any.
fn flatten(term: &mut ArrangedTerm<'_>) -> bool {
    let mut is_changed = false;
    let mut factors = Vec::with_capacity(term.factors.len());
    for (factor, exponent) in std::mem::take(&mut term.factors) {
        match factor {
            ArrangedFactor::Sum(inner) if inner.len() == 1 && exponent == 1 => {
                is_changed = true;
                for single in inner {
                    term.negative ^= single.negative;
                    term.coefficient = &term.coefficient * &single.coefficient;
                    factors.extend(single.factors);
                }
            }
            factor => factors.push((factor, exponent)),
        }
    }
    term.factors = factors;
    is_changed
}

/// The places of equal powers of the sine and the cosine of an angle.
fn sine_and_cosine<'g>(factors: &[Factor<'g>]) -> Option<(usize, usize, Expr<'g>)> {
    factors.iter().enumerate().find_map(|(sine, factor)| {
        let exponent = factor.1;
        let angle = angle_of(factor, Function::Sin, exponent).filter(|_| exponent > 0)?;
        let is_cosine =
            |factor: &Factor<'g>| angle_of(factor, Function::Cos, exponent) == Some(angle);
        Some((sine, factors.iter().position(is_cosine)?, angle))
    })
}

/// A term with the square of a sine or cosine: its place, that of the factor in it, the function and its angle.
#[derive(Clone, Copy)]
struct Square<'g> {
    term: usize,
    factor: usize,
    function: Function,
    angle: Expr<'g>,
}

/// A term with the square of a sine or cosine, and the place of the term that has the other factors, half the
/// coefficient and the other sign.
fn square_and_plain<'g>(terms: &[ArrangedTerm<'g>]) -> Option<(Square<'g>, usize)> {
    let places = terms
        .iter()
        .enumerate()
        .flat_map(|(place, term)| (0..term.factors.len()).map(move |factor| (place, term, factor)));
    places.into_iter().find_map(|(place, term, factor)| {
        let squared = term.factors.get(factor)?;
        let (function, angle) = [Function::Sin, Function::Cos]
            .into_iter()
            .find_map(|function| Some((function, angle_of(squared, function, 2)?)))?;
        let is_plain = |other: &ArrangedTerm<'g>| {
            let rest = term.factors.iter().enumerate().filter(|(at, _)| *at != factor);
            other.negative != term.negative
                && &other.coefficient + &other.coefficient == term.coefficient
                && other.factors.iter().eq(rest.map(|(_, factor)| factor))
        };
        let plain = terms.iter().position(is_plain)?;
        Some((Square { term: place, factor, function, angle }, plain))
    })
}

/// The angle of a factor that is this power of the sine or cosine of an angle.
fn angle_of<'g>(factor: &Factor<'g>, function: Function, exponent: i32) -> Option<Expr<'g>> {
    match factor {
        (ArrangedFactor::Atom(atom), own) if *own == exponent => match atom.view() {
            View::Call(called, angle) if called == function => Some(angle),
            _ => None,
        },
        _ => None,
    }
}
