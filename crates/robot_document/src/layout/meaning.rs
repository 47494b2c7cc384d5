//! The expression that a formula stands for.

use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Function, Graph, Rational};
use rustc_hash::FxHashMap;

use super::math::{Fence, Math, Script};
use super::{SymbolTable, Trigonometry};
use crate::latex::{self, ReadError};

/// The error for a formula that does not stand for an expression.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct MeaningError(&'static str);

type Meaning<'g> = Result<Expr<'g>, MeaningError>;

/// The symbols of printed formulas by their layouts, and the notation of sines and cosines.
#[derive(Clone, Debug)]
pub struct Looks {
    names: FxHashMap<Vec<Math>, String>,
    /// The largest number of pieces of a symbol.
    longest: usize,
    style: Trigonometry,
}

impl Looks {
    /// The symbols of a table, with the layouts that are read from their LaTeX.
    ///
    /// # Errors
    ///
    /// If the LaTeX of a symbol cannot be read.
    pub fn new(table: &SymbolTable) -> Result<Looks, ReadError> {
        let mut looks =
            Looks { names: FxHashMap::default(), longest: 0, style: table.trigonometry() };
        let shapes = table.shapes().map(|(name, shape)| {
            Ok((latex::read(&latex::formula(shape))?.pieces().to_vec(), name.to_owned()))
        });
        looks.names = shapes.collect::<Result<_, ReadError>>()?;
        looks.longest = looks.names.keys().map(Vec::len).max().unwrap_or_default();
        Ok(looks)
    }

    /// The symbol at the beginning of the pieces with its exponent, and the pieces after it.
    fn symbol<'l, 'p>(&'l self, pieces: &'p [Math]) -> Option<(&'l str, i32, &'p [Math])> {
        (1..=self.longest.min(pieces.len())).rev().find_map(|count| {
            let (head, rest) = pieces.split_at(count);
            if let Some(name) = self.names.get(head) {
                return Some((name.as_str(), 1, rest));
            }
            let (Math::Script(script), before) = head.split_last()? else { return None };
            let exponent = integer(script.upper.as_ref()?).ok()?;
            let base = match &script.lower {
                Some(lower) => script.base.clone().with_lower(lower.clone()),
                None => script.base.clone(),
            };
            let bare: Vec<Math> = before.iter().cloned().chain([base]).collect();
            Some((self.names.get(&bare)?.as_str(), exponent, rest))
        })
    }
}

/// Returns the expression that a printed formula stands for.
///
/// # Errors
///
/// If the formula is not a sum of products, as for an equation, a word, or an index without a meaning.
pub fn meaning<'g>(math: &Math, graph: &'g Graph, looks: &Looks) -> Meaning<'g> {
    Reader { graph, looks }.sum(math.pieces())
}

struct Reader<'g, 'l> {
    graph: &'g Graph,
    looks: &'l Looks,
}

fn fault<T>(message: &'static str) -> Result<T, MeaningError> {
    Err(MeaningError(message))
}

