//! Arrival times of values: cycles from the start of a call, on a processor without limits of throughput.

use super::latency::{FUSED, PRODUCT, QUOTIENT, SUM, latency, of_call};
use super::nary::{Id, Nary, Node, Term};
use crate::program::Program;

/// Returns the cycles from the start of a program to the last of its results.
pub(super) fn longest_chain(program: &Program) -> u32 {
    let mut known: Vec<u32> = Vec::with_capacity(program.operations().len());
    for operation in program.operations() {
        let ready = operation.operands().map(|operand| known[operand.index()]).max().unwrap_or(0);
        known.push(ready + latency(*operation));
    }
    program.results().iter().map(|value| known[value.index()]).max().unwrap_or(0)
}

/// A program as sums and products, with the arrival times of the nodes that are settled so far.
pub(super) struct Waiting {
    pub(super) view: Nary,
    uses: Vec<u32>,
    fused: bool,
    known: Vec<u32>,
}

impl Waiting {
    /// Makes the view of a program, in which no node is settled; `fused` is whether products will become part of
    /// multiply-adds.
    pub(super) fn new(program: &Program, fused: bool) -> Waiting {
        let view = Nary::new(program);
        let (uses, known) = (view.uses(), vec![0; view.len()]);
        Waiting { view, uses, fused, known }
    }

    /// The nodes of the program, operands before the nodes that use them.
    pub(super) fn ids(&self) -> std::ops::Range<Id> {
        0..self.known.len() as Id
    }

    /// The cycle at which a node is known; for a product that fuses, the cycle at which its factors are.
    pub(super) fn known(&self, id: Id) -> u32 {
        self.known[id as usize]
    }

    /// The cycle at which a node is known if it is the first term of a sum, where it is not fused.
    pub(super) fn known_first(&self, id: Id) -> u32 {
        self.known(id) + if self.fuses(id) { PRODUCT } else { 0 }
    }

    /// Whether a node is a product that becomes part of a multiply-add if it is not the first term of
    /// the one sum that uses it. A single use is taken to be a sum.
    pub(super) fn fuses(&self, id: Id) -> bool {
        let own = self.fused && self.uses[id as usize] == 1 && !self.view.is_early(id);
        own && matches!(self.view.node(id), Node::Product(factors) if factors.len() > 1)
    }

    /// The cycles that it takes to add a term to the terms before it.
    pub(super) fn added_by(&self, term: &Term) -> u32 {
        if self.fuses(term.node) { FUSED } else { SUM }
    }

    /// The cycle at which a sum is known if it adds its terms in this order.
    pub(super) fn sum(&self, terms: &[Term]) -> u32 {
        let Some((first, rest)) = terms.split_first() else { return 0 };
        rest.iter().fold(self.known_first(first.node), |sum, term| {
            sum.max(self.known(term.node)) + self.added_by(term)
        })
    }

    /// Computes the arrival time of a node whose operands are settled. A node that needs no inputs is known at the
    /// start.
    pub(super) fn settle(&mut self, id: Id) {
        if self.view.is_early(id) {
            return;
        }
        self.known[id as usize] = match self.view.node(id) {
            Node::Leaf(_) => 0,
            Node::Quotient(a, b) => self.known(*a).max(self.known(*b)) + QUOTIENT,
            Node::Call(function, term) => self.known(term.node) + of_call(*function),
            Node::Sum(terms) => self.sum(terms),
            Node::Product(factors) => {
                let last = if self.fuses(id) { 0 } else { PRODUCT };
                self.product(factors) + if factors.len() > 1 { last } else { 0 }
            }
        };
    }

    /// The cycle at which the last multiplication of a product can start if it multiplies its factors in this order.
    fn product(&self, factors: &[Id]) -> u32 {
        let Some((first, rest)) = factors.split_first() else { return 0 };
        let mut ready = self.known(*first);
        for (place, factor) in rest.iter().enumerate() {
            let before = if place == 0 { ready } else { ready + PRODUCT };
            ready = before.max(self.known(*factor));
        }
        ready
    }
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Function;

    use super::*;
    use crate::passes::arrival;
    use crate::passes::latency::CALL;
    use crate::passes::testing::{inputs_only, random_polynomials};
    use crate::program::{Builder, Operation, Source, Value};

