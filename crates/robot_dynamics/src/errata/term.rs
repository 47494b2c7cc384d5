//! Terms of expanded equations, and how two sets of them differ.

use std::fmt;

use robot_symbolic::{Expr, Number, Polynomial, PolynomialError, PolynomialOptions, print};

/// A term: a coefficient and powers of atoms.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Term<'g> {
    pub(super) coefficient: Number,
    /// Each atom once, in the polynomial's order.
    pub(super) factors: Vec<Power<'g>>,
}

/// A power of a symbol or function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Power<'g> {
    pub(super) atom: Expr<'g>,
    pub(super) exponent: i32,
}

/// The canonical terms of an expression.
pub(super) fn terms_of(expr: Expr<'_>) -> Result<Vec<Term<'_>>, PolynomialError> {
    let polynomial = Polynomial::of(expr, &PolynomialOptions::default())?;
    let graph = expr.graph();
    let term = |(monomial, coefficient): (&robot_symbolic::Monomial, &Number)| Term {
        coefficient: coefficient.clone(),
        factors: monomial
            .factors()
            .iter()
            .map(|factor| Power { atom: graph.expr(factor.atom()), exponent: factor.exponent() })
            .collect(),
    };
    Ok(polynomial.terms().map(term).collect())
}

/// The printed terms without counterpart, and the derived terms without.
///
/// Like terms may be printed apart: where their sum is the derived term, all of them are right.
pub(super) fn leftover<'g>(
    printed: &[Term<'g>],
    derived: &[Term<'g>],
) -> (Vec<Term<'g>>, Vec<Term<'g>>) {
    let is_right = |term: &Term<'g>| {
        let like = printed.iter().filter(|other| other.factors == term.factors);
        let sum = like.fold(Number::integer(0), |sum, other| &sum + &other.coefficient);
        let counterpart = derived.iter().find(|other| other.factors == term.factors);
        match counterpart {
            Some(other) => other.coefficient == sum,
            None => sum.is_zero(),
        }
    };
    // Of like terms that do not add up, one may still be right.
    let mut wrong: Vec<Term<'g>> = printed.iter().filter(|term| !is_right(term)).cloned().collect();
    let mut missing: Vec<Term<'g>> = derived
        .iter()
        .filter(|term| match printed.iter().find(|other| other.factors == term.factors) {
            Some(like) => !is_right(like),
            None => true,
        })
        .cloned()
        .collect();
    missing.retain(|term| match wrong.iter().position(|printed| printed == term) {
        Some(place) => {
            wrong.remove(place);
            false
        }
        None => true,
    });
    (wrong, missing)
}

type Pair<'g> = (Option<Term<'g>>, Option<Term<'g>>);

/// Pairs each wrong printed term with the missing derived term that resembles it most; what is left
/// of either stands alone.
pub(super) fn pair<'g>(wrong: &mut Vec<Term<'g>>, missing: &mut Vec<Term<'g>>) -> Vec<Pair<'g>> {
    let mut pairs: Vec<Pair<'g>> = vec![];
    while !wrong.is_empty() && !missing.is_empty() {
        let all = (0..wrong.len()).flat_map(|i| (0..missing.len()).map(move |j| (i, j)));
        let closest = all.min_by_key(|(i, j)| (wrong[*i].distance(&missing[*j]), *i, *j));
        let Some((i, j)) = closest else { break };
        pairs.push((Some(wrong.remove(i)), Some(missing.remove(j))));
    }
    pairs.extend(wrong.drain(..).map(|term| (Some(term), None)));
    pairs.extend(missing.drain(..).map(|term| (None, Some(term))));
    pairs
}

impl<'g> Term<'g> {
    fn exponent(&self, atom: Expr<'g>) -> i32 {
        let power = self.factors.iter().find(|power| power.atom == atom);
        power.map_or(0, |power| power.exponent)
    }

    /// How many factors would have to change, a different coefficient counted once.
    fn distance(&self, other: &Term<'g>) -> u32 {
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
        gone + come + u32::from(self.coefficient != other.coefficient)
    }

    /// The factor by which another term is this one, where it is a single atom or its inverse.
    pub(super) fn differs_by_factor(&self, other: &Term<'g>) -> Option<String> {
        let sign = if self.coefficient == other.coefficient {
            ""
        } else if self.coefficient == -&other.coefficient {
            "-"
        } else {
            return None;
        };
        let (long, short) =
            if self.factors.len() < other.factors.len() { (other, self) } else { (self, other) };
        let extra: Vec<&Power<'g>> = long
            .factors
            .iter()
            .filter(|power| short.exponent(power.atom) != power.exponent)
            .collect();
        match extra.as_slice() {
            [power] if power.exponent == 1 && short.factors.len() + 1 == long.factors.len() => {
                Some(format!("{sign}{}", atom_text(power.atom)))
            }
            _ => None,
        }
    }
}

fn atom_text(atom: Expr<'_>) -> String {
    print::to_text(atom).unwrap_or_else(|error| error.to_string())
}

/// `-2*cos(q2)*q3*M5*qd4*qd2`
impl fmt::Display for Term<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (magnitude, sign) = if self.coefficient.is_negative() {
            (-&self.coefficient, "-")
        } else {
            (self.coefficient.clone(), "")
        };
        formatter.write_str(sign)?;
        let mut factors: Vec<String> = vec![];
        if !magnitude.is_one() || self.factors.is_empty() {
            factors.push(match magnitude.as_rational() {
                Some(rational) => print::exact_text(rational),
                None => magnitude.to_f64().to_string(),
            });
        }
        factors.extend(self.factors.iter().map(|power| match power.exponent {
            1 => atom_text(power.atom),
            exponent => format!("{}^{exponent}", atom_text(power.atom)),
        }));
        formatter.write_str(&factors.join("*"))
    }
}
