//! Long formulas on several lines.
//!
//! A line is broken before a `+` or `-` outside of fences; where a term alone does not fit, also
//! between its factors, after a `·`, and at signs within its parentheses.

use crate::error::{Centimetres, Error};
use crate::forms::Equation;
use crate::math::{Fence, Math};
use crate::width::width;

/// A piece that cannot be broken further is wider than a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooWide {
    /// What the piece needs, pt.
    pub needed: f64,
}

/// The formula on lines no wider than `first`, `rest`: widths in points of the first line and of the
/// following ones.
///
/// # Errors
///
/// A piece that does not fit.
pub fn broken(math: &Math, first: f64, rest: f64) -> Result<Vec<Math>, TooWide> {
    let mut lines = Lines { first, rest, reserve: 0.0, done: vec![], line: vec![] };
    for term in terms(math.pieces()) {
        lines.add(term, Joint::Sign)?;
    }
    lines.end();
    Ok(lines.done.into_iter().map(Math::row).collect())
}

/// An equals sign with its spaces, pt.
const EQUALS: f64 = 13.4;
/// The indent of further lines, and the spaces around the sign that they start with, pt.
const INDENT: f64 = 14.5;

/// The right side of an equation on lines beside its left side, which leaves them `available`
/// points.
///
/// # Errors
///
/// A piece that does not fit.
pub(crate) fn right_side(equation: &Equation, available: f64) -> Result<Vec<Math>, Error> {
    let rest = available - INDENT;
    broken(&equation.right, available - EQUALS, rest).map_err(|wide| Error::Narrow {
        name: equation.name.clone(),
        needed: Centimetres::from_points(wide.needed),
        available: Centimetres::from_points(rest),
    })
}

/// How a piece is joined to the one before it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Joint {
    /// By the sign that it starts with.
    Sign,
    /// As a factor.
    Factor,
}

/// More than a closing parenthesis takes, pt.
const PARENTHESIS: f64 = 6.0;

struct Lines {
    first: f64,
    rest: f64,
    /// What the closing parentheses to come will need.
    reserve: f64,
    done: Vec<Vec<Math>>,
    line: Vec<Math>,
}

impl Lines {
    fn limit(&self) -> f64 {
        (if self.done.is_empty() { self.first } else { self.rest }) - self.reserve
    }

    fn end(&mut self) {
        if !self.line.is_empty() || self.done.is_empty() {
            self.done.push(std::mem::take(&mut self.line));
        }
    }

    /// Adds pieces to the line, or to a new one, or piece by piece.
    fn add(&mut self, pieces: &[Math], joint: Joint) -> Result<(), TooWide> {
        let mut longer = self.line.clone();
        longer.extend_from_slice(pieces);
        if width(&Math::Row(longer.clone())) <= self.limit() {
            self.line = longer;
            return Ok(());
        }
        let dot = Math::Sign('·');
        let joined: Vec<Math> = match joint {
            Joint::Factor if !pieces.starts_with(&[Math::Sign('·')]) => {
                std::iter::once(dot).chain(pieces.iter().cloned()).collect()
            }
            _ => pieces.to_vec(),
        };
        let alone = width(&Math::Row(joined.clone()));
        if !self.line.is_empty() && alone <= self.rest - self.reserve {
            self.end();
            self.line = joined;
            return Ok(());
        }
        self.split(pieces, joint, alone)
    }

    /// Adds pieces that fit no line as they are.
    fn split(&mut self, pieces: &[Math], joint: Joint, needed: f64) -> Result<(), TooWide> {
        if let [signs @ .., Math::Fenced(Fence::Parentheses, inside)] = pieces
            && signs.iter().all(|piece| matches!(piece, Math::Sign(_)))
        {
            self.reserve += PARENTHESIS;
            self.add(&[signs, &[Math::Sign('(')]].concat(), joint)?;
            for term in terms(inside.pieces()) {
                self.add(term, Joint::Sign)?;
            }
            self.reserve -= PARENTHESIS;
            self.line.push(Math::Sign(')'));
            return Ok(());
        }
        let factors = factors(pieces);
        if factors.len() < 2 {
            return Err(TooWide { needed });
        }
        for (place, factor) in factors.into_iter().enumerate() {
            self.add(factor, if place == 0 { joint } else { Joint::Factor })?;
        }
        Ok(())
    }
}

/// The terms of a sum, each with its sign; a minus after an equals sign stays with that.
pub fn terms(pieces: &[Math]) -> impl Iterator<Item = &[Math]> {
    let stay = |before: &Math, next: &Math| {
        !matches!(next, Math::Sign('+' | '-' | '=')) || matches!(before, Math::Sign('='))
    };
    pieces.chunk_by(stay).filter(|term| !term.is_empty())
}

/// The factors of a term: a sign stays with the first one, a function with its argument.
fn factors(pieces: &[Math]) -> Vec<&[Math]> {
    pieces.chunk_by(|before, _| stays_with_next(before)).collect()
}

fn stays_with_next(piece: &Math) -> bool {
    match piece {
        Math::Sign(_) | Math::Function(_) | Math::Letter('s' | 'c') => true,
        Math::Script(script) => stays_with_next(&script.base) && script.lower.is_none(),
        _ => false,
    }
}
