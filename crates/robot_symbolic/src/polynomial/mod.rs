//! Canonical polynomials of expressions, which decide equality, collect terms and give the form that people read.
//!
//! A [`Polynomial`] is a sum of [`Monomial`]s with exact coefficients. A monomial is a product of powers of *atoms*:
//! symbols, π, sines and cosines, other functions, and sums in denominators, which have negative exponents. Arguments
//! of functions and denominators are canonical themselves, so equal ones are the same atom. Squares are replaced: s² =
//! 1 − c² for the sine and cosine of each angle, (√x)² = x, and |m|² = m² for a monomial m.
//!
//! Take two polynomials in symbols and in sines and cosines of integer combinations of angles. With
//! [`AngleSums::Expand`] they are equal exactly if their terms are. With divisions, roots and fractions of angles,
//! equal terms still prove equality, but different terms prove nothing. Floating-point constants ([`Number::Real`]) are
//! rounded at each step, and their rounded values are compared.

mod accumulator;
mod angles;
mod atoms;
mod collect;
mod decimals;
mod denominators;
mod expand;
mod monomial;
mod packed;
mod quotient;
mod ratio;
mod terms;
#[cfg(test)]
mod tests;

use std::fmt;

use crate::expr::Expr;
use crate::graph::{Graph, Id};
use crate::number::Number;

use accumulator::{Budget, Part, Term, Terms};
pub(crate) use atoms::AtomTable;
pub(crate) use monomial::compare_powers;
pub use monomial::{Factor, Monomial};
pub use ratio::reduced;

/// The treatment of sines and cosines of sums and multiples of angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AngleSums {
    /// Expands them into sines and cosines of single angles: sums always, integer multiples up to [`MAX_MULTIPLE`].
    /// Only this form can decide equality.
    #[default]
    Expand,
    /// Keeps them as atoms, such as sin(q2 + q3).
    Keep,
}

/// The largest multiple of an angle whose sine and cosine are expanded.
pub const MAX_MULTIPLE: i64 = 32;

/// The form of a polynomial, and limits on the work to compute it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PolynomialOptions {
    /// Whether angle sums are expanded or kept.
    pub angle_sums: AngleSums,
    /// The largest number of terms held at once, including intermediate results.
    pub max_terms: usize,
    /// The largest number of products of two terms that one operation can form; a product with a coefficient of more
    /// than 64 bits counts as several.
    pub max_products: u64,
}

impl PolynomialOptions {
    /// The default limits, with angle sums kept as atoms.
    #[must_use]
    pub fn keeping_angle_sums() -> PolynomialOptions {
        PolynomialOptions { angle_sums: AngleSums::Keep, ..PolynomialOptions::default() }
    }
}

/// The default options: angle sums expanded, at most 2 million terms and 100 million products.
impl Default for PolynomialOptions {
    fn default() -> PolynomialOptions {
        PolynomialOptions {
            angle_sums: AngleSums::Expand,
            max_terms: 2_000_000,
            max_products: 100_000_000,
        }
    }
}

/// The error for an expression whose polynomial exceeds a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PolynomialError {
    /// The polynomial needs more terms at once than the options allow.
    #[error("the expanded form has more than {limit} terms")]
    TooManyTerms {
        /// The value of [`PolynomialOptions::max_terms`].
        limit: usize,
    },
    /// The polynomial needs more products of terms than the options allow.
    #[error("the expansion takes more than {limit} products of terms")]
    TooManyProducts {
        /// The value of [`PolynomialOptions::max_products`].
        limit: u64,
    },
    /// The polynomial needs an exponent of 2³¹ or more.
    #[error("an exponent of the expanded form is beyond 2147483647; use smaller powers")]
    ExponentTooLarge,
}

/// A sum of monomials with coefficients, in canonical form.
///
/// ```
/// use robot_symbolic::{Graph, Polynomial, PolynomialOptions};
/// let graph = Graph::new();
/// let options = PolynomialOptions::default();
/// let polynomial = |text: &str| Polynomial::of(graph.parse(text).unwrap(), &options);
/// assert_eq!(polynomial("(sin(a + b) + x)^2")?, polynomial(
///     "x^2 + 2*x*(sin(a)*cos(b) + cos(a)*sin(b)) + 1 - cos(a + b)^2")?);
/// let groups = polynomial("m*(x + y)^2 + g*x")?.collect(&["x", "y"]);
/// assert_eq!(groups.len(), 4); // x^2, x y, x, y^2
/// # Ok::<(), robot_symbolic::PolynomialError>(())
/// ```
#[derive(Clone)]
pub struct Polynomial<'g> {
    graph: &'g Graph,
    options: PolynomialOptions,
    terms: Terms,
}

