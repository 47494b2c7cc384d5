//! Quotients of polynomials from which common divisors are canceled.

use rustc_hash::FxHashMap;

use super::accumulator::Terms;
use super::{Monomial, Polynomial, PolynomialOptions};
use crate::expr::Expr;
use crate::graph::Id;
use crate::{View, walk};

/// The largest number of terms of a quotient, and of what is left while it is computed.
const MAX_TERMS: usize = 100;

/// A quotient of a polynomial and a product of sums, each without a common factor and with 1 as its first coefficient.
#[derive(Clone)]
struct Ratio<'g> {
    above: Polynomial<'g>,
    below: Vec<Polynomial<'g>>,
}

/// An expression as a sum of terms over a product of sums, from which the sums that divide the others and the numerator
/// are canceled: (a³ + a b²)/(a⁴ + a² b²) becomes 1/a. `None` if a numerator or a divisor exceeds a limit of the options.
#[must_use]
pub fn reduced<'g>(expr: Expr<'g>, options: &PolynomialOptions) -> Option<Expr<'g>> {
    let mut known: FxHashMap<Id, Ratio<'g>> = FxHashMap::default();
    for part in walk::reachable(&[expr]) {
        let of = |operand: Expr<'g>| known.get(&operand.id()).cloned();
        let ratio = match part.view() {
            // Squares of sines and roots are other terms in a polynomial. A division can then leave a remainder where there
            // is none, but not the reverse.
            View::Number(_) | View::Symbol(_) | View::Pi | View::Call(..) => {
                Ratio { above: Polynomial::of(part, options).ok()?, below: vec![] }
            }
            View::Neg(a) => {
                let Ratio { above, below } = of(a)?;
                Ratio { above: above.neg(), below }
            }
            View::Add(a, b) => of(a)?.plus(of(b)?)?,
            View::Sub(a, b) => {
                let Ratio { above, below } = of(b)?;
                of(a)?.plus(Ratio { above: above.neg(), below })?
            }
            View::Mul(a, b) => of(a)?.times(of(b)?)?,
            View::Div(a, b) => of(a)?.times(of(b)?.inverse()?)?,
        };
        known.insert(part.id(), ratio.canceled()?);
    }
    let Ratio { above, below } = known.remove(&expr.id())?;
    let product = below.iter().map(Polynomial::to_expr).reduce(|product, one| product * one);
    Some(product.map_or(above.to_expr(), |below| above.to_expr() / below))
}

