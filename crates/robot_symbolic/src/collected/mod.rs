//! Short formulas: sums of products in which common factors are taken out of parentheses, with sines and cosines of
//! sums of angles where these are shorter.
//!
//! A [`Collector`] turns a canonical [`Polynomial`] into a nested sum of products in three steps:
//!
//! 1. In every group of parallel joints, each coefficient is written in the angles between links that make it shortest.
//!    In a small polynomial, all coefficients are also written in the same angles, and the form that gives the shorter
//!    formula in the end is kept (`angles`, `addition`).
//! 2. For each angle, the squares of the sine or those of the cosine are used, whichever gives shorter terms
//!    (`squares`).
//! 3. Common factors are taken out recursively: products of powers, sums that occur several times, and complete squares
//!    (`divisors`, `factoring`). This follows the weak division of R. Brayton and C. McMullen, "The decomposition and
//!    factorization of Boolean expressions", 1982, and the two-term divisors of J. Rajski and J. Vasudevamurthy, 1992.
//!
//! The length of a formula is the number of its printed symbols: a symbol with its index, a number, a sign, an
//! exponent, a pair of parentheses, and the sine or cosine of a sum of angles count one each. When forms are compared,
//! the 1 in k (x + 1) does not count if x has no sine or cosine. Numbers do not change: every printed coefficient is
//! one of the polynomial or an integer. The result is proved equal to the polynomial by expanding it again; if the
//! proof fails, the polynomial is printed as a plain sum.

mod addition;
mod angles;
mod divisors;
mod double;
mod factoring;
mod squares;
mod terms;
#[cfg(test)]
mod tests;
mod variables;

use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, Id};
use crate::polynomial::{Polynomial, PolynomialOptions};
use crate::print::{ArrangedFactor, ArrangedTerm, arranged_value};

pub use angles::{ParallelAngles, Turn};

use factoring::{Factoring, Formula};
use terms::Terms;
use variables::Variables;

/// The largest number of terms of a polynomial that is collected, because the time grows with the third power of it.
pub const MAX_TERMS: usize = 400;

/// A polynomial is also written in each basis of angles as a whole if it has at most this many terms and one group of
/// parallel joints, and if this group has at most `MAX_BASES` bases.
const MAX_WHOLE: usize = 60;
const MAX_BASES: usize = 4;

/// Builds short forms of the polynomials of one graph.
#[derive(Clone, Copy, Debug)]
pub struct Collector<'g, 'a> {
    /// The groups of parallel joints whose sums of angles can be written; empty if all sums of angles are to stay
    /// expanded.
    pub angles: &'a [ParallelAngles<'g>],
    /// Whether common factors are taken out of parentheses.
    pub factors: bool,
    /// Whether 2 sin x cos x is written as sin 2x, and 1 − 2 sin² x and 2 cos² x − 1 as cos 2x. A product sin x cos x
    /// with another coefficient is then ½ sin 2x times this coefficient.
    pub double_angles: bool,
}

