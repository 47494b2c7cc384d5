//! Operation counts of expressions.

use crate::expr::Expr;
use crate::graph::{Function, Id, Node, SymbolId};

/// The operation count of a set of expressions. A shared operation counts once, and changes of sign do not count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Products, including squares.
    pub multiplications: usize,
    /// Sums and differences.
    pub additions: usize,
    /// Quotients and reciprocals.
    pub divisions: usize,
    /// Sines and cosines.
    pub trigonometric: usize,
    /// Square roots, absolute values, signs and hyperbolic tangents.
    pub other: usize,
    /// Sums and differences with an operand that is a product without other uses: each can be fused with that product
    /// into one multiply-add instruction.
    pub fusible: usize,
}

impl Operations {
    /// The number of multiplications and additions.
    #[must_use]
    pub fn flops(&self) -> usize {
        self.multiplications + self.additions
    }

    /// The number of multiplications and additions, with each fusible pair counted as one multiply-add.
    #[must_use]
    pub fn instructions(&self) -> usize {
        self.flops() - self.fusible
    }
}

/// Counts the operations that `roots` need whenever the symbols that are not `free` change. An expression that depends
/// only on free symbols and constants is computed beforehand and does not count.
///
/// Use a [`Counter`] to count repeatedly on one graph.
#[must_use]
pub fn operations(roots: &[Expr<'_>], free: impl Fn(SymbolId) -> bool) -> Operations {
    Counter::default().count(roots, free)
}

/// Counts like [`operations`], for repeated use on one graph. It keeps its table of nodes, so the time of a count
/// depends on the expressions below the roots, not on the size of the graph.
#[derive(Clone, Debug, Default)]
pub struct Counter {
    marks: Vec<Mark>,
    count: u64,
}

/// The state of a node during a count.
#[derive(Clone, Copy, Debug, Default)]
struct Mark {
    /// The number of the last count that reached the node; the other fields belong to that count.
    last_count: u64,
    /// Whether the node depends on symbols that are not free.
    varies: bool,
    /// Whether the node must be computed again when symbols that are not free change.
    needed: bool,
    /// The number of its uses by needed nodes and roots.
    uses: u32,
}

impl Counter {
    /// Counts the operations that `roots` need whenever the symbols that are not `free` change.
    pub fn count(&mut self, roots: &[Expr<'_>], free: impl Fn(SymbolId) -> bool) -> Operations {
        let Some(graph) = roots.first().map(|root| root.graph()) else {
            return Operations::default();
        };
        let roots: Vec<Id> = roots.iter().map(|root| root.id()).collect();
        graph.with_nodes(|nodes| {
            self.mark_varying(nodes, &roots, free);
            let needed = self.mark_needed(nodes, &roots);
            self.mark_uses(nodes, &roots, &needed);
            self.sum(nodes, &needed)
        })
    }

    /// Visits all nodes below the roots, operands first, and marks those that vary.
    fn mark_varying(&mut self, nodes: &[Node], roots: &[Id], free: impl Fn(SymbolId) -> bool) {
        self.count += 1;
        self.marks.resize(nodes.len().max(self.marks.len()), Mark::default());
        let mut found = vec![];
        let mut pending = roots.to_vec();
        while let Some(id) = pending.pop() {
            let mark = &mut self.marks[id.index()];
            if mark.last_count != self.count {
                *mark = Mark { last_count: self.count, ..Mark::default() };
                found.push(id);
                pending.extend(nodes[id.index()].operands());
            }
        }
        found.sort_unstable();
        for id in found {
            self.marks[id.index()].varies = match nodes[id.index()] {
                Node::Symbol(symbol) => !free(symbol),
                node => node.operands().any(|operand| self.marks[operand.index()].varies),
            };
        }
    }

    /// Marks the varying nodes below the roots as needed and returns them, in no particular order.
    fn mark_needed(&mut self, nodes: &[Node], roots: &[Id]) -> Vec<Id> {
        let mut needed = vec![];
        let mut pending = roots.to_vec();
        while let Some(id) = pending.pop() {
            let mark = &mut self.marks[id.index()];
            if mark.varies && !std::mem::replace(&mut mark.needed, true) {
                needed.push(id);
                pending.extend(nodes[id.index()].operands());
            }
        }
        needed
    }

    /// Counts how often each node is an operand of a `needed` node or a root. A change of sign between the two is not a
    /// use of its own.
    fn mark_uses(&mut self, nodes: &[Node], roots: &[Id], needed: &[Id]) {
        let users = needed.iter().map(|id| nodes[id.index()]);
        let users = users.filter(|node| !matches!(node, Node::Neg(_)));
        for id in users.flat_map(Node::operands).chain(roots.iter().copied()) {
            self.marks[unsigned(nodes, id).index()].uses += 1;
        }
    }

    fn sum(&self, nodes: &[Node], needed: &[Id]) -> Operations {
        let fuses = |id: Id| {
            let id = unsigned(nodes, id);
            let mark = self.marks[id.index()];
            matches!(nodes[id.index()], Node::Mul(..)) && mark.varies && mark.uses == 1
        };
        let mut sum = Operations::default();
        for id in needed {
            match nodes[id.index()] {
                Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Neg(_) => {}
                Node::Mul(..) => sum.multiplications += 1,
                Node::Add(a, b) | Node::Sub(a, b) => {
                    sum.additions += 1;
                    sum.fusible += usize::from(fuses(a) || fuses(b));
                }
                Node::Div(..) | Node::Call(Function::RecipPositive, _) => sum.divisions += 1,
                Node::Call(Function::Sin | Function::Cos, _) => sum.trigonometric += 1,
                Node::Call(..) => sum.other += 1,
            }
        }
        sum
    }
}

/// Returns the node below all changes of sign.
fn unsigned(nodes: &[Node], mut id: Id) -> Id {
    while let Node::Neg(inner) = nodes[id.index()] {
        id = inner;
    }
    id
}

#[cfg(test)]
mod tests {
    use crate::{Counter, Graph, operations};

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
    fn counts_on_a_graph_that_grows_know_nothing_of_each_other() {
        let g = Graph::new();
        let mut counter = Counter::default();
        let mut sum = g.symbol("a") * g.symbol("b");
        for name in ["c", "d", "e", "f"] {
            sum = sum * g.symbol(name) + g.symbol("a");
            for free in 0..3 {
                let is_free = |symbol: crate::SymbolId| symbol.index() < free;
                assert_eq!(counter.count(&[sum, -sum], is_free), operations(&[sum, -sum], is_free));
            }
        }
        assert_eq!(counter.count(&[], |_| false).flops(), 0);
    }

    #[test]
    fn a_product_fuses_with_the_sum_that_alone_uses_it() {
        let g = Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name));
        let count = |roots: &[crate::Expr<'_>]| operations(roots, |_| false);
        assert_eq!(count(&[a * b + c]).instructions(), 1);
        assert_eq!(count(&[c - a * b]).instructions(), 1);
        // Only one of the two products can be fused.
        assert_eq!(count(&[a * b + c * d]).instructions(), 2);
        // These products are used twice, or are results themselves.
        assert_eq!(count(&[a * b + c, a * b + d]).instructions(), 3);
        assert_eq!(count(&[a * b + c, -(a * b)]).instructions(), 2);
    }
}
