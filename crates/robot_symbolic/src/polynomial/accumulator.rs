//! Sums of products of terms, in which squares of sines and roots are replaced as they arise.

use indexmap::IndexMap;
use rustc_hash::FxBuildHasher;

use super::monomial::Monomial;
use super::packed::Layout;
use super::{PolynomialError, PolynomialOptions};
use crate::graph::Graph;
use crate::number::Number;

/// A monomial with its coefficient.
pub(crate) type Term = (Monomial, Number);

/// Terms sorted by their monomials; no monomial occurs twice, and no coefficient is 0.
pub(super) type Terms = Vec<Term>;

/// The memory and the work that a computation is still allowed.
pub(super) struct Budget {
    max_terms: usize,
    products_left: u64,
    max_products: u64,
    /// The number of terms in finished intermediate results.
    pub(super) live: usize,
}

impl Budget {
    pub(super) fn new(options: &PolynomialOptions) -> Budget {
        Budget {
            max_terms: options.max_terms,
            products_left: options.max_products,
            max_products: options.max_products,
            live: 0,
        }
    }

    pub(super) fn hold(&self, terms: usize) -> Result<(), PolynomialError> {
        if self.live.saturating_add(terms) > self.max_terms {
            return Err(PolynomialError::TooManyTerms { limit: self.max_terms });
        }
        Ok(())
    }

    /// Charges for all products of a term of `a` with a term of `b`. Two terms whose coefficients have the weights v
    /// and w cost 1 + v + w + v w / 8.
    pub(super) fn multiply(&mut self, a: &[Term], b: &[Term]) -> Result<(), PolynomialError> {
        let weights = |terms: &[Term]| -> u64 {
            terms.iter().map(|(_, coefficient)| coefficient.weight()).sum()
        };
        let (m, n) = (a.len() as u64, b.len() as u64);
        let (v, w) = (weights(a), weights(b));
        let products = m
            .saturating_mul(n)
            .saturating_add(m.saturating_mul(w))
            .saturating_add(n.saturating_mul(v))
            .saturating_add(v.saturating_mul(w) / 8);
        self.spend(products)
    }

    fn spend(&mut self, products: u64) -> Result<(), PolynomialError> {
        match self.products_left.checked_sub(products) {
            Some(left) => {
                self.products_left = left;
                Ok(())
            }
            None => Err(PolynomialError::TooManyProducts { limit: self.max_products }),
        }
    }
}

/// The product `factor · a · b`, or `factor · a` without `b`.
pub(super) struct Part<'a> {
    pub(super) a: &'a [Term],
    pub(super) b: Option<&'a [Term]>,
    pub(super) factor: &'a Number,
}

/// Computes a sum of products of reduced terms.
pub(super) fn sum_of_products(
    graph: &Graph,
    budget: &mut Budget,
    parts: &[Part<'_>],
) -> Result<Terms, PolynomialError> {
    match Layout::new(graph, parts) {
        Some(layout) => layout.sum(parts, budget),
        None => sum_unpacked(graph, budget, parts),
    }
}

/// Like [`sum_of_products`], without packing: for monomials of any width and squares of any atoms.
pub(super) fn sum_unpacked(
    graph: &Graph,
    budget: &mut Budget,
    parts: &[Part<'_>],
) -> Result<Terms, PolynomialError> {
    let mut sum = Accumulator { graph, budget, terms: IndexMap::default() };
    for part in parts {
        match part.b {
            Some(b) => sum.add_product(part.a, b, part.factor)?,
            None => sum.add_terms(part.a, part.factor)?,
        }
    }
    Ok(sum.finish())
}

/// A sum under construction.
struct Accumulator<'a> {
    graph: &'a Graph,
    budget: &'a mut Budget,
    terms: IndexMap<Monomial, Number, FxBuildHasher>,
}

impl Accumulator<'_> {
    /// Adds `factor · terms`.
    fn add_terms(&mut self, terms: &[Term], factor: &Number) -> Result<(), PolynomialError> {
        for (monomial, coefficient) in terms {
            self.insert(monomial.clone(), coefficient * factor)?;
        }
        Ok(())
    }

    /// Adds `factor · a · b`.
    fn add_product(
        &mut self,
        a: &[Term],
        b: &[Term],
        factor: &Number,
    ) -> Result<(), PolynomialError> {
        self.budget.multiply(a, b)?;
        for (x, c) in a {
            let scaled = c * factor;
            for (y, d) in b {
                self.add_monomial(x, y, &scaled * d)?;
            }
        }
        Ok(())
    }

    /// Adds `coefficient · x · y`.
    fn add_monomial(
        &mut self,
        x: &Monomial,
        y: &Monomial,
        coefficient: Number,
    ) -> Result<(), PolynomialError> {
        let (monomial, reducible) = x.product(y).ok_or(PolynomialError::ExponentTooLarge)?;
        if reducible {
            self.reduce(monomial, coefficient)
        } else {
            self.insert(monomial, coefficient)
        }
    }

    /// Returns the sum.
    fn finish(self) -> Terms {
        let mut terms: Terms =
            self.terms.into_iter().filter(|(_, coefficient)| !coefficient.is_zero()).collect();
        terms.sort_unstable_by(|(a, _), (b, _)| a.cmp(b));
        terms
    }

    fn insert(&mut self, monomial: Monomial, coefficient: Number) -> Result<(), PolynomialError> {
        match self.terms.entry(monomial) {
            indexmap::map::Entry::Occupied(mut known) => {
                let sum = known.get() + &coefficient;
                known.insert(sum);
                Ok(())
            }
            indexmap::map::Entry::Vacant(free) => {
                free.insert(coefficient);
                self.budget.hold(self.terms.len())
            }
        }
    }

    /// Adds a term after replacing every square: s² by 1 − c², (√x)² by x, and |x|² by x².
    fn reduce(&mut self, monomial: Monomial, coefficient: Number) -> Result<(), PolynomialError> {
        let mut pending = vec![(monomial, coefficient)];
        while let Some((monomial, coefficient)) = pending.pop() {
            let Some((factor, rest)) = monomial.split_square() else {
                self.insert(monomial, coefficient)?;
                continue;
            };
            let square = self.graph.square(factor.atom());
            self.budget.spend(square.0.len() as u64)?;
            for (x, c) in square.0.iter() {
                let (product, _) = rest.product(x).ok_or(PolynomialError::ExponentTooLarge)?;
                pending.push((product, &coefficient * c));
            }
            self.budget.hold(self.terms.len() + pending.len())?;
        }
        Ok(())
    }
}
