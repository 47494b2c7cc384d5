//! Rounded coefficients.

use indexmap::IndexMap;
use rustc_hash::{FxBuildHasher, FxHashMap};

use super::accumulator::Terms;
use super::{Monomial, Polynomial};
use crate::graph::Id;
use crate::number::Number;
use crate::walk;

impl<'g> Polynomial<'g> {
    /// Whether all coefficients are exact.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.terms.iter().all(|(_, number)| number.as_rational().is_some())
    }

    /// The polynomial with one number for the constants of each term, such as those of 0.35 √2 a. Floating-point
    /// numbers below `residue` times the largest coefficient are rounding errors of terms that cancel, and are left
    /// out.
    #[must_use]
    pub fn in_decimals(&self, residue: f64) -> Polynomial<'g> {
        let constants: FxHashMap<Id, f64> = self
            .atoms()
            .into_iter()
            .filter(|atom| walk::symbols(&[*atom]).is_empty())
            .map(|atom| (atom.id(), atom.evaluate(|_| f64::NAN)))
            .collect();
        let value = |constant: &Monomial| {
            let factors = constant.factors().iter();
            let powers = factors.map(|factor| {
                let base = constants.get(&factor.atom()).copied().unwrap_or(f64::NAN);
                base.powi(factor.exponent())
            });
            powers.product::<f64>()
        };
        let mut sums: IndexMap<Monomial, Number, FxBuildHasher> = IndexMap::default();
        for (monomial, number) in &self.terms {
            let (constant, rest) = monomial.partition(|atom| constants.contains_key(&atom));
            let number = match constant.is_one() {
                true => number.clone(),
                false => number * &Number::real(value(&constant)),
            };
            let sum = sums.entry(rest).or_insert(Number::integer(0));
            *sum = &*sum + &number;
        }
        let size = |number: &Number| number.to_f64().abs();
        let least = residue * sums.values().map(size).fold(0.0, f64::max);
        let is_kept = |number: &Number| match number {
            Number::Rational(rational) => !rational.is_zero(),
            // A value that is not a number stays.
            Number::Real(real) => real.value().is_nan() || real.value().abs() > least,
        };
        let mut terms: Terms = sums.into_iter().filter(|(_, number)| is_kept(number)).collect();
        terms.sort_unstable_by(|(a, _), (b, _)| a.cmp(b));
        self.with_terms(terms)
    }
}

#[cfg(test)]
mod tests {
    use crate::{Graph, Number, Polynomial, PolynomialOptions};

    #[test]
    fn constants_of_terms_become_one_number_and_rounding_errors_vanish() {
        let graph = Graph::new();
        let (root, tiny) = (0.5_f64.sqrt(), -2.2e-16);
        let [root, tiny] = [root, tiny].map(|value| graph.number(Number::real(value)));
        let [a, b] = ["a", "b"].map(|name| graph.symbol(name));
        let sum = graph.parse("2*sqrt(2)*a + 1/3*b + 1/10^20*a*b").unwrap();
        let whole = Polynomial::of(sum + root * a + tiny * b * b, &PolynomialOptions::default());
        let whole = whole.unwrap();
        assert!(!whole.is_exact());
        let text = whole.in_decimals(1e-14).to_text().unwrap();
        // What is exact stays, however small.
        assert!(text.contains("1/3*b") && text.contains("a*b") && !text.contains("b^2"), "{text}");
        assert!(text.contains("3.53553390593") && !text.contains("sqrt"), "{text}");
        let kept = whole.in_decimals(0.0).to_text().unwrap();
        assert!(kept.contains("b^2"), "{kept}");
        let exact = Polynomial::of(sum, &PolynomialOptions::default()).unwrap();
        assert!(exact.is_exact());
    }
}
