//! Short formulas: sums of products with what they have in common taken out of brackets, and sines
//! and cosines of sums of angles where these are shorter.
//!
//! A [`Collector`] turns a canonical [`Polynomial`] into a nested sum of products. Its steps:
//!
//! 1. in every group of parallel joints, each coefficient is written in the angles between links that make it
//!    shortest, and in small groups all coefficients in the same angles, whichever gives the shorter formula in the end
//!    (`angles`, `addition`);
//! 2. of the squares of a sine and a cosine the shorter one is chosen (`squares`);
//! 3. common factors are taken out, recursively: products of powers, sums that occur several times, and
//!    complete squares (`divisors`, `factoring`), after the weak division of R. Brayton and C. McMullen, "The
//!    decomposition and factorization of Boolean expressions", 1982, and the two-term divisors of
//!    J. Rajski and J. Vasudevamurthy, 1992.
//!
//! The length of a formula is the number of its printed symbols: a symbol with its index, a number, a sign, an
//! exponent, a pair of brackets, and the sine or cosine of a sum of angles count one each. Numbers do not
//! change: no coefficient is printed that is neither in the polynomial nor an integer. The result is proved equal
//! to the polynomial by expanding it again; what cannot be proved is left as the sum that it was.

mod addition;
mod angles;
mod divisors;
mod factoring;
mod squares;
mod terms;
#[cfg(test)]
mod tests;
mod variables;

use std::collections::BTreeMap;

use crate::expr::{Expr, View};
use crate::graph::{Graph, Id};
use crate::polynomial::{Polynomial, PolynomialOptions};
use crate::print::{ArrangedFactor, ArrangedTerm};

pub use angles::{ParallelAngles, Turn};

use factoring::{Factoring, Formula};
use terms::Terms;
use variables::Variables;

/// Polynomials with more terms are not collected: the time grows with the third power of their number.
pub const MAX_TERMS: usize = 400;

/// A polynomial of at most so many terms, with one group of parallel joints of at most so many bases of angles, is tried in
/// each basis as a whole, too.
const MAX_WHOLE: usize = 60;
const MAX_BASES: usize = 4;

/// Builds short forms of the polynomials of one graph.
#[derive(Clone, Copy, Debug)]
pub struct Collector<'g, 'a> {
    /// Groups of parallel joints, whose sums of angles may be written; none if sums of angles are to be expanded.
    pub angles: &'a [ParallelAngles<'g>],
    /// Whether common factors are taken out of parentheses.
    pub factors: bool,
}

impl<'g> Collector<'g, '_> {
    /// The terms of the short form of a polynomial in which angle sums are expanded, with the factors in the
    /// order of the ranks that `rank` gives to atoms; sums in brackets have the rank `brackets`.
    ///
    /// A polynomial that has floating-point numbers or more than [`MAX_TERMS`] terms is arranged as it is.
    #[must_use]
    pub fn collect<K: Ord>(
        &self,
        polynomial: &Polynomial<'g>,
        rank: impl Fn(Expr<'g>) -> K,
        brackets: &K,
    ) -> Vec<ArrangedTerm<'g>> {
        let Some(mut terms) = self.collected(polynomial, &rank, brackets) else {
            return polynomial.arranged(&rank);
        };
        cancel(&mut terms, polynomial.graph());
        match proved(&terms, polynomial) {
            Some(Proved::Same) => terms,
            // A factor has met the same sum under a fraction bar.
            Some(Proved::Shorter(cancelled)) => self.collect(&cancelled, rank, brackets),
            None => {
                debug_assert!(false, "a collected formula differs from its polynomial");
                polynomial.arranged(&rank)
            }
        }
    }

    fn collected<K: Ord>(
        &self,
        polynomial: &Polynomial<'g>,
        rank: &impl Fn(Expr<'g>) -> K,
        brackets: &K,
    ) -> Option<Vec<ArrangedTerm<'g>>> {
        if polynomial.len() > MAX_TERMS {
            return None;
        }
        let variables = Variables::new(polynomial, self.angles, rank);
        let terms = variables.read(polynomial)?;
        let groups = variables.groups();
        let early = variables.before(|atom| rank(atom) < *brackets);
        let formula = |terms: Terms| {
            let terms = squares::chosen(&terms, &variables);
            match self.factors {
                true => Factoring::new(&terms, early).formula(&terms),
                false => Formula::flat(&terms),
            }
        };
        let shortest =
            groups.iter().fold(terms.clone(), |terms, group| group.shortest(&terms, &variables));
        let mut best = formula(shortest);
        if let [group] = groups
            && self.factors
            && group.bases.len() <= MAX_BASES
            && terms.len() <= MAX_WHOLE
        {
            let others = group.in_bases(&terms, &variables).map(formula);
            best = others.fold(best, |best, other| match other.length() < best.length() {
                true => other,
                false => best,
            });
        }
        Some(variables.written(&best, early))
    }
}

