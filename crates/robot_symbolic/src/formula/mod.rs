//! Formulas: texts of expressions that belong to no graph, as in robot files.

mod error;
mod fold;
mod lexer;
mod parser;

use std::ops::Range;

use crate::expr::Expr;
use crate::graph::{Function, Graph};
use crate::number::Number;
use crate::print;
use crate::rational::Rational;

pub use error::ParseError;
pub use fold::Step;

/// The largest absolute value of an exponent; a larger one is an error.
pub const MAX_EXPONENT: i64 = 64;
/// The deepest nesting of parentheses, signs and powers; deeper nesting is an error.
pub const MAX_DEPTH: usize = 256;
/// The largest number of tokens (numbers, names, operators and parentheses) in a formula; more are an error.
pub const MAX_TOKENS: usize = 100_000;

/// One step of a formula in postfix order.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Op {
    Number(Rational),
    Pi,
    /// A name, given by its bytes in the text.
    Symbol(Range<usize>),
    Add,
    Sub,
    Mul,
    Div,
    Neg,
    Power(i32),
    Call(Function),
    Tan,
}

/// The checked text of an expression: numbers, names, `pi`, the operators `+ - * / ^`, parentheses, and the functions
/// `sin cos tan sqrt abs sign tanh`.
///
/// A formula belongs to no [`Graph`], so it can be kept, copied and sent; [`Formula::lower`] makes an expression from
/// it. Exponents are integers of magnitude at most [`MAX_EXPONENT`]; `-x^2` is `-(x^2)`, and `x^2^3` is `x^(2^3)`.
/// Numbers are exact decimals.
///
/// ```
/// use robot_symbolic::{Formula, Graph};
/// let formula = Formula::parse("l1 + 2*l2*sin(q2)^2")?;
/// let names: Vec<_> = formula.symbols().map(|(name, _)| name).collect();
/// assert_eq!(names, ["l1", "l2", "q2"]);
/// let graph = Graph::new();
/// let expr = formula.lower(&graph, &mut |name| graph.symbol(name));
/// let sine = graph.symbol("q2").sin();
/// assert_eq!(expr, graph.symbol("l1") + graph.symbol("l2") * 2 * sine.powi(2));
/// # Ok::<(), robot_symbolic::ParseError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Formula {
    text: String,
    ops: Vec<Op>,
}

impl Formula {
    /// Reads a formula in which names have the form `[A-Za-z_][A-Za-z0-9_]*`.
    ///
    /// # Errors
    ///
    /// The first error, with its place and a remedy.
    pub fn parse(text: &str) -> Result<Formula, ParseError> {
        parser::parse(text, lexer::Names::Plain)
    }

    /// Reads a formula in which names can have parts joined by dots, as in printed equations: `F_l5.y`.
    ///
    /// # Errors
    ///
    /// The first error, with its place and a remedy.
    pub fn parse_with_dots(text: &str) -> Result<Formula, ParseError> {
        parser::parse(text, lexer::Names::Dotted)
    }

    /// Creates a formula that consists of one number.
    #[must_use]
    pub fn number(value: &Rational) -> Formula {
        let mut ops = vec![Op::Number(value.abs())];
        if value.is_negative() {
            ops.push(Op::Neg);
        }
        Formula { text: print::exact_text(value), ops }
    }

    /// Creates a formula that consists of one name, which is not checked.
    #[must_use]
    pub fn symbol(name: &str) -> Formula {
        Formula { text: name.to_owned(), ops: vec![Op::Symbol(0..name.len())] }
    }

    /// The source text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Every use of a name (not of a function or `pi`) with its bytes in [`Formula::text`], from left to right.
    pub fn symbols(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        self.ops.iter().filter_map(|op| match op {
            Op::Symbol(span) => Some((self.name(span), span.clone())),
            _ => None,
        })
    }

