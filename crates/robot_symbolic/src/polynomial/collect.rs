//! Collection of terms by symbols, and derivatives.

use std::collections::BTreeMap;

use indexmap::IndexMap;
use rustc_hash::FxBuildHasher;

use super::accumulator::{Part, Term, Terms};
use super::{Monomial, Polynomial, PolynomialError};
use crate::expr::Expr;
use crate::graph::Id;
use crate::number::Number;

impl<'g> Polynomial<'g> {
    /// Collects the terms by some symbols: returns each monomial in these symbols with its coefficient, a polynomial in
    /// the other atoms.
    ///
    /// The groups are in the order of their monomials. A chosen symbol inside a function, such as q in sin(q), or in a
    /// denominator that is a sum, stays in the coefficient.
    #[must_use]
    pub fn collect(&self, symbols: &[&str]) -> Vec<(Monomial, Polynomial<'g>)> {
        let chosen: Vec<Id> =
            symbols.iter().filter_map(|name| self.graph.find_symbol(name)).map(Expr::id).collect();
        let mut groups: IndexMap<Monomial, Terms, FxBuildHasher> = IndexMap::default();
        for (monomial, number) in &self.terms {
            let (inside, outside) = monomial.partition(|atom| chosen.contains(&atom));
            groups.entry(inside).or_default().push((outside, number.clone()));
        }
        let mut groups: Vec<_> = groups.into_iter().collect();
        groups.sort_unstable_by(|(a, _), (b, _)| a.cmp(b));
        groups
            .into_iter()
            .map(|(monomial, mut terms)| {
                terms.sort_unstable_by(|(a, _), (b, _)| a.cmp(b));
                (monomial, self.with_terms(terms))
            })
            .collect()
    }

    /// Splits the polynomial into polynomials that add up to it. The monomials of each have the same key.
    #[must_use]
    pub fn split_by<K: Ord>(&self, key: impl Fn(&Monomial) -> K) -> BTreeMap<K, Polynomial<'g>> {
        let mut parts: BTreeMap<K, Terms> = BTreeMap::new();
        for term in &self.terms {
            parts.entry(key(&term.0)).or_default().push(term.clone());
        }
        parts.into_iter().map(|(key, terms)| (key, self.with_terms(terms))).collect()
    }

    /// The polynomial that consists of one monomial.
    #[must_use]
    pub fn of_monomial(&self, monomial: &Monomial) -> Polynomial<'g> {
        self.with_terms(vec![(monomial.clone(), Number::integer(1))])
    }

    /// The partial derivative with respect to a symbol; functions of the symbol are differentiated too.
    ///
    /// |x| has the derivative sgn x, and sgn x the derivative 0, everywhere.
    ///
    /// # Errors
    ///
    /// If the result exceeds a limit of the options.
    pub fn derivative(&self, symbol: Expr<'g>) -> Result<Polynomial<'g>, PolynomialError> {
        let atoms = self.atoms();
        let slopes = crate::walk::derivatives(&atoms, symbol);
        let slopes = Polynomial::of_all(&slopes, &self.options)?;
        // Σ over the atoms of (∂p/∂atom) (∂atom/∂symbol).
        let partial = |atom: &Expr<'g>| -> Terms {
            let lowered = |(monomial, number): &Term| {
                let exponent = Number::integer(i64::from(monomial.exponent(atom.id())));
                Some((monomial.lowered(atom.id())?, number * &exponent))
            };
            self.terms.iter().filter_map(lowered).collect()
        };
        let one = Number::integer(1);
        let changing = atoms.iter().zip(&slopes).filter(|(_, slope)| !slope.is_zero());
        let partials: Vec<(Terms, &Polynomial<'g>)> =
            changing.map(|(atom, slope)| (partial(atom), slope)).collect();
        let parts: Vec<Part<'_>> = partials
            .iter()
            .map(|(partial, slope)| Part { a: partial, b: Some(&slope.terms), factor: &one })
            .collect();
        self.sum_parts(&parts)
    }
}
