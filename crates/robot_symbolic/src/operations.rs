//! Counting what an evaluation costs.

use crate::expr::Expr;
use crate::graph::{Function, Node, SymbolId};

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
    let Some(last) = roots.iter().map(|root| root.id().index()).max() else {
        return count;
    };
    let graph = roots[0].graph();
    let nodes = graph.nodes_up_to(last);
    let mut varies = vec![false; nodes.len()];
    let mut needed = vec![false; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        varies[index] = match *node {
            Node::Number(_) | Node::Pi => false,
            Node::Symbol(symbol) => !free(symbol),
            Node::Neg(a) | Node::Call(_, a) => varies[a.index()],
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) => {
                varies[a.index()] || varies[b.index()]
            }
        };
    }
    for root in roots {
        needed[root.id().index()] = true;
    }
    for (index, node) in nodes.iter().enumerate().rev() {
        if !needed[index] || !varies[index] {
            continue;
        }
        match *node {
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Neg(_) => {}
            Node::Mul(..) => count.multiplications += 1,
            Node::Add(..) | Node::Sub(..) => count.additions += 1,
            Node::Div(..) => count.divisions += 1,
            Node::Call(Function::Sin | Function::Cos, _) => count.trigonometric += 1,
            Node::Call(..) => count.other += 1,
        }
        match *node {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Neg(a) | Node::Call(_, a) => needed[a.index()] = true,
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) => {
                (needed[a.index()], needed[b.index()]) = (true, true);
            }
        }
    }
    count
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
