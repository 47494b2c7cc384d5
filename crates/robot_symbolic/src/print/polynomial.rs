//! Polynomials as sums of terms, in an order that the caller chooses.

use std::cmp::Ordering;

use rustc_hash::FxHashMap;

use super::{MAX_OPERATIONS, MAX_POWER, TooLarge, number, written_operations};
use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, Id};
use crate::number::Number;
use crate::polynomial::{Polynomial, compare_powers};
use crate::print::to_text;

/// A term of a sum, in the form in which it is printed.
#[derive(Clone, Debug, PartialEq)]
pub struct ArrangedTerm<'g> {
    /// Whether the term is subtracted.
    pub negative: bool,
    /// The absolute value of the coefficient.
    pub coefficient: Number,
    /// The factors with their exponents, which are not 0, in the order of printing.
    pub factors: Vec<(ArrangedFactor<'g>, i32)>,
}

/// A factor of a term.
#[derive(Clone, Debug, PartialEq)]
pub enum ArrangedFactor<'g> {
    /// A symbol, π, a function, or a sum in a denominator.
    Atom(Expr<'g>),
    /// A sum of at least two terms in parentheses, as [`crate::collected`] builds it.
    Sum(Vec<ArrangedTerm<'g>>),
}

impl<'g> ArrangedTerm<'g> {
    /// The product of a sum and further factors, as one term. A sum of several terms becomes a factor in parentheses
    /// before the others; its signs are chosen so that it does not begin with a minus sign.
    #[must_use]
    pub fn product(sum: &[ArrangedTerm<'g>], factors: Vec<(ArrangedFactor<'g>, i32)>) -> Self {
        if let [single] = sum {
            let own = single.factors.iter().cloned();
            return ArrangedTerm { factors: own.chain(factors).collect(), ..single.clone() };
        }
        let negative = sum.first().is_some_and(|first| first.negative);
        let signed = |term: &ArrangedTerm<'g>| ArrangedTerm {
            negative: term.negative != negative,
            ..term.clone()
        };
        let sum = ArrangedFactor::Sum(sum.iter().map(signed).collect());
        let factors = std::iter::once((sum, 1)).chain(factors).collect();
        ArrangedTerm { negative, coefficient: Number::integer(1), factors }
    }
}

impl<'g> ArrangedFactor<'g> {
    /// Returns the atom if the factor is one; all factors of [`Polynomial::arranged`] are atoms.
    #[must_use]
    pub const fn as_atom(&self) -> Option<Expr<'g>> {
        match self {
            ArrangedFactor::Atom(atom) => Some(*atom),
            ArrangedFactor::Sum(_) => None,
        }
    }
}

/// Converts a sum of terms to an expression.
#[must_use]
pub fn arranged_value<'g>(terms: &[ArrangedTerm<'g>], graph: &'g Graph) -> Expr<'g> {
    terms.iter().fold(graph.zero(), |sum, term| {
        let factors = term.factors.iter().map(|(factor, exponent)| match factor {
            ArrangedFactor::Atom(atom) => atom.powi(*exponent),
            ArrangedFactor::Sum(terms) => arranged_value(terms, graph).powi(*exponent),
        });
        let product = factors.fold(graph.number(term.coefficient.clone()), |a, b| a * b);
        if term.negative { sum - product } else { sum + product }
    })
}

/// The atoms of a sum of terms, in the order of their appearance.
#[must_use]
pub fn atoms<'g>(terms: &[ArrangedTerm<'g>]) -> Vec<Expr<'g>> {
    let factors = terms.iter().flat_map(|term| &term.factors);
    factors
        .flat_map(|(factor, _)| match factor {
            ArrangedFactor::Atom(atom) => vec![*atom],
            ArrangedFactor::Sum(terms) => atoms(terms),
        })
        .collect()
}

