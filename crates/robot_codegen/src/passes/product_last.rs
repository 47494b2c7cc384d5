//! Product-last ordering: sums start with what is no product, so that each product that follows
//! can be a fused multiply-add.

use super::arrival;
use super::nary::{Id, Node, Term};
use super::waiting::{PRODUCT, QUOTIENT, Waiting, of_call};
use crate::program::Program;

/// Orders sums and products by [`arrival`]; then lets each sum that starts with a product of its own start
/// with the first of its terms that is none, where no result is known later for it. Reassociates.
#[must_use]
pub fn run(program: &Program) -> Program {
    let waiting = arrival::ordered(program, true);
    let mut order = Order { needed: vec![u32::MAX; waiting.ids().len()], waiting };
    order.run();
    order.waiting.view.program()
}

struct Order {
    waiting: Waiting,
    /// For each node, when it has to be known for no result to be known later than the last is; of a
    /// product that fuses, when its factors have to be.
    needed: Vec<u32>,
}

impl Order {
    fn run(&mut self) {
        let results: Vec<Id> = self.waiting.view.results.iter().map(|term| term.node).collect();
        let end = results.iter().map(|id| self.waiting.known(*id)).max().unwrap_or(0);
        results.into_iter().for_each(|id| self.need(id, end));
        for id in self.waiting.ids().rev() {
            let needed = self.needed[id as usize];
            if needed < u32::MAX && !self.waiting.view.is_early(id) {
                self.visit(id, needed);
            }
        }
    }

    fn need(&mut self, id: Id, by: u32) {
        let needed = &mut self.needed[id as usize];
        *needed = by.min(*needed);
    }

    /// Orders a node that has to be known by a cycle, and says when its operands have to be.
    fn visit(&mut self, id: Id, by: u32) {
        match self.waiting.view.node(id).clone() {
            Node::Leaf(_) => {}
            Node::Quotient(a, b) => [a, b].into_iter().for_each(|id| self.need(id, by - QUOTIENT)),
            Node::Call(function, term) => self.need(term.node, by - of_call(function)),
            Node::Product(factors) => {
                let fuses = factors.len() == 1 || self.waiting.fuses(id);
                self.visit_product(&factors, if fuses { by } else { by - PRODUCT });
            }
            Node::Sum(terms) => {
                let terms = self.product_last(terms, by);
                self.visit_sum(&terms, by);
                self.waiting.view.replace(id, Node::Sum(terms));
            }
        }
    }

    /// The last multiplication has to start by a cycle.
    fn visit_product(&mut self, factors: &[Id], mut by: u32) {
        for (place, factor) in factors.iter().enumerate().rev() {
            self.need(*factor, by);
            if place > 1 {
                by -= PRODUCT;
            }
        }
    }

    fn visit_sum(&mut self, terms: &[Term], mut by: u32) {
        for (place, term) in terms.iter().enumerate().rev() {
            if place > 0 {
                by -= self.waiting.added_by(term);
                self.need(term.node, by);
            } else {
                // Of a product that fuses, its factors: it is multiplied here.
                let product = if self.waiting.fuses(term.node) { PRODUCT } else { 0 };
                self.need(term.node, by - product);
            }
        }
    }

    /// The terms in the order that fuses one product more, where the sum is known in time.
    fn product_last(&self, terms: Vec<Term>, by: u32) -> Vec<Term> {
        let fuses = |term: &Term| self.waiting.fuses(term.node);
        let plain = terms.iter().position(|term| !fuses(term));
        let (Some(plain), true) = (plain, terms.first().is_some_and(fuses)) else { return terms };
        let mut other = terms.clone();
        other[..=plain].rotate_right(1);
        if self.waiting.sum(&other) <= by { other } else { terms }
    }
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Function;

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

    #[test]
    fn no_result_waits_for_it() {
        let mut b = Builder::new();
        let [x, y, z, w, v] = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
        let (xy, zw) = (b.mul(x, y), b.mul(z, w));
        let products = b.add(xy, zw);
        // Known late: to start with it would put both products behind it.
        let late = b.call(Function::Sqrt, v);
        let sum = b.add(products, late);
        let program = b.finish(vec![sum]);
        assert_eq!(Counts::of(&fusing::run(&run(&program))).fused, 1);
    }

    /// The same sum as a factor: the product with it has to be there before the last factor is.
    #[test]
    fn no_product_waits_for_it() {
        let mut b = Builder::new();
        let [x, y, z, w, v] = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
        let [r, s, t, u] = [5, 6, 7, 8].map(|index| b.load(Source::Input(index)));
        let (xy, zw) = (b.mul(x, y), b.mul(z, w));
        let products = b.add(xy, zw);
        let late = b.call(Function::Sqrt, v);
        let sum = b.add(products, late);
        // Known a little later than the sum.
        let quotient = b.div(r, s);
        let last = b.div(quotient, t);
        let product = b.mul(u, sum);
        let product = b.mul(product, last);
        let program = b.finish(vec![product]);
        assert_eq!(Counts::of(&fusing::run(&run(&program))).fused, 1);
    }
}
