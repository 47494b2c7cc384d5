//! Arrival order: sums and products combine their operands in the order in which these become known, so that no
//! result waits longer than necessary.
//!
//! In a recursion, each link uses the sums of the link before it. If these are the last terms of a sum, each link
//! adds a single operation to the longest chain of a call, instead of one for each term.

use super::nary::Node;
use super::waiting::Waiting;
use crate::program::Program;

/// Orders the terms of each sum and the factors of each product by the time at which they become available, and
/// reassociates the operations.
#[must_use]
pub(super) fn run(program: &Program) -> Program {
    ordered(program, false).view.program()
}

/// Returns the reordered program, with the arrival time of every node; `fused` is whether products will become part of
/// multiply-adds.
pub(super) fn ordered(program: &Program, fused: bool) -> Waiting {
    let mut waiting = Waiting::new(program, fused);
    for id in waiting.ids() {
        match waiting.view.node(id).clone() {
            Node::Sum(mut terms) => {
                // Of terms known at the same time, a product is last, because it can then be fused.
                terms.sort_by_key(|term| {
                    let node = term.node;
                    (waiting.known(node), waiting.fuses(node), term.negative)
                });
                waiting.view.replace(id, Node::Sum(terms));
            }
            Node::Product(mut factors) => {
                factors.sort_by_key(|factor| waiting.known(*factor));
                waiting.view.replace(id, Node::Product(factors));
            }
            Node::Leaf(_) | Node::Quotient(..) | Node::Call(..) => {}
        }
        waiting.settle(id);
    }
    waiting
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::latency::{PRODUCT, SUM};
    use crate::passes::testing::assert_same_values;
    use crate::passes::waiting::longest_chain;
    use crate::program::{Builder, Source};

    #[test]
    fn values_stay() {
        assert_same_values("arrival order", run);
    }

    /// Ten sums, each of the sum before it, a product and three inputs. The term that is known late comes first.
    fn recursion() -> Program {
        let mut b = Builder::new();
        let mut late = b.load(Source::Input(0));
        for index in 0..10 {
            let [x, y, z] = [1, 2, 3].map(|input| b.load(Source::Input(3 * index + input)));
            let product = b.mul(x, late);
            let shared = b.add(product, x);
            let sum = b.add(shared, y);
            late = b.add(sum, z);
        }
        b.finish(vec![late])
    }

    #[test]
    fn what_is_known_late_comes_last() {
        let (program, ordered) = (recursion(), run(&recursion()));
        // As built, a product and three sums for each link. Reordered, a product and one sum, except for the first
        // link, which has no late term.
        assert_eq!(longest_chain(&program), 10 * (PRODUCT + 3 * SUM));
        assert_eq!(longest_chain(&ordered), 3 * SUM + 9 * (PRODUCT + SUM));
    }
}
