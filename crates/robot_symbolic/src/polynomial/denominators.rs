//! Terms that cancel a sum in their denominator: a²/(a + b) + a b/(a + b) = a.

use super::PolynomialError;
use super::accumulator::{Term, Terms};
use super::expand::Expander;
use super::monomial::{Factor, Monomial};
use crate::graph::{Function, Id, Node};
use crate::number::Number;

/// The largest number of steps; each lowers the power of a leading term in all terms.
const MAX_STEPS: usize = 64;

/// A sum of products of symbols that is a denominator, `c·leading + others`, by which leading/sum =
/// (1 − others/sum)/c.
struct Denominator {
    atom: Id,
    leading: Monomial,
    coefficient: Number,
    others: Vec<Term>,
}

impl Expander<'_> {
    /// Replaces the leading terms of sums over these sums, if that makes fewer terms. Leading terms are those of a
    /// lexicographic order, so that the steps end; and for sums of which each has a symbol of its own, such as the masses
    /// of bodies that are added one after another, the result does not depend on the order of steps.
    pub(super) fn without_denominators(&mut self, terms: Terms) -> Result<Terms, PolynomialError> {
        let terms = self.without_squared_roots(terms)?;
        let denominators = self.denominators(&terms);
        if denominators.is_empty() {
            return Ok(terms);
        }
        let mut reduced = terms.clone();
        for _ in 0..MAX_STEPS {
            let mut is_done = true;
            let mut sum = vec![];
            for term in &reduced {
                let step = denominators.iter().find_map(|one| one.step(term));
                is_done &= step.is_none();
                match step {
                    Some(step) => sum.extend(step),
                    None => sum.push(term.clone()),
                }
            }
            if is_done {
                break;
            }
            reduced = self.collected(&sum)?;
        }
        Ok(if reduced.len() < terms.len() { reduced } else { terms })
    }

    /// Replaces squares of roots of sums in denominators: 1/√(1 + x²)² = 1/(1 + x²).
    fn without_squared_roots(&mut self, terms: Terms) -> Result<Terms, PolynomialError> {
        let graph = self.graph;
        let is_squared = |factor: &&Factor| {
            let is_root = || matches!(graph.node(factor.atom()), Node::Call(Function::Sqrt, _));
            factor.exponent() <= -2 && factor.is_reducible() && is_root()
        };
        let squared = |monomial: &Monomial| monomial.factors().iter().find(is_squared).copied();
        if terms.iter().all(|(monomial, _)| squared(monomial).is_none()) {
            return Ok(terms);
        }
        let mut sum = vec![];
        for (monomial, number) in terms {
            let Some(root) = squared(&monomial) else {
                sum.push((monomial, number));
                continue;
            };
            let halves = root.exponent().unsigned_abs() / 2;
            let even = Monomial::from_factor(root.with_exponent(2 * halves.cast_signed()));
            // The factor is left out, or its first power stays in the denominator.
            let (rest, _) = monomial.product(&even).ok_or(PolynomialError::ExponentTooLarge)?;
            let square = self.graph.square(root.atom()).0.to_vec();
            let inverse = self.reciprocal(&square)?;
            let inverse = self.power(&inverse, halves)?;
            sum.extend(self.product(&vec![(rest, number)], &inverse)?);
        }
        let sum = self.collected(&sum)?;
        self.without_squared_roots(sum)
    }

    /// The denominators that are sums of products of symbols, in order of their ids.
    fn denominators(&self, terms: &Terms) -> Vec<Denominator> {
        let factors = terms.iter().flat_map(|(monomial, _)| monomial.factors());
        let mut atoms: Vec<Id> = factors
            .filter(|factor| factor.exponent() < 0 && self.graph.sum_terms(factor.atom()).is_some())
            .map(|factor| factor.atom())
            .collect();
        atoms.sort_unstable();
        atoms.dedup();
        atoms.into_iter().filter_map(|atom| self.denominator(atom)).collect()
    }

    fn denominator(&self, atom: Id) -> Option<Denominator> {
        let terms = self.graph.sum_terms(atom)?;
        let is_symbol = |factor: &Factor| {
            matches!(self.graph.node(factor.atom()), Node::Symbol(_)) && factor.exponent() > 0
        };
        let are_symbols = |(monomial, _): &Term| monomial.factors().iter().all(is_symbol);
        if !terms.iter().all(are_symbols) {
            return None;
        }
        let place = (0..terms.len()).max_by_key(|place| rank(&terms[*place].0))?;
        let mut others = terms.to_vec();
        let (leading, coefficient) = others.remove(place);
        Some(Denominator { atom, leading, coefficient, others })
    }
}

/// The key of the lexicographic order, in which later symbols are greater.
fn rank(monomial: &Monomial) -> Vec<(Id, i32)> {
    let mut powers: Vec<_> =
        monomial.factors().iter().map(|factor| (factor.atom(), factor.exponent())).collect();
    powers.sort_unstable_by_key(|power| std::cmp::Reverse(power.0));
    powers
}

impl Denominator {
    /// The terms that replace a term with the leading term over this sum; `None` if the term is not of this kind.
    fn step(&self, (monomial, number): &Term) -> Option<Vec<Term>> {
        if monomial.exponent(self.atom) >= 0 {
            return None;
        }
        let divides = |factor: &Factor| monomial.exponent(factor.atom()) >= factor.exponent();
        if !self.leading.factors().iter().all(divides) {
            return None;
        }
        let (quotient, _) = monomial.product(&self.leading.inverse()?)?;
        let sum = Monomial::from_factor(Factor::new(self.atom, false, 1));
        let scale = number * &self.coefficient.recip();
        let mut terms = vec![(quotient.product(&sum)?.0, scale.clone())];
        for (other, coefficient) in &self.others {
            terms.push((quotient.product(other)?.0, -&(&scale * coefficient)));
        }
        Some(terms)
    }
}
