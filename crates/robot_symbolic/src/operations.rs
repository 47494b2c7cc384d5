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
    /// Sums and differences with a product that nothing else uses: each can be one instruction with
    /// it, a multiply-add.
    pub fusible: usize,
}

impl Operations {
    /// Multiplications and additions together.
    #[must_use]
    pub fn flops(&self) -> usize {
        self.multiplications + self.additions
    }

    /// Multiplications and additions where each fusible pair is one multiply-add.
    #[must_use]
    pub fn instructions(&self) -> usize {
        self.flops() - self.fusible
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
        let needed = visit(nodes, roots(), |id| varies[id.index()]);
        let uses = uses(nodes, roots(), &needed);
        let fuses = |id: Id| {
            let id = unsigned(nodes, id);
            let is_product = matches!(nodes[id.index()], Node::Mul(..));
            is_product && varies[id.index()] && uses[id.index()] == 1
        };
        for id in needed {
            if let Node::Add(a, b) | Node::Sub(a, b) = nodes[id.index()] {
                count.fusible += usize::from(fuses(a) || fuses(b));
            }
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

/// How often each node is an operand of `needed` nodes or a root; a change of sign is part of its use.
fn uses(nodes: &[Node], roots: impl Iterator<Item = Id>, needed: &[Id]) -> Vec<u32> {
    let mut uses = vec![0; nodes.len()];
    let users = needed.iter().map(|id| nodes[id.index()]);
    let users = users.filter(|node| !matches!(node, Node::Neg(_)));
    for id in users.flat_map(Node::operands).chain(roots) {
        uses[unsigned(nodes, id).index()] += 1;
    }
    uses
}

/// The node without its changes of sign.
fn unsigned(nodes: &[Node], mut id: Id) -> Id {
    while let Node::Neg(inner) = nodes[id.index()] {
        id = inner;
    }
    id
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

    #[test]
    fn a_product_fuses_with_the_sum_that_alone_uses_it() {
        let g = Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name));
        let count = |roots: &[crate::Expr<'_>]| operations(roots, |_| false);
        assert_eq!(count(&[a * b + c]).instructions(), 1);
        assert_eq!(count(&[c - a * b]).instructions(), 1);
        // Of two products one.
        assert_eq!(count(&[a * b + c * d]).instructions(), 2);
        // Used twice, or a result itself.
        assert_eq!(count(&[a * b + c, a * b + d]).instructions(), 3);
        assert_eq!(count(&[a * b + c, -(a * b)]).instructions(), 2);
    }
}
