//! The forward mode: derivatives propagated from operands to results.

use rustc_hash::FxHashMap;

use crate::expr::{Expr, View};
use crate::graph::Id;
use crate::walk;

/// Returns the partial derivatives of `roots` with respect to `symbols`: one row per root, one column per symbol.
#[must_use]
pub fn forward<'g>(roots: &[Expr<'g>], symbols: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
    let nodes = walk::reachable(roots);
    let places: FxHashMap<Id, usize> =
        nodes.iter().enumerate().map(|(place, node)| (node.id(), place)).collect();
    let mut rows = vec![Vec::with_capacity(symbols.len()); roots.len()];
    for symbol in symbols {
        let slopes = slopes(&nodes, &places, *symbol);
        for (row, root) in rows.iter_mut().zip(roots) {
            row.push(slopes[places[&root.id()]].unwrap_or_else(|| symbol.graph().zero()));
        }
    }
    rows
}

/// The derivatives of nodes, sorted with operands before results, with respect to one symbol; `None` stands for 0.
fn slopes<'g>(
    nodes: &[Expr<'g>],
    places: &FxHashMap<Id, usize>,
    symbol: Expr<'g>,
) -> Vec<Option<Expr<'g>>> {
    let mut slopes: Vec<Option<Expr<'g>>> = Vec::with_capacity(nodes.len());
    for node in nodes {
        let slope = |operand: Expr<'g>| slopes[places[&operand.id()]];
        let result = match node.view() {
            View::Symbol(_) if *node == symbol => Some(symbol.graph().one()),
            View::Number(_) | View::Pi | View::Symbol(_) => None,
            View::Add(a, b) => sum(slope(a), slope(b)),
            View::Sub(a, b) => sum(slope(a), slope(b).map(|slope| -slope)),
            View::Mul(a, b) => {
                sum(slope(a).map(|slope| slope * b), slope(b).map(|slope| a * slope))
            }
            View::Div(a, b) => {
                let by_divisor = slope(b).map(|slope| -(*node * slope));
                sum(slope(a), by_divisor).map(|slope| slope / b)
            }
            View::Neg(a) => slope(a).map(|slope| -slope),
            View::Call(function, a) => {
                slope(a).map(|slope| node.function_slope(function, a) * slope)
            }
        };
        slopes.push(result.filter(|slope| !slope.is_zero()));
    }
    slopes
}

fn sum<'g>(a: Option<Expr<'g>>, b: Option<Expr<'g>>) -> Option<Expr<'g>> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a + b),
        (a, b) => a.or(b),
    }
}