    /// Whether the formula has no names.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.symbols().next().is_none()
    }

    /// Returns the value of a formula without names if it is a [`Number`]: `sin(pi/2)` and `sqrt(4)` are numbers,
    /// `pi/2` is not.
    ///
    /// A division by zero gives a NaN, which the caller should refuse.
    #[must_use]
    pub fn as_number(&self) -> Option<Number> {
        if let [Op::Number(value)] = self.ops.as_slice() {
            return Some(Number::Rational(value.clone()));
        }
        if !self.is_constant() {
            return None;
        }
        let graph = Graph::new();
        self.lower(&graph, &mut |_| graph.zero()).as_number()
    }

    /// Makes the expression of the formula in a graph; `resolve` gives the expression that each name stands for.
    pub fn lower<'g>(
        &self,
        graph: &'g Graph,
        resolve: &mut dyn FnMut(&str) -> Expr<'g>,
    ) -> Expr<'g> {
        let mut stack = Stack::new(graph.zero());
        for op in &self.ops {
            let result = match op {
                Op::Number(value) => graph.number(value.clone()),
                Op::Pi => graph.pi(),
                Op::Symbol(span) => resolve(self.name(span)),
                Op::Add => stack.binary(|a, b| a + b),
                Op::Sub => stack.binary(|a, b| a - b),
                Op::Mul => stack.binary(|a, b| a * b),
                Op::Div => stack.binary(|a, b| a / b),
                Op::Neg => -stack.pop(),
                Op::Power(exponent) => stack.pop().powi(*exponent),
                Op::Call(function) => stack.pop().apply(*function),
                Op::Tan => {
                    let angle = stack.pop();
                    angle.sin() / angle.cos()
                }
            };
            stack.values.push(result);
        }
        stack.pop()
    }

    /// Evaluates the formula in floating point; `value` gives the value of each name.
    #[must_use]
    pub fn evaluate(&self, mut value: impl FnMut(&str) -> f64) -> f64 {
        let mut stack = Stack::new(f64::NAN);
        for op in &self.ops {
            let result = match op {
                Op::Number(value) => value.to_f64(),
                Op::Pi => std::f64::consts::PI,
                Op::Symbol(span) => value(self.name(span)),
                Op::Add => stack.binary(|a, b| a + b),
                Op::Sub => stack.binary(|a, b| a - b),
                Op::Mul => stack.binary(|a, b| a * b),
                Op::Div => stack.binary(|a, b| a / b),
                Op::Neg => -stack.pop(),
                Op::Power(exponent) => stack.pop().powi(*exponent),
                Op::Call(function) => function.apply(stack.pop()),
                Op::Tan => stack.pop().tan(),
            };
            stack.values.push(result);
        }
        stack.pop()
    }

    fn name(&self, span: &Range<usize>) -> &str {
        self.text.get(span.clone()).unwrap_or_default()
    }
}

/// Writes the source text.
impl std::fmt::Display for Formula {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.text)
    }
}

impl Graph {
    /// Makes an expression from a text, in which each name is a symbol of the graph (see [`Formula`]).
    ///
    /// # Errors
    ///
    /// The first error, with its place and a remedy.
    pub fn parse(&self, text: &str) -> Result<Expr<'_>, ParseError> {
        Ok(Formula::parse(text)?.lower(self, &mut |name| self.symbol(name)))
    }
}

/// Whether `name` is `pi` or a function in formulas, and so cannot be a symbol.
#[must_use]
pub fn is_reserved(name: &str) -> bool {
    name == "pi" || name == "tan" || Function::ALL.iter().any(|f| f.name() == name)
}

/// Whether `name` can be a symbol: it has the form `[A-Za-z_][A-Za-z0-9_]*` and is not reserved.
#[must_use]
pub fn is_symbol_name(name: &str) -> bool {
    let mut bytes = name.bytes();
    bytes.next().is_some_and(lexer::starts_name)
        && bytes.all(lexer::continues_name)
        && !is_reserved(name)
}

/// The operands during the evaluation of postfix steps. The parser only makes well-formed formulas, so the stack is
/// never empty when an operand is taken, and `fallback` is never used.
struct Stack<T> {
    values: Vec<T>,
    fallback: T,
}

impl<T: Copy> Stack<T> {
    fn new(fallback: T) -> Stack<T> {
        Stack { values: vec![], fallback }
    }

    fn pop(&mut self) -> T {
        self.values.pop().unwrap_or(self.fallback)
    }

    fn binary(&mut self, operation: impl Fn(T, T) -> T) -> T {
        let b = self.pop();
        let a = self.pop();
        operation(a, b)
    }
}

#[cfg(test)]
mod tests;