/// Writes a sum of arranged terms as infix text.
///
/// # Errors
///
/// If an argument of a function is too long to be written out.
pub fn arranged_text(terms: &[ArrangedTerm<'_>]) -> Result<String, TooLarge> {
    let mut atoms = AtomTexts::default();
    atoms.sum(terms)
}

/// The default rank of atoms: symbols and π come first, then sines and cosines, other functions, and sums. Atoms of
/// equal rank are in the order of their first use in the graph.
#[must_use]
pub fn default_rank(atom: Expr<'_>) -> u8 {
    match atom.view() {
        View::Symbol(_) | View::Pi => 0,
        View::Call(Function::Sin | Function::Cos, _) => 1,
        View::Call(..) => 2,
        _ => 3,
    }
}

impl<'g> Polynomial<'g> {
    /// Arranges the terms by the ranks that `rank` gives to atoms. The factors of a term are in ascending order of
    /// their ranks, and factors of equal rank in the order of their first use in the graph. The terms are ordered by
    /// their powers of these atoms: higher powers of the first atom first.
    #[must_use]
    pub fn arranged<K: Ord>(&self, rank: impl Fn(Expr<'g>) -> K) -> Vec<ArrangedTerm<'g>> {
        let mut atoms: Vec<(K, Expr<'g>)> =
            self.atoms().into_iter().map(|atom| (rank(atom), atom)).collect();
        atoms.sort_by(|(a, x), (b, y)| a.cmp(b).then(x.id().cmp(&y.id())));
        let places: FxHashMap<Id, u32> =
            atoms.iter().zip(0..).map(|((_, atom), place)| (atom.id(), place)).collect();
        let powers = |monomial: &crate::Monomial| {
            let place = |atom| places.get(&atom).copied().unwrap_or_default();
            let factors = monomial.factors().iter();
            let mut powers: Vec<(u32, i32)> =
                factors.map(|factor| (place(factor.atom()), factor.exponent())).collect();
            powers.sort_unstable();
            powers
        };
        let mut terms: Vec<(Vec<(u32, i32)>, &Number)> =
            self.terms().map(|(monomial, number)| (powers(monomial), number)).collect();
        terms.sort_by(|(a, _), (b, _)| listed(a, b));
        let atom = |(place, exponent): &(u32, i32)| {
            Some((ArrangedFactor::Atom(atoms.get(*place as usize)?.1), *exponent))
        };
        terms
            .into_iter()
            .map(|(powers, number)| ArrangedTerm {
                negative: number.is_negative(),
                coefficient: if number.is_negative() { -number } else { number.clone() },
                factors: powers.iter().filter_map(atom).collect(),
            })
            .collect()
    }

    /// Writes the polynomial as infix text, in the order of [`default_rank`].
    ///
    /// ```
    /// use robot_symbolic::{Graph, Polynomial, PolynomialOptions};
    /// let graph = Graph::new();
    /// let expr = graph.parse("(m*l*(sin(q)*(l*qdd - g) + 0.35*l*(1 - 3*qd^2)))/2").unwrap();
    /// let polynomial = Polynomial::of(expr, &PolynomialOptions::default()).unwrap();
    /// assert_eq!(
    ///     polynomial.to_text().unwrap(),
    ///     "0.5*m*l^2*qdd*sin(q) - 0.525*m*l^2*qd^2 + 0.175*m*l^2 - 0.5*m*l*g*sin(q)"
    /// );
    /// ```
    ///
    /// # Errors
    ///
    /// If an argument of a function is too long to be written out.
    pub fn to_text(&self) -> Result<String, TooLarge> {
        self.to_text_by(default_rank)
    }

    /// Writes the polynomial as infix text, arranged by ranks of its atoms (see [`Polynomial::arranged`]).
    ///
    /// # Errors
    ///
    /// If an argument of a function is too long to be written out.
    pub fn to_text_by<K: Ord>(&self, rank: impl Fn(Expr<'g>) -> K) -> Result<String, TooLarge> {
        arranged_text(&self.arranged(rank))
    }
}

/// The order in which two products of powers are listed.
fn listed(a: &[(u32, i32)], b: &[(u32, i32)]) -> Ordering {
    compare_powers(a, b, |power| *power)
}

fn atom_text(atom: Expr<'_>) -> Result<String, TooLarge> {
    let text = to_text(atom)?;
    Ok(match atom.view() {
        View::Symbol(_) | View::Pi | View::Call(..) => text,
        _ => format!("({text})"),
    })
}

/// The texts of atoms; each text is made once.
#[derive(Default)]
struct AtomTexts {
    known: FxHashMap<Id, String>,
    operations: u64,
}

impl AtomTexts {
    fn sum(&mut self, terms: &[ArrangedTerm<'_>]) -> Result<String, TooLarge> {
        if terms.is_empty() {
            return Ok("0".to_owned());
        }
        let mut text = String::new();
        for (place, term) in terms.iter().enumerate() {
            text.push_str(match (place, term.negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            });
            text.push_str(&self.term(term)?);
        }
        Ok(text)
    }

    /// Writes a term such as `c*x*y^2/(z*w)`.
    fn term(&mut self, term: &ArrangedTerm<'_>) -> Result<String, TooLarge> {
        let mut numerator: Vec<String> = vec![];
        let mut denominator: Vec<String> = vec![];
        for (factor, exponent) in &term.factors {
            let name = match factor {
                ArrangedFactor::Atom(atom) => self.atom(*atom)?,
                ArrangedFactor::Sum(terms) => format!("({})", self.sum(terms)?),
            };
            let side = if *exponent > 0 { &mut numerator } else { &mut denominator };
            push_power(side, &name, exponent.unsigned_abs());
        }
        if !term.coefficient.is_one() || numerator.is_empty() {
            numerator.insert(0, number::magnitude_text(&term.coefficient).0);
        }
        let above = numerator.join("*");
        Ok(match denominator.as_slice() {
            [] => above,
            [single] => format!("{above}/{single}"),
            several => format!("{above}/({})", several.join("*")),
        })
    }

    fn atom(&mut self, atom: Expr<'_>) -> Result<String, TooLarge> {
        if let Some(known) = self.known.get(&atom.id()) {
            return Ok(known.clone());
        }
        self.operations = self.operations.saturating_add(written_operations(atom));
        if self.operations > MAX_OPERATIONS {
            return Err(TooLarge { operations: self.operations, limit: MAX_OPERATIONS });
        }
        let text = atom_text(atom)?;
        self.known.insert(atom.id(), text.clone());
        Ok(text)
    }
}

/// Appends `x^n`, split into factors whose exponents the parser accepts.
fn push_power(factors: &mut Vec<String>, name: &str, exponent: u32) {
    // An exponent beyond a few thousand is not split, because nobody could read the text; the parser refuses it.
    let full = exponent / MAX_POWER;
    if exponent <= MAX_POWER || full > 64 {
        factors.push(if exponent == 1 { name.to_owned() } else { format!("{name}^{exponent}") });
        return;
    }
    factors.extend((0..full).map(|_| format!("{name}^{MAX_POWER}")));
    if !exponent.is_multiple_of(MAX_POWER) {
        push_power(factors, name, exponent % MAX_POWER);
    }
}