/// The length of a sum: the number of its printed symbols.
#[must_use]
pub fn length(terms: &[ArrangedTerm<'_>]) -> usize {
    let signs =
        terms.len().saturating_sub(1) + usize::from(terms.first().is_some_and(|it| it.negative));
    signs + terms.iter().map(term_length).sum::<usize>()
}

fn term_length(term: &ArrangedTerm<'_>) -> usize {
    let factor = |(factor, exponent): &(ArrangedFactor<'_>, i32)| {
        let raised = usize::from(exponent.unsigned_abs() > 1);
        match factor {
            ArrangedFactor::Atom(_) => 1 + raised,
            ArrangedFactor::Sum(terms) => length(terms) + 1 + raised,
        }
    };
    let bar = usize::from(term.factors.iter().any(|(_, exponent)| *exponent < 0));
    let number = usize::from(term.factors.is_empty() || !term.coefficient.is_one());
    number + bar + term.factors.iter().map(factor).sum::<usize>()
}

/// Cancels sums in brackets that are in the same term's denominator.
fn cancel<'g>(terms: &mut [ArrangedTerm<'g>], graph: &'g Graph) {
    let of = |value: Expr<'g>| Polynomial::of(value, &PolynomialOptions::default()).ok();
    for term in terms {
        let divisors = term.factors.iter().enumerate().filter_map(|(place, (factor, exponent))| {
            let atom = factor.as_atom().filter(|_| *exponent < 0)?;
            matches!(atom.view(), View::Add(..) | View::Sub(..)).then(|| (place, of(atom)))
        });
        let divisors: Vec<(usize, Option<Polynomial<'g>>)> = divisors.collect();
        let mut cancelled: Vec<(usize, usize)> = vec![];
        for (place, (factor, exponent)) in term.factors.iter_mut().enumerate() {
            let ArrangedFactor::Sum(inner) = factor else { continue };
            cancel(inner, graph);
            if divisors.is_empty() || *exponent < 1 {
                continue;
            }
            let sum = of(crate::print::arranged_value(inner, graph));
            let same = divisors.iter().find(|(_, divisor)| sum.is_some() && *divisor == sum);
            cancelled.extend(same.map(|(divisor, _)| (place, *divisor)));
        }
        for (sum, divisor) in cancelled {
            let [Some((_, above)), Some((_, below))] =
                [sum, divisor].map(|at| term.factors.get(at))
            else {
                continue;
            };
            let common = (*above).min(-*below);
            for (place, by) in [(sum, -common), (divisor, common)] {
                if let Some((_, exponent)) = term.factors.get_mut(place) {
                    *exponent += by;
                }
            }
        }
        term.factors.retain(|(_, exponent)| *exponent != 0);
    }
}

/// What is known of terms that are equal to a polynomial.
enum Proved<'g> {
    /// They stay.
    Same,
    /// Multiplied out they are this polynomial, which has fewer terms: m/(m + n) + n/(m + n) is 1.
    Shorter(Polynomial<'g>),
}

/// Whether terms, multiplied out, are the polynomial.
fn proved<'g>(terms: &[ArrangedTerm<'g>], polynomial: &Polynomial<'g>) -> Option<Proved<'g>> {
    let value = crate::print::arranged_value(terms, polynomial.graph());
    let expanded = Polynomial::of(value, &PolynomialOptions::default()).ok()?;
    if expanded == *polynomial {
        return Some(Proved::Same);
    }
    let difference = expanded.sub(polynomial).ok()?;
    let is_shorter = expanded.len() < polynomial.len();
    is_zero(difference)?.then_some(if is_shorter {
        Proved::Shorter(expanded)
    } else {
        Proved::Same
    })
}

/// Sums under the fraction bars of sums: beyond this depth nothing is proved.
const MAX_DENOMINATORS: usize = 4;

/// Whether a polynomial is 0 once it is multiplied by the sums in its denominators, which are atoms to it.
fn is_zero(mut polynomial: Polynomial<'_>) -> Option<bool> {
    let graph = polynomial.graph();
    for _ in 0..MAX_DENOMINATORS {
        let mut lowest: BTreeMap<Id, i32> = BTreeMap::new();
        for (monomial, _) in polynomial.terms() {
            for factor in monomial.factors().iter().filter(|factor| factor.exponent() < 0) {
                if matches!(graph.expr(factor.atom()).view(), View::Add(..) | View::Sub(..)) {
                    let known = lowest.entry(factor.atom()).or_default();
                    *known = factor.exponent().min(*known);
                }
            }
        }
        if lowest.is_empty() {
            return Some(polynomial.is_zero());
        }
        let value = polynomial.terms().fold(graph.zero(), |sum, (monomial, number)| {
            let own = monomial.factors().iter().filter(|it| !lowest.contains_key(&it.atom()));
            let own = own.map(|factor| graph.expr(factor.atom()).powi(factor.exponent()));
            let raised = lowest.iter().map(|(atom, exponent)| {
                graph.expr(*atom).powi(monomial.exponent(*atom).saturating_sub(*exponent))
            });
            sum + own.chain(raised).fold(graph.number(number.clone()), |a, b| a * b)
        });
        polynomial = Polynomial::of(value, &PolynomialOptions::default()).ok()?;
    }
    None
}