impl<'g> Reader<'g, '_> {
    fn sum(&self, pieces: &[Math]) -> Meaning<'g> {
        let mut sum: Option<Expr<'g>> = None;
        for term in pieces.chunk_by(|_, next| !matches!(next, Math::Sign('+' | '-'))) {
            let (negative, factors) = match term {
                [Math::Sign('-'), factors @ ..] => (true, factors),
                [Math::Sign('+'), factors @ ..] if sum.is_some() => (false, factors),
                factors => (false, factors),
            };
            let product = self.product(factors)?;
            sum = Some(match (sum, negative) {
                (None, false) => product,
                (None, true) => -product,
                (Some(sum), false) => sum + product,
                (Some(sum), true) => sum - product,
            });
        }
        sum.map_or_else(|| fault("an empty sum"), Ok)
    }

    fn product(&self, factors: &[Math]) -> Meaning<'g> {
        let mut product: Option<Expr<'g>> = None;
        let mut rest = factors;
        while let [first, tail @ ..] = rest {
            if let Some((name, exponent, after)) = self.looks.symbol(rest) {
                let factor = self.graph.symbol(name).powi(exponent);
                product = Some(product.map_or(factor, |product| product * factor));
                rest = after;
                continue;
            }
            rest = tail;
            let factor = match (first, self.function(first)?) {
                (Math::Sign('·'), _) if product.is_some() && !tail.is_empty() => continue,
                (_, Some((function, exponent))) => {
                    let argument = match (self.looks.symbol(rest), rest) {
                        (Some((name, 1, after)), _) => {
                            rest = after;
                            self.graph.symbol(name)
                        }
                        (_, [argument, after @ ..]) => {
                            rest = after;
                            self.single(argument)?
                        }
                        _ => return fault("a function without an argument"),
                    };
                    argument.apply(function).powi(exponent)
                }
                (piece, None) => self.single(piece)?,
            };
            product = Some(product.map_or(factor, |product| product * factor));
        }
        product.map_or_else(|| fault("a product without factors"), Ok)
    }

    /// The function that a piece stands for, with its exponent, if its argument follows.
    fn function(&self, piece: &Math) -> Result<Option<(Function, i32)>, MeaningError> {
        let (base, exponent) = match piece {
            Math::Script(script) if script.lower.is_none() => (&script.base, script.upper.as_ref()),
            other => (other, None),
        };
        let function = match base {
            Math::Function(name) => name.function(),
            Math::Letter('s') if self.looks.style == Trigonometry::Paper => Function::Sin,
            Math::Letter('c') if self.looks.style == Trigonometry::Paper => Function::Cos,
            _ => return Ok(None),
        };
        Ok(Some((function, exponent.map_or(Ok(1), integer)?)))
    }

    fn single(&self, piece: &Math) -> Meaning<'g> {
        match piece {
            Math::Number(digits) => match Rational::from_decimal(digits) {
                Some(value) => Ok(self.graph.number(value)),
                None => fault("not a number"),
            },
            Math::Letter('π') => Ok(self.graph.pi()),
            Math::Row(pieces) => self.sum(pieces),
            Math::Lines(lines) => {
                let pieces = lines.iter().flat_map(|line| line.math.pieces()).cloned();
                self.sum(&pieces.collect::<Vec<_>>())
            }
            Math::Fraction(parts) => {
                let [above, below] = parts.as_ref();
                Ok(self.sum(above.pieces())? / self.sum(below.pieces())?)
            }
            Math::Root(inside) => Ok(self.sum(inside.pieces())?.sqrt()),
            Math::Fenced(Fence::Parentheses | Fence::Brackets, inside) => self.sum(inside.pieces()),
            Math::Fenced(Fence::Bars, inside) => Ok(self.sum(inside.pieces())?.abs()),
            Math::Script(script) => self.script(script),
            _ => fault("a piece without a meaning"),
        }
    }

    fn script(&self, script: &Script) -> Meaning<'g> {
        let exponent = script.upper.as_ref().map_or(Ok(1), integer)?;
        let Some(lower) = &script.lower else {
            return Ok(self.single(&script.base)?.powi(exponent));
        };
        let function = match (&script.base, self.looks.style) {
            (Math::Letter('s'), Trigonometry::Short) => Function::Sin,
            (Math::Letter('c'), Trigonometry::Short) => Function::Cos,
            _ => return fault("an index without a meaning"),
        };
        let angle = match self.joints(lower) {
            Some(angle) => angle,
            None => self.sum(lower.pieces())?,
        };
        Ok(angle.apply(function).powi(exponent))
    }

    /// The sum of angles for an index: q2 + q3 for `23`, q2 − q3 for `2-3`, q2 + q10 for `2,10`.
    fn joints(&self, index: &Math) -> Option<Expr<'g>> {
        let pieces = index.pieces();
        let apart = pieces.contains(&Math::Sign(','));
        let mut sum = self.graph.zero();
        let mut negative = false;
        for piece in pieces {
            match piece {
                Math::Sign('-') => negative = true,
                Math::Sign(',') => negative = false,
                Math::Number(digits) => {
                    let width = if apart || negative { digits.len() } else { 1 };
                    for digits in digits.as_bytes().chunks(width) {
                        let digits = std::str::from_utf8(digits).ok()?;
                        let index = digits.parse::<usize>().ok()?.checked_sub(1)?;
                        let joint = self.graph.symbol(&JointVariable::Position.symbol(index));
                        sum = if negative { sum - joint } else { sum + joint };
                    }
                }
                _ => return None,
            }
        }
        Some(sum)
    }
}

fn integer(exponent: &Math) -> Result<i32, MeaningError> {
    let parsed = match exponent.pieces() {
        [Math::Number(digits)] => digits.parse().ok(),
        [Math::Sign('-'), Math::Number(digits)] => digits.parse().ok().map(|value: i32| -value),
        _ => None,
    };
    parsed.map_or_else(|| fault("an exponent that is not an integer"), Ok)
}
