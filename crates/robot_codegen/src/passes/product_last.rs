//! Product-last ordering: sums start with what is no product, so that each product that follows
//! can be a fused multiply-add.

use super::nary::{Nary, Node, Term};
use crate::program::Program;

/// Orders the terms of each sum: first what stands by itself, then products that the sum alone
/// uses. Among each the order stays. Reassociates.
#[must_use]
pub fn run(program: &Program) -> Program {
    let mut view = Nary::new(program);
    let uses = view.uses();
    for id in 0..uses.len() as u32 {
        if let Node::Sum(terms) = view.node(id) {
            let mut terms = terms.clone();
            let is_product = |term: &Term| {
                let own = uses[term.node as usize] == 1;
                own && matches!(view.node(term.node), Node::Product(factors) if factors.len() > 1)
            };
            // A negative start would cost a change of sign.
            terms.sort_by_key(|term| (is_product(term), !is_product(term) && term.negative));
            view.replace(id, Node::Sum(terms));
        }
    }
    view.program()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::Counts;
    use crate::passes::fusing;
    use crate::passes::testing::assert_same_values;
    use crate::program::{Builder, Source};

    #[test]
    fn values_stay() {
        assert_same_values("product-last ordering", run);
    }

    #[test]
    fn more_products_fuse() {
        let mut b = Builder::new();
        let [x, y, z, w, v] = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
        let (xy, zw) = (b.mul(x, y), b.mul(z, w));
        let products = b.add(xy, zw);
        let sum = b.add(products, v);
        let program = b.finish(vec![sum]);
        assert_eq!(Counts::of(&fusing::run(&program)).fused, 1);
        assert_eq!(Counts::of(&fusing::run(&run(&program))).fused, 2);
    }
}
