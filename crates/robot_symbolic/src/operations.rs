//! Counting what an evaluation costs.

use crate::expr::Expr;
use crate::graph::{Function, Id, Node, SymbolId};

/// Operations of a set of expressions, shared ones once. Changes of sign are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Products, squares included.
    pub multiplications: usize,
    /// Sums and differences.
    pub additions: usize,
    /// Quotients.
    pub divisions: usize,
    /// Sines and cosines.
    pub trigonometric: usize,
    /// Square roots, absolute values, signs and hyperbolic tangents.
    pub other: usize,
}

impl Operations {
    /// Multiplications and additions together.
    #[must_use]
    pub fn flops(&self) -> usize {
        self.multiplications + self.additions
    }
}

/// The operations that `roots` need each time the symbols change that are not `free`: what depends
/// on free symbols and constants alone is computed beforehand and costs nothing.
#[must_use]
pub fn operations(roots: &[Expr<'_>], free: impl Fn(SymbolId) -> bool) -> Operations {
    let mut count = Operations::default();
    let Some(graph) = roots.first().map(|root| root.graph()) else { return count };
    graph.with_nodes(|nodes| {
        let roots = || roots.iter().map(|root| root.id());
        let mut varies = vec![false; nodes.len()];
        for id in visit(nodes, roots(), |_| true) {
            varies[id.index()] = match nodes[id.index()] {
                Node::Symbol(symbol) => !free(symbol),
                node => node.operands().any(|operand| varies[operand.index()]),
            };
        }
        for id in visit(nodes, roots(), |id| varies[id.index()]) {
            match nodes[id.index()] {
                Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Neg(_) => {}
                Node::Mul(..) => count.multiplications += 1,
                Node::Add(..) | Node::Sub(..) => count.additions += 1,
                Node::Div(..) => count.divisions += 1,
                Node::Call(Function::Sin | Function::Cos, _) => count.trigonometric += 1,
                Node::Call(..) => count.other += 1,
            }
        }
    });
    count
}

/// The nodes below `roots` for which `enter` holds, operands first.
fn visit(nodes: &[Node], roots: impl Iterator<Item = Id>, enter: impl Fn(Id) -> bool) -> Vec<Id> {
    let mut seen = vec![false; nodes.len()];
    let mut found = vec![];
    let mut pending: Vec<Id> = roots.collect();
    while let Some(id) = pending.pop() {
        if enter(id) && !std::mem::replace(&mut seen[id.index()], true) {
            found.push(id);
            pending.extend(nodes[id.index()].operands());
        }
    }
    found.sort_unstable();
    found
}

#[cfg(test)]
mod tests {
    use crate::{Graph, operations};

    #[test]
    fn shared_nodes_count_once_and_free_ones_not_at_all() {
        let g = Graph::new();
        let (m, q) = (g.symbol("m"), g.symbol("q"));
        let constant = (m * 3 + 1) * m;
        let shared = constant * q.sin();
        let roots = [shared + q, -(shared * shared)];
        let count = operations(&roots, |symbol| symbol.index() == 0);
        assert_eq!((count.multiplications, count.additions, count.trigonometric), (2, 1, 1));
        assert_eq!(operations(&roots, |_| false).flops(), 6);
    }
}
