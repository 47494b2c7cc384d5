//! Passes over expressions: evaluation, substitution, import into another graph, derivatives.
//!
//! The ids of operands are smaller than those of results, so each pass runs over a table in the order of ids. No pass
//! is recursive, so expressions can be arbitrarily deep.

mod evaluator;

use rustc_hash::FxHashMap;

use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, SymbolId};

pub use evaluator::Evaluator;

/// Returns all expressions that `roots` consist of, operands before results, each once.
#[must_use]
pub fn reachable<'g>(roots: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let mut seen = rustc_hash::FxHashSet::default();
    let mut found = vec![];
    let mut pending: Vec<Expr<'g>> = roots.to_vec();
    while let Some(expr) = pending.pop() {
        if seen.insert(expr.id()) {
            found.push(expr);
            pending.extend(expr.operands());
        }
    }
    found.sort_unstable_by_key(|expr| expr.id());
    found
}

/// Whether `root` consists of more than `limit` expressions, including itself; a shared one counts once. The traversal
/// stops at the limit.
#[must_use]
pub fn is_longer_than(root: Expr<'_>, limit: usize) -> bool {
    let mut seen = rustc_hash::FxHashSet::default();
    let mut pending = vec![root];
    while let Some(expr) = pending.pop() {
        if seen.insert(expr.id()) {
            if seen.len() > limit {
                return true;
            }
            pending.extend(expr.operands());
        }
    }
    false
}

