//! Expressions prepared for evaluation at many states.

use crate::expr::{Expr, View};
use crate::graph::{Function, SymbolId};

/// Expressions as a list of steps; the operands of a step are results of earlier steps.
#[derive(Clone, Debug)]
pub struct Evaluator {
    steps: Vec<Step>,
    /// The steps whose results are the values of the expressions.
    roots: Vec<usize>,
}

#[derive(Clone, Copy, Debug)]
enum Step {
    Constant(f64),
    Symbol(SymbolId),
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    Neg(usize),
    Call(Function, usize),
}

impl Evaluator {
    /// Prepares the steps that compute `roots`.
    #[must_use]
    pub fn new(roots: &[Expr<'_>]) -> Evaluator {
        let nodes = super::reachable(roots);
        // All operands are among the nodes, which are sorted by their ids.
        let place = |expr: Expr<'_>| {
            nodes.binary_search_by_key(&expr.id(), |node| node.id()).unwrap_or_default()
        };
        let step = |node: &Expr<'_>| match node.view() {
            View::Number(number) => Step::Constant(number.to_f64()),
            View::Pi => Step::Constant(std::f64::consts::PI),
            View::Symbol(symbol) => Step::Symbol(symbol),
            View::Add(a, b) => Step::Add(place(a), place(b)),
            View::Sub(a, b) => Step::Sub(place(a), place(b)),
            View::Mul(a, b) => Step::Mul(place(a), place(b)),
            View::Div(a, b) => Step::Div(place(a), place(b)),
            View::Neg(a) => Step::Neg(place(a)),
            View::Call(function, a) => Step::Call(function, place(a)),
        };
        Evaluator {
            steps: nodes.iter().map(step).collect(),
            roots: roots.iter().map(|root| place(*root)).collect(),
        }
    }

    /// Returns the values of the expressions; `value` gives the value of each symbol.
    #[must_use]
    pub fn values(&self, value: impl Fn(SymbolId) -> f64) -> Vec<f64> {
        self.values_by(value, Function::apply)
    }

    /// Like [`Evaluator::values`], but `apply` evaluates the functions.
    #[must_use]
    pub fn values_by(
        &self,
        value: impl Fn(SymbolId) -> f64,
        apply: impl Fn(Function, f64) -> f64,
    ) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let result = match *step {
                Step::Constant(constant) => constant,
                Step::Symbol(symbol) => value(symbol),
                Step::Add(a, b) => values[a] + values[b],
                Step::Sub(a, b) => values[a] - values[b],
                Step::Mul(a, b) => values[a] * values[b],
                Step::Div(a, b) => values[a] / values[b],
                Step::Neg(a) => -values[a],
                Step::Call(function, a) => apply(function, values[a]),
            };
            values.push(result);
        }
        self.roots.iter().map(|root| values[*root]).collect()
    }
}