    fn end(waiting: &Waiting) -> u32 {
        let results = waiting.view.results.iter();
        results.map(|term| waiting.known(term.node)).max().unwrap()
    }

    /// The arrival times of the view agree with the longest chain of operations in the program. Both exclude
    /// the operations of the constructor.
    #[test]
    fn the_last_result_is_known_at_the_end_of_the_longest_chain() {
        for seed in 0..200 {
            let program = inputs_only(&random_polynomials(seed));
            let plain = arrival::ordered(&program, false);
            assert_eq!(end(&plain), longest_chain(&plain.view.program()), "seed {seed}");
        }
    }

    /// The cycle at which the result of a program that `build` makes from inputs is known.
    fn known(fused: bool, build: impl Fn(&mut Builder, [Value; 5]) -> Value) -> u32 {
        let mut b = Builder::new();
        let loads = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
        let result = build(&mut b, loads);
        end(&arrival::ordered(&b.finish(vec![result]), fused))
    }

    #[test]
    fn each_operation_takes_its_cycles() {
        for fused in [false, true] {
            assert_eq!(known(fused, |b, [x, y, ..]| b.add(x, y)), SUM);
            assert_eq!(known(fused, |b, [x, y, ..]| b.div(x, y)), QUOTIENT);
            assert_eq!(known(fused, |b, [x, ..]| b.call(Function::Sqrt, x)), CALL);
            assert_eq!(known(fused, |b, [x, ..]| b.call(Function::RecipPositive, x)), QUOTIENT);
            let late = known(fused, |b, [x, y, z, ..]| {
                let (first, second) = (b.div(x, y), b.call(Function::Abs, z));
                b.div(first, second)
            });
            assert_eq!(late, CALL + QUOTIENT);
        }
        assert_eq!(known(false, |b, [x, y, ..]| b.mul(x, y)), PRODUCT);
        let product = known(false, |b, [x, y, z, u, _]| {
            let first = [y, z, u].into_iter().fold(x, |product, y| b.mul(product, y));
            b.add(first, x)
        });
        assert_eq!(product, 3 * PRODUCT + SUM);
        let parameter = known(false, |b, [x, y, ..]| {
            let p = b.load(Source::Parameter(0));
            let root = b.call(Function::Sqrt, p);
            let product = b.mul(x, root);
            b.add(product, y)
        });
        assert_eq!(parameter, PRODUCT + SUM);
    }

    #[test]
    fn the_last_product_of_a_sum_is_part_of_it() {
        let one = known(true, |b, [x, y, z, ..]| {
            let product = b.mul(x, y);
            b.add(product, z)
        });
        let two = known(true, |b, [x, y, z, u, _]| {
            let (first, second) = (b.mul(x, y), b.mul(z, u));
            b.add(first, second)
        });
        let three = known(true, |b, [x, y, z, u, v]| {
            let first = b.mul(x, y);
            let first = b.mul(first, z);
            let sum = b.add(first, u);
            b.add(sum, v)
        });
        assert_eq!((one, two, three), (FUSED, PRODUCT + FUSED, SUM + FUSED));
        // A product used by two sums is a multiplication of its own.
        let shared = known(true, |b, [x, y, z, u, _]| {
            let product = b.mul(x, y);
            let (first, second) = (b.add(product, z), b.add(product, u));
            b.div(first, second)
        });
        assert_eq!(shared, PRODUCT + SUM + QUOTIENT);
    }

    #[test]
    fn a_chain_is_as_long_as_its_operations() {
        let mut b = Builder::new();
        let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
        let fused = b.push(Operation::MulAdd(x, y, x));
        let minus = b.neg(fused);
        let difference = b.sub(y, minus);
        let product = b.mul(difference, x);
        let root = b.call(Function::Sqrt, product);
        let quotient = b.div(root, y);
        let reciprocal = b.call(Function::RecipPositive, quotient);
        let program = b.finish(vec![x, reciprocal, fused]);
        let expected = FUSED + SUM + PRODUCT + CALL + QUOTIENT + QUOTIENT;
        assert_eq!(longest_chain(&program), expected);
    }
}