impl<'g> Ratio<'g> {
    fn plus(self, other: Ratio<'g>) -> Option<Ratio<'g>> {
        let (mut below, mut missing) = (self.below.clone(), self.below);
        let mut above = self.above;
        for divisor in other.below {
            match missing.iter().position(|one| *one == divisor) {
                Some(place) => drop(missing.swap_remove(place)),
                None => {
                    above = above.mul(&divisor).ok()?;
                    below.push(divisor);
                }
            }
        }
        let other = missing.iter().try_fold(other.above, |all, one| all.mul(one).ok())?;
        Some(Ratio { above: above.add(&other).ok()?, below })
    }

    fn times(self, other: Ratio<'g>) -> Option<Ratio<'g>> {
        let below = [self.below, other.below].concat();
        Some(Ratio { above: self.above.mul(&other.above).ok()?, below })
    }

    fn inverse(self) -> Option<Ratio<'g>> {
        let one = self.above.of_monomial(&Monomial::one());
        let above = self.below.iter().try_fold(one, |product, one| product.mul(one).ok())?;
        Ratio { above, below: vec![] }.over(&self.above)
    }

    /// The quotient divided by a polynomial, whose common factors go into the numerator.
    fn over(mut self, divisor: &Polynomial<'g>) -> Option<Ratio<'g>> {
        let (first, number) = divisor.terms.first()?;
        let common = divisor.terms.iter().fold(first.clone(), |all, (one, _)| all.common(one));
        let factor = divisor.with_terms(vec![(common.inverse()?, number.recip())]);
        self.above = self.above.mul(&factor).ok()?;
        let divisor = divisor.mul(&factor).ok()?;
        match divisor.terms.as_slice() {
            // sin q − 1/sin q, multiplied by sin q, is −cos² q.
            [(rest, number)] => {
                let inverse = divisor.with_terms(vec![(rest.inverse()?, number.recip())]);
                self.above = self.above.mul(&inverse).ok()?;
            }
            _ => self.below.push(divisor),
        }
        Some(self)
    }

    /// The quotient without the divisors that divide others or the numerator.
    fn canceled(mut self) -> Option<Ratio<'g>> {
        let mut place = 0;
        while let Some(divisor) = self.below.get(place).cloned() {
            let parts = self.below.iter().enumerate();
            let split = parts
                .filter(|(_, one)| **one != divisor)
                .find_map(|(other, one)| Some((other, quotient(one, &divisor)?)));
            if let Some((other, rest)) = split {
                // A divisor is the product of this one and the rest.
                self.below.swap_remove(other);
                self.below.push(divisor);
                self = self.over(&rest)?;
                place = 0;
                continue;
            }
            match quotient(&self.above, &divisor) {
                Some(rest) => {
                    self.below.swap_remove(place);
                    self.above = rest;
                    place = 0;
                }
                None => place += 1,
            }
        }
        Some(self)
    }
}

/// The quotient of two polynomials; `None` if it leaves a remainder.
fn quotient<'g>(whole: &Polynomial<'g>, divisor: &Polynomial<'g>) -> Option<Polynomial<'g>> {
    let (first, number) = divisor.terms.first()?;
    let (inverse, number) = (first.inverse()?, number.recip());
    let (mut rest, mut found): (_, Terms) = (whole.clone(), vec![]);
    while let Some((monomial, coefficient)) = rest.terms.first() {
        if found.len() == MAX_TERMS || rest.len() > MAX_TERMS {
            return None;
        }
        let term = (monomial.product(&inverse)?.0, coefficient * &number);
        let part = divisor.with_terms(vec![term.clone()]).mul(divisor).ok()?;
        rest = rest.sub(&part).ok()?;
        found.push(term);
    }
    Some(whole.with_terms(found))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Graph;

    fn text(of: &str) -> Option<String> {
        let graph = Graph::new();
        let found = reduced(graph.parse(of).unwrap(), &PolynomialOptions::default())?;
        Some(crate::print::to_text(found).unwrap())
    }

    #[test]
    fn common_divisors_are_canceled() {
        for (given, expected) in [
            ("(a^3 + a*b^2)/(a^4 + a^2*b^2)", "1/a"),
            (
                "a^4/(c^2*(a^2 + b^2 + c^2)) + a^2*b^2/(c^2*(a^2 + b^2 + c^2)) + a^2/(a^2 + b^2 + c^2)",
                "a^2/c^2",
            ),
            ("1/(a + b) - 1/(a + b)", "0"),
            ("(a^2 - b^2)/(a - b)", "a + b"),
            ("(2*a + 2*b)/(4*a + 4*b)", "1/2"),
            ("(a + b)/(a - b)", "(a + b)/(a - b)"),
            ("a*(b/(b + c) + c/(b + c))", "a"),
            ("(a*sin(q) + a*sin(q)*cos(q)^2)/(1 + cos(q)^2)/cos(q)", "a*sin(q)/cos(q)"),
            ("(a + sqrt(2)*b)*c/(a*c + sqrt(2)*b*c)", "1"),
            ("x/(sin(q) - 1/sin(q))", "-x*sin(q)/cos(q)^2"),
        ] {
            let graph = Graph::new();
            let [from, to] = [given, expected].map(|text| graph.parse(text).unwrap());
            let found = text(given).unwrap();
            let length = |text: &str| text.replace(['(', ')', ' '], "").len();
            assert!(length(&found) <= length(expected), "{given}: {found}");
            let found = graph.parse(&found).unwrap();
            for seed in 0..4 {
                let value = |expr: Expr<'_>| {
                    expr.evaluate(|symbol| {
                        crate::Random::of_name(&graph.symbol_name(symbol), seed).uniform(0.4, 1.6)
                    })
                };
                let size = value(from).abs().max(1.0);
                assert!((value(found) - value(from)).abs() <= 1e-12 * size, "{given}");
                assert!((value(to) - value(from)).abs() <= 1e-12 * size, "{given}");
            }
        }
    }

    #[test]
    fn long_quotients_are_left() {
        let limits = PolynomialOptions { max_terms: 10, ..PolynomialOptions::default() };
        let graph = Graph::new();
        let long = graph.parse("(a + b + c + d)^5/(a - b)").unwrap();
        assert!(reduced(long, &limits).is_none());
    }
}
