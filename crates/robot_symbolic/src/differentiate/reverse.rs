//! The reverse mode: derivatives propagated from results to operands.

use rustc_hash::FxHashMap;

use crate::expr::{Expr, View};
use crate::graph::Id;
use crate::walk;

/// Returns the partial derivatives of `roots` with respect to `symbols`: one row per root, one column per symbol.
#[must_use]
pub fn reverse<'g>(roots: &[Expr<'g>], symbols: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
    roots.iter().map(|root| gradient(*root, symbols)).collect()
}

/// The derivatives of one root.
fn gradient<'g>(root: Expr<'g>, symbols: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let graph = root.graph();
    let nodes = walk::reachable(&[root]);
    let places: FxHashMap<Id, usize> =
        nodes.iter().enumerate().map(|(place, node)| (node.id(), place)).collect();
    let leads = leads_to(&nodes, &places, symbols);
    // The derivative of the root with respect to each node.
    let mut weights = vec![graph.zero(); nodes.len()];
    if let Some(last) = weights.last_mut() {
        *last = graph.one();
    }
    for (place, node) in nodes.iter().enumerate().rev() {
        let weight = weights[place];
        if !leads[place] || weight.is_zero() {
            continue;
        }
        let mut add = |operand: Expr<'g>, contribution: &dyn Fn() -> Expr<'g>| {
            let place = places[&operand.id()];
            if leads[place] {
                weights[place] += contribution();
            }
        };
        match node.view() {
            View::Number(_) | View::Pi | View::Symbol(_) => {}
            View::Add(a, b) => {
                add(a, &|| weight);
                add(b, &|| weight);
            }
            View::Sub(a, b) => {
                add(a, &|| weight);
                add(b, &|| -weight);
            }
            View::Mul(a, b) => {
                add(a, &|| weight * b);
                add(b, &|| weight * a);
            }
            View::Div(a, b) => {
                add(a, &|| weight / b);
                add(b, &|| -(weight * *node / b));
            }
            View::Neg(a) => add(a, &|| -weight),
            View::Call(function, a) => add(a, &|| weight * node.function_slope(function, a)),
        }
    }
    let weight = |symbol: &Expr<'g>| match places.get(&symbol.id()) {
        Some(place) => weights[*place],
        None => graph.zero(),
    };
    symbols.iter().map(weight).collect()
}

/// For each node, whether it depends on one of the symbols.
fn leads_to<'g>(
    nodes: &[Expr<'g>],
    places: &FxHashMap<Id, usize>,
    symbols: &[Expr<'g>],
) -> Vec<bool> {
    let mut leads = vec![false; nodes.len()];
    for symbol in symbols {
        if let Some(place) = places.get(&symbol.id()) {
            leads[*place] = true;
        }
    }
    for (place, node) in nodes.iter().enumerate() {
        let operands = node.operands();
        leads[place] |= operands.iter().any(|operand| leads[places[&operand.id()]]);
    }
    leads
}
