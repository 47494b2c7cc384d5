//! Handles to expressions.

use std::fmt;

use crate::graph::{Function, Graph, Id, Node, SymbolId};
use crate::number::Number;

/// An expression: a handle into its [`Graph`] that can be copied.
///
/// Two handles are equal if they refer to the same node. Within one graph, these are the expressions that the local
/// rules make identical.
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    graph: &'g Graph,
    id: Id,
}

/// The outermost operation of an expression with its operands, for code that traverses expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum View<'g> {
    /// A constant, never negative: a minus sign is a `Neg`.
    Number(Number),
    /// The constant π.
    Pi,
    /// A symbol.
    Symbol(SymbolId),
    /// A sum of two expressions.
    Add(Expr<'g>, Expr<'g>),
    /// A difference.
    Sub(Expr<'g>, Expr<'g>),
    /// A product of two expressions.
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

    /// The expression's identity in its graph.
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
                View::Number(self.graph.as_number(self.id).unwrap_or(Number::real(f64::NAN)))
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

    /// Returns the value if the expression is a constant other than π, which is not a [`Number`].
    #[must_use]
    pub fn as_number(self) -> Option<Number> {
        self.graph.as_number(self.id)
    }

    /// Returns the symbol if the expression is one.
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

    /// The sine; exact at multiples of π/6 and π/4, and without quarter turns in its argument.
    #[must_use]
    pub fn sin(self) -> Expr<'g> {
        self.wrap(self.graph.call(Function::Sin, self.id))
    }

    /// The cosine; exact at multiples of π/6 and π/4, and without quarter turns in its argument.
    #[must_use]
    pub fn cos(self) -> Expr<'g> {
        self.wrap(self.graph.call(Function::Cos, self.id))
    }

    /// The square root.
    #[must_use]
    pub fn sqrt(self) -> Expr<'g> {
        self.apply(Function::Sqrt)
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(self) -> Expr<'g> {
        self.apply(Function::Abs)
    }

    /// The sign, with sgn 0 = 0.
    #[must_use]
    pub fn sign(self) -> Expr<'g> {
        self.apply(Function::Sign)
    }

    /// The hyperbolic tangent.
    #[must_use]
    pub fn tanh(self) -> Expr<'g> {
        self.apply(Function::Tanh)
    }

    /// 1/x if x is positive and finite, otherwise NaN.
    #[must_use]
    pub fn recip_positive(self) -> Expr<'g> {
        self.apply(Function::RecipPositive)
    }

    /// Applies a function to the expression.
    #[must_use]
    pub fn apply(self, function: Function) -> Expr<'g> {
        self.wrap(self.graph.call(function, self.id))
    }

    /// The square.
    #[must_use]
    pub fn squared(self) -> Expr<'g> {
        self * self
    }

    /// An integer power, computed by repeated squaring; a negative exponent gives the reciprocal of the positive power.
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