/// Returns the symbols that `roots` depend on, in the order of their first use in the graph.
#[must_use]
pub fn symbols(roots: &[Expr<'_>]) -> Vec<SymbolId> {
    let mut symbols: Vec<_> = reachable(roots).iter().filter_map(|expr| expr.as_symbol()).collect();
    symbols.sort_unstable();
    symbols
}

/// Returns the values of `roots`; `value` gives the value of each symbol.
#[must_use]
pub fn evaluate(roots: &[Expr<'_>], value: impl Fn(SymbolId) -> f64) -> Vec<f64> {
    Evaluator::new(roots).values(value)
}

/// Rebuilds `roots` in `graph`, with each symbol replaced by the result of `replace` for its name. The local rules
/// apply again.
#[must_use]
pub fn rebuild<'h>(
    roots: &[Expr<'_>],
    graph: &'h Graph,
    replace: impl Fn(&str) -> Expr<'h>,
) -> Vec<Expr<'h>> {
    rebuild_above(roots, graph, |expr| {
        let symbol = expr.as_symbol()?;
        Some(replace(&expr.graph().symbol_name(symbol)))
    })
}

/// Rebuilds `roots` in `graph` and substitutes what `replace` returns for an expression. The operands of a replaced
/// expression are not visited. The local rules apply again.
///
/// ```
/// use robot_symbolic::{Graph, print, walk};
/// let graph = Graph::new();
/// let sum = graph.parse("l1*cos(q1) + l2*cos(q1)^2").unwrap();
/// let cosine = graph.symbol("q1").cos();
/// let named = walk::rebuild_above(&[sum], &graph, |expr| {
///     (expr == cosine).then(|| graph.symbol("x"))
/// });
/// assert_eq!(print::to_text(named[0]).unwrap(), "l1*x + l2*x^2");
/// ```
#[must_use]
pub fn rebuild_above<'g, 'h>(
    roots: &[Expr<'g>],
    graph: &'h Graph,
    replace: impl Fn(Expr<'g>) -> Option<Expr<'h>>,
) -> Vec<Expr<'h>> {
    let mut built: FxHashMap<_, Expr<'h>> = FxHashMap::default();
    let mut kept = vec![];
    let mut pending: Vec<Expr<'g>> = roots.to_vec();
    let mut seen = rustc_hash::FxHashSet::default();
    while let Some(expr) = pending.pop() {
        if !seen.insert(expr.id()) {
            continue;
        }
        match replace(expr) {
            Some(other) => {
                built.insert(expr.id(), other);
            }
            None => {
                kept.push(expr);
                pending.extend(expr.operands());
            }
        }
    }
    kept.sort_unstable_by_key(|expr| expr.id());
    for expr in kept {
        let result = with_operands(expr, graph, |operand| built[&operand.id()]);
        built.insert(expr.id(), result);
    }
    roots.iter().map(|root| built[&root.id()]).collect()
}

/// Rebuilds `roots` in `graph`, operands before results; each rebuilt expression is replaced by what `change` returns
/// for it. The local rules apply again.
///
/// ```
/// use robot_symbolic::{Graph, print, walk};
/// let graph = Graph::new();
/// let value = graph.parse("(x + y)*z").unwrap();
/// let (sum, name) = (graph.parse("x + y").unwrap(), graph.symbol("s"));
/// let renamed = walk::rebuild_upward(&[value], &graph, |part| if part == sum { name } else { part });
/// assert_eq!(print::to_text(renamed[0]).unwrap(), "z*s");
/// ```
#[must_use]
pub fn rebuild_upward<'h>(
    roots: &[Expr<'_>],
    graph: &'h Graph,
    change: impl Fn(Expr<'h>) -> Expr<'h>,
) -> Vec<Expr<'h>> {
    let mut built: FxHashMap<_, Expr<'h>> = FxHashMap::default();
    for expr in reachable(roots) {
        let result = change(with_operands(expr, graph, |operand| built[&operand.id()]));
        built.insert(expr.id(), result);
    }
    roots.iter().map(|root| built[&root.id()]).collect()
}

/// The expression in `graph`, with the operands that `at` returns.
fn with_operands<'g, 'h>(
    expr: Expr<'g>,
    graph: &'h Graph,
    at: impl Fn(Expr<'g>) -> Expr<'h>,
) -> Expr<'h> {
    match expr.view() {
        View::Number(number) => graph.number(number),
        View::Pi => graph.pi(),
        View::Symbol(symbol) => graph.symbol(&expr.graph().symbol_name(symbol)),
        View::Add(a, b) => at(a) + at(b),
        View::Sub(a, b) => at(a) - at(b),
        View::Mul(a, b) => at(a) * at(b),
        View::Div(a, b) => at(a) / at(b),
        View::Neg(a) => -at(a),
        View::Call(function, a) => at(a).apply(function),
    }
}

/// Returns the partial derivatives of `roots` with respect to one symbol.
///
/// |x| has the derivative sgn x, and sgn x the derivative 0, everywhere.
#[must_use]
pub fn derivatives<'g>(roots: &[Expr<'g>], symbol: Expr<'g>) -> Vec<Expr<'g>> {
    let graph = symbol.graph();
    let mut slopes: FxHashMap<_, Expr<'g>> = FxHashMap::default();
    for expr in reachable(roots) {
        let slope = |operand: Expr<'g>| slopes[&operand.id()];
        let result = match expr.view() {
            View::Symbol(_) if expr == symbol => graph.one(),
            View::Number(_) | View::Pi | View::Symbol(_) => graph.zero(),
            View::Add(a, b) => slope(a) + slope(b),
            View::Sub(a, b) => slope(a) - slope(b),
            View::Mul(a, b) => slope(a) * b + a * slope(b),
            View::Div(a, b) => (slope(a) - expr * slope(b)) / b,
            View::Neg(a) => -slope(a),
            View::Call(function, a) => expr.function_slope(function, a) * slope(a),
        };
        slopes.insert(expr.id(), result);
    }
    roots.iter().map(|root| slopes[&root.id()]).collect()
}

impl<'g> Expr<'g> {
    /// The direct operands.
    #[must_use]
    pub fn operands(self) -> Vec<Expr<'g>> {
        match self.view() {
            View::Number(_) | View::Pi | View::Symbol(_) => vec![],
            View::Neg(a) | View::Call(_, a) => vec![a],
            View::Add(a, b) | View::Sub(a, b) | View::Mul(a, b) | View::Div(a, b) => vec![a, b],
        }
    }

    /// The partial derivative with respect to a symbol.
    #[must_use]
    pub fn derivative(self, symbol: Expr<'g>) -> Expr<'g> {
        derivatives(&[self], symbol)[0]
    }

    /// Returns the value of the expression; `value` gives the value of each symbol.
    #[must_use]
    pub fn evaluate(self, value: impl Fn(SymbolId) -> f64) -> f64 {
        evaluate(&[self], value)[0]
    }

    /// Returns the expression with symbols replaced; a symbol for which `replace` returns `None` stays.
    #[must_use]
    pub fn substitute(self, replace: impl Fn(&str) -> Option<Expr<'g>>) -> Expr<'g> {
        let graph = self.graph();
        rebuild(&[self], graph, |name| replace(name).unwrap_or_else(|| graph.symbol(name)))[0]
    }

    /// The derivative of `self = function(argument)` with respect to its argument.
    pub(crate) fn function_slope(self, function: Function, argument: Expr<'g>) -> Expr<'g> {
        let graph = self.graph();
        match function {
            Function::Sin => argument.cos(),
            Function::Cos => -argument.sin(),
            Function::Sqrt => graph.one() / (self * 2),
            Function::Abs => argument.sign(),
            Function::Sign => graph.zero(),
            Function::Tanh => graph.one() - self * self,
            Function::RecipPositive => -(self * self),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_count_shared_expressions_once() {
        let g = Graph::new();
        let x = g.symbol("x");
        let doubled = (0..40).fold(x + 1, |sum, _| sum * sum);
        assert!(is_longer_than(doubled, 42) && !is_longer_than(doubled, 43));
        assert!(!is_longer_than(x, 1) && is_longer_than(x, 0));
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        let f = (x * y).sin() * x / (y + x.cos()) + (x * x + y * y).sqrt() - (x - y).tanh();
        let at = |x: f64, y: f64| f.evaluate(|s| if s.index() == 0 { x } else { y });
        let slope = f.derivative(x).evaluate(|s| if s.index() == 0 { 0.7 } else { 1.9 });
        let h = 1e-6;
        let difference = (at(0.7 + h, 1.9) - at(0.7 - h, 1.9)) / (2.0 * h);
        assert!((slope - difference).abs() < 1e-9, "{slope} {difference}");
    }

    #[test]
    fn substitution_applies_the_rules_anew() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        let f = (x + y).sin() * x;
        assert_eq!(f.substitute(|name| (name == "x").then(|| -y)), g.zero());
        let other = Graph::new();
        let copy = rebuild(&[f], &other, |name| other.symbol(name))[0];
        assert_eq!(copy, (other.symbol("x") + other.symbol("y")).sin() * other.symbol("x"));
    }

    #[test]
    fn a_deep_expression_causes_no_deep_recursion() {
        let g = Graph::new();
        let x = g.symbol("x");
        let deep = (0..200_000).fold(x, |sum, _| (sum * x) + x);
        assert_eq!(deep.evaluate(|_| 1.0), 200_001.0);
        assert_eq!(symbols(&[deep]).len(), 1);
    }
}
