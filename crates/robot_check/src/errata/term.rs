//! The terms of expanded equations, and the differences between two sets of terms.

use std::collections::{HashMap, HashSet};
use std::fmt;

use robot_symbolic::{
    Expr, Id, Monomial, Number, Polynomial, PolynomialError, PolynomialOptions, View, print, walk,
};

use super::rounding;

/// A term: a coefficient and powers of atoms.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Term<'g> {
    pub(super) coefficient: Number,
    /// The largest error of a coefficient that is printed as a decimal; `None` if it is exact.
    pub(super) rounding: Option<Number>,
    /// The factors, in the order of the polynomial; each atom occurs once.
    pub(super) factors: Vec<Power<'g>>,
}

/// A power of a symbol or function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Power<'g> {
    pub(super) atom: Expr<'g>,
    pub(super) exponent: i32,
}

/// The key of like terms: their atoms and exponents.
pub(super) type Key = Vec<(Id, i32)>;

/// The canonical terms of expressions, which are expanded together with a common limit.
pub(super) fn terms_of<'g>(
    exprs: &[Expr<'g>],
    limits: &PolynomialOptions,
) -> Result<Vec<Vec<Term<'g>>>, PolynomialError> {
    let polynomials = Polynomial::of_all(exprs, limits)?;
    let terms = polynomials.iter().map(|polynomial| {
        let graph = polynomial.graph();
        let term = |(monomial, coefficient): (&Monomial, &Number)| Term {
            coefficient: coefficient.clone(),
            rounding: None,
            factors: (monomial.factors().iter())
                .map(|factor| Power {
                    atom: graph.expr(factor.atom()),
                    exponent: factor.exponent(),
                })
                .collect(),
        };
        polynomial.terms().map(term).collect()
    });
    Ok(terms.collect())
}

/// The derived terms as they are printed: constants such as sin(0.7) that no printed term contains are multiplied into the
/// coefficients.
pub(super) fn noted_like<'g>(derived: Vec<Term<'g>>, printed: &[Term<'g>]) -> Vec<Term<'g>> {
    let factors = printed.iter().flat_map(|term| &term.factors);
    let known: HashSet<Id> = factors.map(|power| power.atom.id()).collect();
    let is_constant = |power: &Power<'g>| {
        !known.contains(&power.atom.id()) && walk::symbols(&[power.atom]).is_empty()
    };
    if !derived.iter().flat_map(|term| &term.factors).any(is_constant) {
        return derived;
    }
    let mut noted: Vec<Term<'g>> = Vec::with_capacity(derived.len());
    let mut places: HashMap<Key, usize> = HashMap::default();
    for mut term in derived {
        for constant in term.factors.iter().filter(|power| is_constant(power)) {
            let value = constant.atom.evaluate(|_| f64::NAN).powi(constant.exponent);
            term.coefficient = &term.coefficient * &Number::real(value);
        }
        term.factors.retain(|power| !is_constant(power));
        let known = places.get(&term.key()).copied().and_then(|place| noted.get_mut(place));
        if let Some(known) = known {
            known.coefficient = &known.coefficient + &term.coefficient;
        } else {
            places.insert(term.key(), noted.len());
            noted.push(term);
        }
    }
    noted.retain(|term| !term.coefficient.is_zero());
    noted
}

/// The sum of like printed terms.
#[derive(Clone, Debug)]
struct Sum {
    coefficient: Number,
    /// The largest error of the terms that are printed as decimals.
    roundings: Vec<Number>,
}

impl Sum {
    /// The largest error; `None` if the sum is exact.
    fn rounding(&self) -> Option<Number> {
        self.roundings.iter().cloned().reduce(|sum, one| &sum + &one)
    }

    fn add(&mut self, term: &Term<'_>) {
        self.coefficient = &self.coefficient + &term.coefficient;
        self.roundings.extend(term.rounding.clone());
    }

