//! Reciprocals of polynomials.

use super::PolynomialError;
use super::accumulator::{Term, Terms};
use super::expand::Expander;
use super::monomial::{Factor, Monomial};
use super::terms;
use crate::number::Number;

impl Expander<'_> {
    /// Returns `1 / divisor`: the inverse of the largest monomial that divides all terms, times the negative first
    /// power of the remaining sum, which becomes an atom.
    pub(super) fn reciprocal(&mut self, divisor: &Terms) -> Result<Terms, PolynomialError> {
        match divisor.as_slice() {
            // The reciprocal of 0 is NaN, as for numbers.
            [] => Ok(terms::constant(Number::integer(0).recip())),
            [(monomial, coefficient)] => self.inverse_term(monomial, coefficient),
            _ => {
                let denominators =
                    content(divisor).partition(|atom| self.graph.sum_terms(atom).is_some()).0;
                if denominators.is_one() {
                    return self.inverse_polynomial(divisor);
                }
                let cleared = self.clear(divisor, &denominators)?;
                let inverse = match cleared.as_slice() {
                    [] => terms::constant(Number::integer(0).recip()),
                    [(monomial, coefficient)] => self.inverse_term(monomial, coefficient)?,
                    _ => self.inverse_polynomial(&cleared)?,
                };
                let raised = self.inverse_term(&denominators, &Number::integer(1))?;
                self.product(&raised, &inverse)
            }
        }
    }

    /// Multiplies the terms of the divisor by their common denominators, so that they have no denominators.
    fn clear(
        &mut self,
        divisor: &Terms,
        denominators: &Monomial,
    ) -> Result<Terms, PolynomialError> {
        let overflow = PolynomialError::ExponentTooLarge;
        let inverse = denominators.inverse().ok_or(overflow)?;
        let mut sum = vec![];
        for (monomial, coefficient) in divisor {
            let (product, _) = monomial.product(&inverse).ok_or(overflow)?;
            let (sums, rest) = product.partition(|atom| self.graph.sum_terms(atom).is_some());
            // `sums` are inverted twice, because `inverse_term` expands a sum with a negative exponent into its terms.
            let sums = sums.inverse().ok_or(overflow)?;
            let raised = self.inverse_term(&sums, &Number::integer(1))?;
            let term = vec![(rest, coefficient.clone())];
            sum.extend(self.product(&raised, &term)?);
        }
        self.collected(&sum)
    }

    /// The reciprocal of a sum of several terms without denominators.
    fn inverse_polynomial(&mut self, divisor: &Terms) -> Result<Terms, PolynomialError> {
        let one = Number::integer(1);
        let leading = divisor.first().map_or(&one, |(_, coefficient)| coefficient);
        let scale = match leading {
            Number::Rational(_) => leading.recip(),
            Number::Real(_) if leading.is_negative() => Number::integer(-1),
            Number::Real(_) => one.clone(),
        };
        let content = content(divisor);
        let inverse = content.inverse().ok_or(PolynomialError::ExponentTooLarge)?;
        let primitive = self.product(divisor, &vec![(inverse, scale.clone())])?;
        let atom = self.inverse_sum(&primitive)?;
        let content = self.inverse_term(&content, &scale.recip())?;
        self.product(&content, &atom)
    }

    /// Returns `1 / sum` as the negative power of an atom.
    fn inverse_sum(&mut self, sum: &[Term]) -> Result<Terms, PolynomialError> {
        let canonical = terms::to_expr(sum, self.graph);
        let (coefficient, atom) = self.graph.sum_atom(sum, canonical);
        let monomial = match atom {
            Some(atom) => Monomial::from_factor(self.graph.factor(atom))
                .inverse()
                .ok_or(PolynomialError::ExponentTooLarge)?,
            None => Monomial::one(),
        };
        Ok(vec![(monomial, coefficient.recip())])
    }

    /// Returns `1 / (coefficient · monomial)`. A sum with a negative exponent is expanded into its terms, and the root
    /// of a monomial moves to the numerator: 1/√x = √x/x.
    fn inverse_term(
        &mut self,
        monomial: &Monomial,
        coefficient: &Number,
    ) -> Result<Terms, PolynomialError> {
        let mut result = terms::constant(coefficient.recip());
        let mut pending = monomial.factors().to_vec();
        while let Some(factor) = pending.pop() {
            let exponent = factor.exponent();
            let value = if let Some((x, number)) = self.square_term(factor) {
                pending.extend(x.factors());
                vec![(Monomial::from_factor(factor), number.recip())]
            } else if let Some(base) = self.graph.sum_terms(factor.atom())
                && exponent < 0
            {
                self.power(&base, exponent.unsigned_abs())?
            } else {
                let power = Monomial::from_factor(factor).inverse();
                let power = power.ok_or(PolynomialError::ExponentTooLarge)?;
                vec![(power, Number::integer(1))]
            };
            result = self.product(&result, &value)?;
        }
        Ok(result)
    }

    /// The square of a root if it is a single term. Only the first power is considered, because higher powers of roots
    /// are replaced.
    fn square_term(&self, factor: Factor) -> Option<(Monomial, Number)> {
        if !factor.is_reducible() || factor.exponent() != 1 {
            return None;
        }
        match self.graph.square(factor.atom()).0.as_ref() {
            [term] => Some(term.clone()),
            _ => None,
        }
    }

    pub(super) fn power(&mut self, base: &[Term], exponent: u32) -> Result<Terms, PolynomialError> {
        let mut result = terms::constant(Number::integer(1));
        let (mut square, mut rest) = (base.to_vec(), exponent);
        while rest > 0 {
            if rest & 1 == 1 {
                result = self.product(&result, &square)?;
            }
            rest >>= 1;
            if rest > 0 {
                square = self.product(&square, &square)?;
            }
        }
        Ok(result)
    }
}

/// The largest monomial that divides all terms.
fn content(terms: &Terms) -> Monomial {
    let mut monomials = terms.iter().map(|(monomial, _)| monomial);
    let first = monomials.next().cloned().unwrap_or_default();
    monomials.fold(first, |content, monomial| content.common(monomial))
}