impl<'g> Collector<'g, '_> {
    /// Returns the terms of the short form of a polynomial in which angle sums are expanded. The factors of a term are
    /// in the order of the ranks that `rank` gives to atoms; sums in parentheses have the rank `brackets`.
    ///
    /// A polynomial with floating-point numbers or with more than [`MAX_TERMS`] terms is only arranged.
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
        match proved(arranged_value(&terms, polynomial.graph()), polynomial) {
            Some(Proved::Same) if self.double_angles => {
                let compare = |a: &ArrangedFactor<'g>, b: &ArrangedFactor<'g>| match [a, b]
                    .map(ArrangedFactor::as_atom)
                {
                    [Some(a), Some(b)] => rank(a).cmp(&rank(b)),
                    [Some(a), None] => rank(a).cmp(brackets),
                    [None, Some(b)] => brackets.cmp(&rank(b)),
                    [None, None] => Ordering::Equal,
                };
                double::joined(&terms, polynomial.graph(), compare).unwrap_or(terms)
            }
            Some(Proved::Same) => terms,
            // A sum in the numerator has canceled the same sum in a denominator.
            Some(Proved::Shorter(canceled)) => self.collect(&canceled, rank, brackets),
            None => polynomial.arranged(&rank),
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
                true => Factoring::new(&terms, variables.kinds(early)).formula(&terms),
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

/// Cancels each sum in parentheses with the same sum in the denominator of its term.
fn cancel<'g>(terms: &mut [ArrangedTerm<'g>], graph: &'g Graph) {
    let of = |value: Expr<'g>| Polynomial::of(value, &PolynomialOptions::default()).ok();
    for term in terms {
        let divisors = term.factors.iter().enumerate().filter_map(|(place, (factor, exponent))| {
            let atom = factor.as_atom().filter(|_| *exponent < 0)?;
            matches!(atom.view(), View::Add(..) | View::Sub(..)).then(|| (place, of(atom)))
        });
        let divisors: Vec<(usize, Option<Polynomial<'g>>)> = divisors.collect();
        let mut canceled: Vec<(usize, usize)> = vec![];
        for (place, (factor, exponent)) in term.factors.iter_mut().enumerate() {
            let ArrangedFactor::Sum(inner) = factor else { continue };
            cancel(inner, graph);
            if divisors.is_empty() || *exponent < 1 {
                continue;
            }
            let sum = of(arranged_value(inner, graph));
            let same = divisors.iter().find(|(_, divisor)| sum.is_some() && *divisor == sum);
            canceled.extend(same.map(|(divisor, _)| (place, *divisor)));
        }
        for (sum, divisor) in canceled {
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

/// The result of a proof that an expression is equal to a polynomial.
enum Proved<'g> {
    /// It is equal, and has as many terms multiplied out.
    Same,
    /// It is equal and, multiplied out, this polynomial, which has fewer terms: m/(m + n) + n/(m + n) is 1.
    Shorter(Polynomial<'g>),
}

/// Proves that an expression is equal to the polynomial by multiplying it out; `None` if this is not possible within the
/// limits, or with the relations between denominators that the proof knows.
fn proved<'g>(value: Expr<'g>, polynomial: &Polynomial<'g>) -> Option<Proved<'g>> {
    let expanded = Polynomial::of(value, &PolynomialOptions::default()).ok()?;
    if expanded == *polynomial {
        return Some(Proved::Same);
    }
    let difference = expanded.sub(polynomial).ok()?;
    let is_shorter = expanded.len() < polynomial.len();
    let is_zero = is_zero(difference)?;
    // A full graph gives wrong expressions, which prove nothing.
    if polynomial.graph().is_full() {
        return None;
    }
    is_zero.then(|| if is_shorter { Proved::Shorter(expanded) } else { Proved::Same })
}

/// Whether an atom in a denominator is related to other atoms: a sum to its terms, a sine or cosine to the other one.
fn has_relations(atom: Expr<'_>) -> bool {
    matches!(
        atom.view(),
        View::Add(..) | View::Sub(..) | View::Call(Function::Sin | Function::Cos, _)
    )
}

/// The deepest nesting of sums in denominators with which equality is proved.
const MAX_DENOMINATORS: usize = 4;

/// Whether a polynomial is 0 after it is multiplied by the sums, sines and cosines in its denominators: sums are atoms
/// otherwise, and cos² x/sin² x is not reduced to 1/sin² x − 1. `None` if this cannot be decided within the limits.
fn is_zero(mut polynomial: Polynomial<'_>) -> Option<bool> {
    let graph = polynomial.graph();
    for _ in 0..MAX_DENOMINATORS {
        let mut lowest: BTreeMap<Id, i32> = BTreeMap::new();
        for (monomial, _) in polynomial.terms() {
            for factor in monomial.factors().iter().filter(|factor| factor.exponent() < 0) {
                if has_relations(graph.expr(factor.atom())) {
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
