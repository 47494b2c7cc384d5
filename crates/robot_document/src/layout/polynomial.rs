//! The layout of polynomials as sums of terms.

use robot_model::signs::FunctionName;
use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Expr, Function, Id, View};
use rustc_hash::FxHashMap;

use super::Trigonometry;
use super::expression::{Expressions, magnitude_pieces, raise};
use super::math::{Fence, Math};
use super::symbols::SymbolTable;
use crate::error::Error;

/// The sum of arranged terms; 0 if there are none.
pub(super) fn sum(terms: &[ArrangedTerm<'_>], table: &SymbolTable) -> Result<Math, Error> {
    Terms { table, powers: FxHashMap::default() }.sum(terms)
}

struct Terms<'t> {
    table: &'t SymbolTable,
    powers: FxHashMap<(Id, u32), Vec<Math>>,
}

impl Terms<'_> {
    fn sum(&mut self, terms: &[ArrangedTerm<'_>]) -> Result<Math, Error> {
        let mut pieces = vec![];
        for (place, term) in terms.iter().enumerate() {
            match (place, term.negative) {
                (0, false) => {}
                (_, true) => pieces.push(Math::Sign('-')),
                (_, false) => pieces.push(Math::Sign('+')),
            }
            pieces.extend(self.term(term)?);
        }
        if terms.is_empty() {
            pieces.push(Math::integer(0));
        }
        Ok(Math::row(pieces))
    }

    /// A term such as `c x y²`, as a fraction if it has a denominator.
    fn term(&mut self, term: &ArrangedTerm<'_>) -> Result<Vec<Math>, Error> {
        let above = self.factors(term, |exponent| exponent > 0)?;
        let below = self.factors(term, |exponent| exponent < 0)?;
        let is_one = term.coefficient.is_one();
        let mut pieces = magnitude_pieces(&term.coefficient);
        if below.is_empty() {
            if is_one && !above.is_empty() {
                return Ok(above);
            }
            pieces.extend(above);
            return Ok(pieces);
        }
        // A decimal coefficient belongs in the numerator, a fraction before the fraction bar.
        let belongs_above = matches!(pieces.as_slice(), [Math::Number(_)]);
        let numerator = match (belongs_above && !is_one, above.is_empty()) {
            (false, true) => vec![Math::integer(1)],
            (false, false) => above,
            (true, _) => pieces.iter().cloned().chain(above).collect(),
        };
        if belongs_above {
            pieces.clear();
        }
        // The bar separates a sum from the denominator.
        let numerator = match Math::row(numerator) {
            Math::Fenced(Fence::Parentheses, sum) => *sum,
            other => other,
        };
        pieces.push(Math::Fraction(Box::new([numerator, Math::row(below)])));
        Ok(pieces)
    }

    /// The factors above or below the fraction bar.
    fn factors(
        &mut self,
        term: &ArrangedTerm<'_>,
        side: fn(i32) -> bool,
    ) -> Result<Vec<Math>, Error> {
        let mut pieces = vec![];
        let mut open = false;
        for (factor, exponent) in term.factors.iter().filter(|(_, exponent)| side(*exponent)) {
            // A factor after an angle without parentheses would look like a part of the angle.
            if open && !is_circular(factor) {
                pieces.push(Math::Sign('·'));
            }
            let exponent = exponent.unsigned_abs();
            pieces.extend(match factor {
                ArrangedFactor::Atom(atom) if is_alone_below(term, factor) => {
                    Expressions(self.table).pieces(*atom)?
                }
                ArrangedFactor::Atom(atom) => self.power(*atom, exponent)?,
                ArrangedFactor::Sum(terms) => {
                    power_of(vec![fenced(vec![self.sum(terms)?])], exponent)
                }
            });
            open = is_circular(factor) && self.table.trigonometry() == Trigonometry::Named;
        }
        Ok(pieces)
    }

    fn power(&mut self, atom: Expr<'_>, exponent: u32) -> Result<Vec<Math>, Error> {
        if let Some(known) = self.powers.get(&(atom.id(), exponent)) {
            return Ok(known.clone());
        }
        let setter = Expressions(self.table);
        let pieces = match atom.view() {
            View::Call(function, argument) if FunctionName::of(function).is_some() => {
                setter.named_power(function, argument, exponent)?
            }
            View::Symbol(_) | View::Pi | View::Call(..) => {
                let pieces = setter.pieces(atom)?;
                let is_fenced = pieces.iter().any(|piece| self.table.is_fenced_in_powers(piece));
                let is_fenced = exponent > 1 && is_fenced;
                power_of(if is_fenced { vec![fenced(pieces)] } else { pieces }, exponent)
            }
            _ => power_of(vec![fenced(setter.pieces(atom)?)], exponent),
        };
        self.powers.insert((atom.id(), exponent), pieces.clone());
        Ok(pieces)
    }
}

fn power_of(mut pieces: Vec<Math>, exponent: u32) -> Vec<Math> {
    if exponent > 1 {
        raise(&mut pieces, exponent);
    }
    pieces
}

fn fenced(pieces: Vec<Math>) -> Math {
    Math::Fenced(Fence::Parentheses, Box::new(Math::row(pieces)))
}

/// Whether a factor is a sum that is the whole denominator.
fn is_alone_below(term: &ArrangedTerm<'_>, factor: &ArrangedFactor<'_>) -> bool {
    let mut below = term.factors.iter().filter(|(_, exponent)| *exponent < 0);
    let is_sum = match factor {
        ArrangedFactor::Atom(atom) => matches!(atom.view(), View::Add(..) | View::Sub(..)),
        ArrangedFactor::Sum(_) => true,
    };
    is_sum
        && below.next().is_some_and(|(known, exponent)| known == factor && *exponent == -1)
        && below.next().is_none()
}

fn is_circular(factor: &ArrangedFactor<'_>) -> bool {
    let is_circular =
        |atom: Expr<'_>| matches!(atom.view(), View::Call(Function::Sin | Function::Cos, _));
    factor.as_atom().is_some_and(is_circular)
}
