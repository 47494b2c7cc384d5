//! Handles to expressions.

use std::fmt;

use crate::graph::{Function, Graph, Id, Node, SymbolId};
use crate::number::Number;

/// An expression: a copyable handle into its [`Graph`].
///
/// Two handles are equal when they name the same node, which for one graph is when the expressions
/// are the same after the local rules.
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    graph: &'g Graph,
    id: Id,
}

/// One level of an expression, for code that walks it.
#[derive(Clone, Debug, PartialEq)]
pub enum View<'g> {
    /// A constant that is not negative (signs are `Neg`).
    Number(Number),
    /// The constant π.
    Pi,
    /// A symbol.
    Symbol(SymbolId),
    /// A sum of two.
    Add(Expr<'g>, Expr<'g>),
    /// A difference.
    Sub(Expr<'g>, Expr<'g>),
    /// A product of two.
    Mul(Expr<'g>, Expr<'g>),
    /// A quotient.
    Div(Expr<'g>, Expr<'g>),
    /// A change of sign.
    Neg(Expr<'g>),
    /// A function of one argument.
    Call(Function, Expr<'g>),
}

impl<'g> Expr<'g> {
    pub(crate) fn new(graph: &'g Graph, id: Id) -> Expr<'g> {
        Expr { graph, id }
    }

    /// The graph that holds the expression.
    #[must_use]
    pub fn graph(self) -> &'g Graph {
        self.graph
    }

    /// The identity in its graph.
    #[must_use]
    pub fn id(self) -> Id {
        self.id
    }

    /// The outermost operation and its operands.
    #[must_use]
    pub fn view(self) -> View<'g> {
        let expr = |id| Expr::new(self.graph, id);
        match self.graph.node(self.id) {
            Node::Number(_) => {
                View::Number(self.graph.as_number(self.id).unwrap_or(Number::Real(f64::NAN)))
            }
            Node::Pi => View::Pi,
            Node::Symbol(symbol) => View::Symbol(symbol),
            Node::Add(a, b) => View::Add(expr(a), expr(b)),
            Node::Sub(a, b) => View::Sub(expr(a), expr(b)),
            Node::Mul(a, b) => View::Mul(expr(a), expr(b)),
            Node::Div(a, b) => View::Div(expr(a), expr(b)),
            Node::Neg(a) => View::Neg(expr(a)),
            Node::Call(function, a) => View::Call(function, expr(a)),
        }
    }

    /// The constant, if the expression is a constant (π is not a [`Number`]).
    #[must_use]
    pub fn as_number(self) -> Option<Number> {
        self.graph.as_number(self.id)
    }

    /// The symbol, if the expression is a symbol.
    #[must_use]
    pub fn as_symbol(self) -> Option<SymbolId> {
        match self.graph.node(self.id) {
            Node::Symbol(symbol) => Some(symbol),
            _ => None,
        }
    }

    /// Whether this is the constant 0.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.as_number().is_some_and(|number| number.is_zero())
    }

    /// Whether this is the constant 1.
    #[must_use]
    pub fn is_one(self) -> bool {
        self.as_number().is_some_and(|number| number.is_one())
    }

    /// Sine; exact at multiples of π/6 and π/4, with quarter turns taken out of sums.
    #[must_use]
    pub fn sin(self) -> Expr<'g> {
        self.wrap(self.graph.call(Function::Sin, self.id))
    }

    /// Cosine; exact at multiples of π/6 and π/4, with quarter turns taken out of sums.
    #[must_use]
    pub fn cos(self) -> Expr<'g> {
        self.wrap(self.graph.call(Function::Cos, self.id))
    }

    /// Square root.
    #[must_use]
    pub fn sqrt(self) -> Expr<'g> {
        self.apply(Function::Sqrt)
    }

    /// Absolute value.
    #[must_use]
    pub fn abs(self) -> Expr<'g> {
        self.apply(Function::Abs)
    }

    /// Sign, with sgn 0 = 0.
    #[must_use]
    pub fn sign(self) -> Expr<'g> {
        self.apply(Function::Sign)
    }

    /// Hyperbolic tangent.
    #[must_use]
    pub fn tanh(self) -> Expr<'g> {
        self.apply(Function::Tanh)
    }

    /// 1/x if x is above 0 and finite, otherwise NaN.
    #[must_use]
    pub fn recip_positive(self) -> Expr<'g> {
        self.apply(Function::RecipPositive)
    }

    /// A function of the expression.
    #[must_use]
    pub fn apply(self, function: Function) -> Expr<'g> {
        self.wrap(self.graph.call(function, self.id))
    }

    /// The square.
    #[must_use]
    pub fn squared(self) -> Expr<'g> {
        self * self
    }

    /// An integer power, by repeated squaring; a negative one is a reciprocal.
    #[must_use]
    pub fn powi(self, exponent: i32) -> Expr<'g> {
        let (mut result, mut square) = (self.graph.one(), self);
        let mut rest = exponent.unsigned_abs();
        while rest > 0 {
            if rest & 1 == 1 {
                result = result * square;
            }
            rest >>= 1;
            if rest > 0 {
                square = square * square;
            }
        }
        if exponent < 0 { self.graph.one() / result } else { result }
    }

    pub(crate) fn wrap(self, id: Id) -> Expr<'g> {
        Expr::new(self.graph, id)
    }
}

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.graph, other.graph) && self.id == other.id
    }
}

impl Eq for Expr<'_> {}

impl fmt::Debug for Expr<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "e{}", self.id.0)
    }
}
