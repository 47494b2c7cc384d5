//! Polynomials as sums of terms, each its own piece of LaTeX, so that lines can be broken.

use rustc_hash::FxHashMap;

use super::expression::{circular_power, magnitude, to_latex};
use super::{LatexStyle, Trigonometry, raised};
use crate::expr::{Expr, View};
use crate::graph::{Function, Id};
use crate::polynomial::Polynomial;
use crate::print::{ArrangedTerm, TooLarge};

/// A term of a printed sum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LatexTerm {
    /// Whether the term is subtracted.
    pub negative: bool,
    /// The term without its sign.
    pub text: String,
}

/// The terms of a polynomial, arranged by ranks of its atoms (see [`Polynomial::arranged`]); one
/// term `0` for the polynomial 0.
///
/// # Errors
///
/// Where an argument of a function is too long to be written out.
pub fn polynomial_terms<'g, K: Ord>(
    polynomial: &Polynomial<'g>,
    style: &LatexStyle<'_>,
    rank: impl Fn(Expr<'g>) -> K,
) -> Result<Vec<LatexTerm>, TooLarge> {
    let mut printer = Printer { style, powers: FxHashMap::default() };
    let terms = polynomial.arranged(rank);
    if terms.is_empty() {
        return Ok(vec![LatexTerm { negative: false, text: "0".to_owned() }]);
    }
    terms
        .iter()
        .map(|term| Ok(LatexTerm { negative: term.negative, text: printer.term(term)? }))
        .collect()
}

/// The polynomial as one line, arranged by ranks of its atoms.
///
/// # Errors
///
/// Where an argument of a function is too long to be written out.
pub fn polynomial_to_latex<'g, K: Ord>(
    polynomial: &Polynomial<'g>,
    style: &LatexStyle<'_>,
    rank: impl Fn(Expr<'g>) -> K,
) -> Result<String, TooLarge> {
    let mut latex = String::new();
    for (place, term) in polynomial_terms(polynomial, style, rank)?.iter().enumerate() {
        latex.push_str(match (place, term.negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        latex.push_str(&term.text);
    }
    Ok(latex)
}

struct Printer<'a> {
    style: &'a LatexStyle<'a>,
    powers: FxHashMap<(Id, u32), String>,
}

/// A sum alone under its fraction bar.
fn alone(term: &ArrangedTerm<'_>, atom: Expr<'_>) -> bool {
    let below = term.factors.iter().filter(|(_, exponent)| *exponent < 0);
    below.clone().count() == 1
        && below.clone().all(|(other, exponent)| *other == atom && *exponent == -1)
        && matches!(atom.view(), View::Add(..) | View::Sub(..))
}

impl Printer<'_> {
    /// `c x y^{2}`, over its denominator where it has one.
    fn term(&mut self, term: &ArrangedTerm<'_>) -> Result<String, TooLarge> {
        let (mut above, mut below) = (String::new(), String::new());
        let mut open = [false; 2];
        for (atom, exponent) in &term.factors {
            let side = usize::from(*exponent < 0);
            let line = if side == 0 { &mut above } else { &mut below };
            if !line.is_empty() {
                line.push_str(if open[side] && !is_circular(*atom) { r" \cdot " } else { " " });
            }
            line.push_str(&if alone(term, *atom) {
                to_latex(*atom, self.style)?
            } else {
                self.power(*atom, exponent.unsigned_abs())?
            });
            open[side] = is_circular(*atom) && self.style.trigonometry == Trigonometry::Named;
        }
        let coefficient = magnitude(&term.coefficient);
        if below.is_empty() {
            return Ok(match (term.coefficient.is_one(), above.is_empty()) {
                (_, true) => coefficient,
                (true, false) => above,
                (false, false) => format!("{coefficient} {above}"),
            });
        }
        // An integer belongs above the bar, a fraction before it.
        let integer = !coefficient.contains('\\');
        let above = match (integer && !term.coefficient.is_one(), above.is_empty()) {
            (false, true) => "1".to_owned(),
            (false, false) => above,
            (true, true) => coefficient.clone(),
            (true, false) => format!("{coefficient} {above}"),
        };
        let fraction = format!(r"\frac{{{above}}}{{{below}}}");
        Ok(if integer { fraction } else { format!("{coefficient} {fraction}") })
    }

    fn power(&mut self, atom: Expr<'_>, exponent: u32) -> Result<String, TooLarge> {
        if let Some(known) = self.powers.get(&(atom.id(), exponent)) {
            return Ok(known.clone());
        }
        let latex = match atom.view() {
            View::Call(Function::Sin | Function::Cos, _) if exponent > 1 => {
                circular_power(atom, exponent, self.style)?
            }
            View::Symbol(_) | View::Pi | View::Call(..) => {
                raised(&to_latex(atom, self.style)?, exponent)
            }
            _ => raised(&format!(r"\left({}\right)", to_latex(atom, self.style)?), exponent),
        };
        self.powers.insert((atom.id(), exponent), latex.clone());
        Ok(latex)
    }
}

fn is_circular(atom: Expr<'_>) -> bool {
    matches!(atom.view(), View::Call(Function::Sin | Function::Cos, _))
}
