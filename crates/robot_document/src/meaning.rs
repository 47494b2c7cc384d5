//! From a formula to the expression that it stands for.

use robot_symbolic::print::latex::Trigonometry;
use robot_symbolic::{Expr, Function, Graph, Rational};

use crate::math::{Fence, Math, Script};

/// A formula that stands for no expression.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct MeaningError(&'static str);

type Meaning<'g> = Result<Expr<'g>, MeaningError>;

/// The expression of a formula, symbols by their names, sines and cosines as that style prints them.
///
/// # Errors
///
/// A formula that is no sum of products: an equation, a word, an index without a meaning.
pub fn meaning<'g>(math: &Math, graph: &'g Graph, style: Trigonometry) -> Meaning<'g> {
    Reader { graph, style }.sum(math.pieces())
}

struct Reader<'g> {
    graph: &'g Graph,
    style: Trigonometry,
}

fn fault<T>(message: &'static str) -> Result<T, MeaningError> {
    Err(MeaningError(message))
}

impl<'g> Reader<'g> {
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
            rest = tail;
            let factor = match (first, self.function(first)?) {
                (Math::Sign('·'), _) if product.is_some() && !tail.is_empty() => continue,
                (_, Some((function, exponent))) => {
                    let [argument, tail @ ..] = rest else {
                        return fault("a function without an argument");
                    };
                    rest = tail;
                    self.single(argument)?.apply(function).powi(exponent)
                }
                (piece, None) => self.single(piece)?,
            };
            product = Some(product.map_or(factor, |product| product * factor));
        }
        product.map_or_else(|| fault("a product without factors"), Ok)
    }

    /// A function that waits for its argument, with the exponent between them.
    fn function(&self, piece: &Math) -> Result<Option<(Function, i32)>, MeaningError> {
        let (base, exponent) = match piece {
            Math::Script(script) if script.lower.is_none() => (&script.base, script.upper.as_ref()),
            other => (other, None),
        };
        let function = match base {
            Math::Function("sin") => Function::Sin,
            Math::Function("cos") => Function::Cos,
            Math::Function("tanh") => Function::Tanh,
            Math::Function("sgn") => Function::Sign,
            Math::Letter('s') if self.style == Trigonometry::Paper => Function::Sin,
            Math::Letter('c') if self.style == Trigonometry::Paper => Function::Cos,
            _ => return Ok(None),
        };
        Ok(Some((function, exponent.map_or(Ok(1), integer)?)))
    }

    fn single(&self, piece: &Math) -> Meaning<'g> {
        match piece {
            Math::Number(digits) => match Rational::from_decimal(digits) {
                Some(value) => Ok(self.graph.number(value)),
                None => fault("no number"),
            },
            Math::Symbol(symbol) => Ok(self.graph.symbol(&symbol.name)),
            Math::Letter('π') => Ok(self.graph.pi()),
            Math::Row(pieces) => self.sum(pieces),
            Math::Fraction(parts) => {
                let [above, below] = parts.as_ref();
                Ok(self.sum(above.pieces())? / self.sum(below.pieces())?)
            }
            Math::Root(inside) => Ok(self.sum(inside.pieces())?.sqrt()),
            Math::Fenced(Fence::Parentheses, inside) => self.sum(inside.pieces()),
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
        let function = match (&script.base, self.style) {
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

    /// `23` for q2 + q3, `2-3` for q2 − q3, `2,10` for q2 + q10.
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
                        let joint = self.graph.symbol(&format!("q{digits}"));
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
    parsed.map_or_else(|| fault("an exponent that is no integer"), Ok)
}