impl<'g> Polynomial<'g> {
    /// The canonical polynomial of an expression.
    ///
    /// # Errors
    ///
    /// If the polynomial exceeds a limit of the options.
    pub fn of(
        expr: Expr<'g>,
        options: &PolynomialOptions,
    ) -> Result<Polynomial<'g>, PolynomialError> {
        let mut all = Polynomial::of_all(&[expr], options)?;
        Ok(all.pop().unwrap_or_else(|| Polynomial::zero(expr.graph(), options)))
    }

    /// The canonical polynomials of several expressions of one graph; their common parts are expanded only once.
    ///
    /// # Errors
    ///
    /// If the polynomials together exceed a limit of the options.
    pub fn of_all(
        exprs: &[Expr<'g>],
        options: &PolynomialOptions,
    ) -> Result<Vec<Polynomial<'g>>, PolynomialError> {
        let Some(first) = exprs.first() else {
            return Ok(vec![]);
        };
        let graph = first.graph();
        let all = expand::expand(exprs, graph, options)?;
        Ok(all.into_iter().map(|terms| Polynomial { graph, options: *options, terms }).collect())
    }

    /// The polynomial 0.
    #[must_use]
    pub fn zero(graph: &'g Graph, options: &PolynomialOptions) -> Polynomial<'g> {
        Polynomial { graph, options: *options, terms: vec![] }
    }

    /// The graph that contains the atoms.
    #[must_use]
    pub fn graph(&self) -> &'g Graph {
        self.graph
    }

    /// The terms in the order of their monomials; no coefficient is 0. In this order, atoms are sorted by their first
    /// use in the graph, with sines and roots after all others.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Monomial, &Number)> {
        self.terms.iter().map(|(monomial, number)| (monomial, number))
    }

    /// The number of terms.
    #[must_use]
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether this is the polynomial 0, which has no terms.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// Whether this is the polynomial 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.is_empty()
    }

    /// Returns the number if the polynomial is constant.
    #[must_use]
    pub fn as_number(&self) -> Option<Number> {
        terms::as_number(&self.terms)
    }

    /// The atoms that occur, in order of their ids: symbols, π, functions, and sums in denominators.
    #[must_use]
    pub fn atoms(&self) -> Vec<Expr<'g>> {
        let factors = self.terms.iter().flat_map(|(monomial, _)| monomial.factors());
        let mut ids: Vec<Id> = factors.map(|factor| factor.atom()).collect();
        ids.sort_unstable();
        ids.dedup();
        ids.into_iter().map(|id| self.graph.expr(id)).collect()
    }

    /// The sum of two polynomials.
    ///
    /// # Errors
    ///
    /// If the result exceeds a limit of the options of `self`.
    pub fn add(&self, other: &Polynomial<'g>) -> Result<Polynomial<'g>, PolynomialError> {
        self.combine(other, 1)
    }

    /// The difference of two polynomials.
    ///
    /// # Errors
    ///
    /// If the result exceeds a limit of the options of `self`.
    pub fn sub(&self, other: &Polynomial<'g>) -> Result<Polynomial<'g>, PolynomialError> {
        self.combine(other, -1)
    }

    /// The product of two polynomials.
    ///
    /// # Errors
    ///
    /// If the result exceeds a limit of the options of `self`.
    pub fn mul(&self, other: &Polynomial<'g>) -> Result<Polynomial<'g>, PolynomialError> {
        self.sum_parts(&[Part {
            a: &self.terms,
            b: Some(&other.terms),
            factor: &Number::integer(1),
        }])
    }

    /// The negative of the polynomial.
    #[must_use]
    pub fn neg(&self) -> Polynomial<'g> {
        self.scale(&Number::integer(-1))
    }

    /// The product of the polynomial and a number.
    #[must_use]
    pub fn scale(&self, factor: &Number) -> Polynomial<'g> {
        self.with_terms(terms::scaled(&self.terms, factor))
    }

    /// Converts the polynomial to an expression that adds its terms one after the other.
    #[must_use]
    pub fn to_expr(&self) -> Expr<'g> {
        terms::to_expr(&self.terms, self.graph)
    }

    /// Returns the value of the polynomial; `value` gives the value of each symbol.
    #[must_use]
    pub fn evaluate(&self, value: impl Fn(crate::SymbolId) -> f64) -> f64 {
        let atoms = self.atoms();
        let values = crate::walk::evaluate(&atoms, value);
        let at = |atom: Id| {
            let place = atoms.binary_search_by_key(&atom, |known| known.id());
            place.map_or(f64::NAN, |place| values[place])
        };
        let term = |(monomial, number): &Term| {
            let powers = monomial.factors().iter();
            number.to_f64()
                * powers.map(|factor| at(factor.atom()).powi(factor.exponent())).product::<f64>()
        };
        self.terms.iter().map(term).sum()
    }

    fn combine(&self, other: &Polynomial<'g>, sign: i64) -> Result<Self, PolynomialError> {
        let part = |a, factor| Part { a, b: None, factor };
        self.sum_parts(&[
            part(&self.terms, &Number::integer(1)),
            part(&other.terms, &Number::integer(sign)),
        ])
    }

    fn sum_parts(&self, parts: &[Part<'_>]) -> Result<Self, PolynomialError> {
        let mut budget = Budget::new(&self.options);
        let terms = accumulator::sum_of_products(self.graph, &mut budget, parts)?;
        Ok(self.with_terms(terms))
    }

    fn with_terms(&self, terms: Terms) -> Polynomial<'g> {
        Polynomial { terms, ..*self }
    }
}

/// Compares terms. For polynomials of one graph and with the same [`AngleSums`], this decides equality as described in
/// the [module's documentation](self).
impl PartialEq for Polynomial<'_> {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.graph, other.graph) && self.terms == other.terms
    }
}

impl fmt::Debug for Polynomial<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(&self.terms).finish()
    }
}

/// Whether an expression is 0 after products and angle sums are expanded and squares of sines are replaced.
///
/// # Errors
///
/// If the polynomial exceeds the default limits.
pub fn expands_to_zero(expr: Expr<'_>) -> Result<bool, PolynomialError> {
    Ok(Polynomial::of(expr, &PolynomialOptions::default())?.is_zero())
}

/// Whether two expressions of one graph have the same canonical polynomial.
///
/// # Errors
///
/// If the polynomial of the difference exceeds the default limits.
pub fn equal<'g>(a: Expr<'g>, b: Expr<'g>) -> Result<bool, PolynomialError> {
    expands_to_zero(a - b)
}