    /// Whether the sum stands for a derived coefficient. Of several short decimals, each might have a wrong digit although
    /// their sum is right to its digits, so they have to be exact. Programs print long ones.
    fn stands_for(&self, derived: &Number) -> bool {
        let error = self.rounding();
        let rounded = match &error {
            Some(error) if self.roundings.len() == 1 || rounding::is_small(error, derived) => {
                rounding::stands_for(&self.coefficient, derived, error)
            }
            _ => rounding::is_computed(&self.coefficient, derived),
        };
        rounded
            || self.coefficient == *derived
            || rounding::is_rounded_to_integer(&self.coefficient, derived)
    }
}

/// The terms of a printed and a derived equation that have no counterpart.
#[derive(Clone, Debug, Default)]
pub(super) struct Leftover<'g> {
    /// The printed terms without a counterpart.
    pub(super) wrong: Vec<Term<'g>>,
    /// The derived terms without a counterpart.
    pub(super) missing: Vec<Term<'g>>,
    /// The number of derived coefficients that agree with the printed ones only to the digits printed.
    pub(super) rounded: usize,
}

/// Removes the terms on which a printed and a derived equation agree.
///
/// Like terms may be printed separately: if their sum is the derived term, all of them are right. If neither the sum nor
/// one of them is, their sum is the wrong term if there is a derived one with the same factors; otherwise each is
/// wrong.
pub(super) fn leftover<'g>(printed: &[Term<'g>], derived: &[Term<'g>]) -> Leftover<'g> {
    let mut sums: HashMap<Key, Sum> = HashMap::default();
    for term in printed {
        let none = || Sum { coefficient: Number::integer(0), roundings: vec![] };
        sums.entry(term.key()).or_insert_with(none).add(term);
    }
    let known: HashMap<Key, &Number> =
        derived.iter().map(|term| (term.key(), &term.coefficient)).collect();
    let is_right = |key: &Key| match (sums.get(key), known.get(key)) {
        (Some(sum), Some(coefficient)) => sum.stands_for(coefficient),
        (Some(sum), None) => sum.coefficient.is_zero(),
        (None, _) => false,
    };
    let wrong = printed.iter().filter(|term| !is_right(&term.key()));
    let mut wrong: Vec<Option<Term<'g>>> = wrong.cloned().map(Some).collect();
    let mut places: HashMap<Key, Vec<usize>> = HashMap::default();
    for (place, term) in wrong.iter().enumerate() {
        places.entry(term.as_ref().map_or_else(Key::new, Term::key)).or_default().push(place);
    }
    let mut left = Leftover::default();
    for term in derived {
        let key = term.key();
        if is_right(&key) {
            let sum = sums.get(&key).map(|sum| &sum.coefficient);
            left.rounded += usize::from(sum != Some(&term.coefficient));
            continue;
        }
        // One of several like terms may still be right if they do not add up to the derived term.
        let mut like = places.get(&key).into_iter().flatten().copied();
        let stands = |place: &usize| match wrong.get(*place) {
            Some(Some(one)) => one.stands_for(&term.coefficient),
            _ => false,
        };
        match like.find(stands).and_then(|place| wrong.get_mut(place)).and_then(Option::take) {
            Some(right) => left.rounded += usize::from(right.coefficient != term.coefficient),
            None => {
                left.missing.push(term.clone());
                let like = places.get(&key).map_or(&[][..], Vec::as_slice);
                if let ([first, others @ ..], Some(sum)) = (like, sums.get(&key))
                    && !others.is_empty()
                {
                    if let Some(Some(first)) = wrong.get_mut(*first) {
                        first.coefficient = sum.coefficient.clone();
                        first.rounding = None;
                    }
                    for place in others {
                        wrong[*place] = None;
                    }
                }
            }
        }
    }
    left.wrong = wrong.into_iter().flatten().collect();
    left
}

type Pair<'g> = (Option<Term<'g>>, Option<Term<'g>>);

/// Pairs each wrong printed term with the missing derived term that it resembles most; the remaining terms have no
/// counterpart.
pub(super) fn pair<'g>(wrong: Vec<Term<'g>>, missing: Vec<Term<'g>>) -> Vec<Pair<'g>> {
    let mut near: Vec<(u32, usize, usize)> = vec![];
    for (i, printed) in wrong.iter().enumerate() {
        near.extend(missing.iter().enumerate().map(|(j, one)| (printed.distance(one), i, j)));
    }
    near.sort_unstable();
    let mut wrong: Vec<_> = wrong.into_iter().map(Some).collect();
    let mut missing: Vec<_> = missing.into_iter().map(Some).collect();
    let mut pairs: Vec<Pair<'g>> = vec![];
    for (_, i, j) in near {
        if let (Some(one), Some(other)) = (wrong.get_mut(i), missing.get_mut(j))
            && one.is_some()
            && other.is_some()
        {
            pairs.push((one.take(), other.take()));
        }
    }
    pairs.extend(wrong.into_iter().flatten().map(|term| (Some(term), None)));
    pairs.extend(missing.into_iter().flatten().map(|term| (None, Some(term))));
    pairs
}

impl<'g> Term<'g> {
    pub(super) fn exponent(&self, atom: Expr<'g>) -> i32 {
        let power = self.factors.iter().find(|power| power.atom == atom);
        power.map_or(0, |power| power.exponent)
    }

    /// The number of factors that differ, plus one if the coefficients differ.
    pub(super) fn distance(&self, other: &Term<'g>) -> u32 {
        let gone: u32 = self
            .factors
            .iter()
            .map(|power| power.exponent.abs_diff(other.exponent(power.atom)))
            .sum();
        let come: u32 = other
            .factors
            .iter()
            .filter(|power| self.exponent(power.atom) == 0)
            .map(|power| power.exponent.unsigned_abs())
            .sum();
        gone + come + u32::from(!self.stands_for(&other.coefficient))
    }

    /// Whether the term's coefficient is a given one, at least to the digits printed.
    pub(super) fn stands_for(&self, coefficient: &Number) -> bool {
        let within = |error| rounding::stands_for(&self.coefficient, coefficient, error);
        self.coefficient == *coefficient
            || self.rounding.as_ref().is_some_and(within)
            || rounding::is_rounded_to_integer(&self.coefficient, coefficient)
    }

    /// The atoms and exponents of the term.
    pub(super) fn key(&self) -> Key {
        self.factors.iter().map(|power| (power.atom.id(), power.exponent)).collect()
    }

    /// The keys of the term without one of its atoms, for each atom with the exponent 1, and the text of this atom.
    pub(super) fn without_factor(&self) -> impl Iterator<Item = (Key, String)> {
        let single = self.factors.iter().filter(|power| power.exponent == 1);
        single.map(|power| {
            let mut key = self.key();
            key.retain(|(atom, _)| *atom != power.atom.id());
            (key, atom_text(power.atom))
        })
    }

    /// The text of the coefficient, such as `2` or `-1/3`.
    pub(super) fn coefficient_text(&self) -> String {
        print::coefficient_text(&self.coefficient)
    }

    /// The term in a list that resembles this one most.
    pub(super) fn nearest<'t>(&self, terms: &'t [Term<'g>]) -> Option<&'t Term<'g>> {
        terms.iter().min_by_key(|term| self.distance(term))
    }
}

/// The text of an atom as a factor: a sum is in parentheses, such as `(m1 + m2)`.
fn atom_text(atom: Expr<'_>) -> String {
    let text = print::to_text(atom).unwrap_or_else(|error| error.to_string());
    match atom.view() {
        View::Symbol(_) | View::Call(..) | View::Pi => text,
        _ => format!("({text})"),
    }
}

/// The text of a power, such as `qd2^2`.
impl fmt::Display for Power<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = atom_text(self.atom);
        match self.exponent {
            1 => formatter.write_str(&text),
            exponent => write!(formatter, "{text}^{exponent}"),
        }
    }
}

/// The text of a term, such as `-2*cos(q2)*q3*M5*qd4*qd2`.
impl fmt::Display for Term<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut factors: Vec<String> = self.factors.iter().map(Power::to_string).collect();
        let coefficient = self.coefficient_text();
        match coefficient.as_str() {
            "1" if !factors.is_empty() => {}
            "-1" if !factors.is_empty() => formatter.write_str("-")?,
            _ => factors.insert(0, coefficient),
        }
        formatter.write_str(&factors.join("*"))
    }
}
