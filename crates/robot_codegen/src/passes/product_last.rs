//! Product-last ordering: sums start with a term that is not a product, so that each product that follows
//! can be a fused multiply-add.

use super::arrival;
use super::latency::{PRODUCT, QUOTIENT, of_call};
use super::nary::{Id, Node, Term};
use super::waiting::Waiting;
use crate::program::Program;

/// Orders sums and products by [`arrival`]. Then a sum that starts with a product that only it uses starts with the
/// first other kind of term instead, if that does not delay any result. This pass reassociates.
#[must_use]
pub(crate) fn run(program: &Program) -> Program {
    let waiting = arrival::ordered(program, true);
    let mut order = Order { needed: vec![u32::MAX; waiting.ids().len()], waiting };
    order.run();
    order.waiting.view.program()
}

struct Order {
    waiting: Waiting,
    /// For each node, the latest cycle at which it may be known without delaying the last result; for a
    /// product that fuses, the latest cycle for its factors.
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

    /// Orders the operands of a node that has to be known by a cycle, and records when its operands have to be known.
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

    /// Records when the factors of a product have to be known whose last multiplication has to start by a cycle.
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
                // A product that would fuse is multiplied separately as the first term, so its factors are needed
                // earlier.
                let product = if self.waiting.fuses(term.node) { PRODUCT } else { 0 };
                self.need(term.node, by - product);
            }
        }
    }

    /// Returns the terms in the order that fuses one more product, if the sum is then still known in time.
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
    use robot_symbolic::Random;

    use crate::passes::testing::{assert_same_values, inputs_only, random_polynomials};
    use crate::program::{Builder, Source, Value};

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
        // This term is known late: if the sum started with it, both products would wait for it.
        let late = b.call(Function::Sqrt, v);
        let sum = b.add(products, late);
        let program = b.finish(vec![sum]);
        assert_eq!(Counts::of(&fusing::run(&run(&program))).fused, 1);
    }

    /// A sum that is also a factor: its product has to be known before the last factor is known.
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

    /// x y + z w + r, where r is the reciprocal of a chain of `late` sums. Another result is a reciprocal divided
    /// `spare` times.
    fn fused_with(late: usize, spare: usize) -> usize {
        let mut b = Builder::new();
        let loads: Vec<_> = (0..40).map(|index| b.load(Source::Input(index))).collect();
        let chain = |b: &mut Builder, first: usize, count: usize| {
            (0..count).fold(loads[first], |sum, place| b.add(sum, loads[first + 1 + place]))
        };
        let (xy, zw) = (b.mul(loads[0], loads[1]), b.mul(loads[2], loads[3]));
        let products = b.add(xy, zw);
        let late = chain(&mut b, 4, late);
        // Shared, so that it is a node of its own.
        let late = b.call(Function::RecipPositive, late);
        let sum = b.add(products, late);
        let other = b.call(Function::RecipPositive, loads[20]);
        let other = (0..spare).fold(other, |value, place| b.div(value, loads[21 + place]));
        let program = b.finish(vec![sum, other]);
        Counts::of(&fusing::run(&run(&program))).fused
    }

    /// A sum can start with a late term if another result is even later.
    #[test]
    fn time_to_spare_is_used() {
        // The sum with the late term first is known at 13 + 2 · 4 cycles, with it last at 13 + 3.
        assert_eq!([0, 1, 2].map(|spare| fused_with(0, spare)), [1, 2, 2]);
        // At 16 + 8 cycles; two quotients take 26, one 13.
        assert_eq!([0, 1, 2].map(|spare| fused_with(1, spare)), [1, 2, 2]);
        assert_eq!([0, 1, 2].map(|spare| fused_with(2, spare)), [1, 1, 2]);
    }

    /// Layers of a b ± c d + e, with quotients and functions between them. A value for which one result waits
    /// can be early enough for the others.
    fn layers(seed: u64) -> Program {
        let mut random = Random::new(seed);
        let mut b = Builder::new();
        let mut pool: Vec<Value> = (0..12).map(|index| b.load(Source::Input(index))).collect();
        for _ in 0..20 {
            let recent = pool.len() - 12;
            let [x, y, z, u, v] =
                [(); 5].map(|()| pool[recent * random.index(2) + random.index(12)]);
            let (xy, zu) = (b.mul(x, y), b.mul(z, u));
            let products = if random.index(2) == 0 { b.add(xy, zu) } else { b.sub(xy, zu) };
            let zuxy = if random.index(3) == 0 { b.mul(products, zu) } else { products };
            let sum = b.add(zuxy, v);
            pool.push(match random.index(6) {
                0 => b.div(sum, x),
                1 => b.div(y, sum),
                2 => b.call(Function::Abs, sum),
                3 => b.call(Function::RecipPositive, sum),
                _ => sum,
            });
        }
        b.finish(pool[pool.len() - 4..].to_vec())
    }

    /// No program's last result is later than in the order of arrival, and more products fuse.
    #[test]
    fn nothing_is_lost_against_the_order_of_arrival() {
        let (mut before, mut after) = (0, 0);
        for seed in 0..400 {
            let program =
                if seed % 4 == 0 { inputs_only(&random_polynomials(seed)) } else { layers(seed) };
            let waiting = arrival::ordered(&program, true);
            let ordered = waiting.view.program();
            let mut order = Order { needed: vec![u32::MAX; waiting.ids().len()], waiting };
            let end = |waiting: &Waiting| {
                let results = waiting.view.results.iter();
                results.map(|term| waiting.known(term.node)).max()
            };
            let old = end(&order.waiting);
            order.run();
            for id in order.waiting.ids() {
                order.waiting.settle(id);
            }
            assert!(end(&order.waiting) <= old, "seed {seed}");
            let found = order.waiting.view.program();
            assert_eq!(found, run(&program), "seed {seed}");
            before += Counts::of_calls(&fusing::run(&ordered)).fused;
            after += Counts::of_calls(&fusing::run(&found)).fused;
        }
        assert!(before == 9675 && after >= 9863, "{before} became {after}");
    }
}
