//! The number of operations that only one value needs.

use std::cell::{Cell, RefCell};
use std::ops::Deref;

use crate::program::{Operation, Program, Stage, Value};

/// The most values that all queries together may visit; after that, every gain is 0. A query on a sum of n terms can
/// visit all of them, so n queries can visit n² values. Robots with 64 joints stay far below this limit.
const MAX_VISITS: u64 = 30_000_000;

/// The values from which a value is computed: at most three, stored inline because there are many of these lists.
#[derive(Clone, Copy, Default)]
pub(super) struct Operands {
    values: [Value; 3],
    len: u8,
}

impl FromIterator<Value> for Operands {
    fn from_iter<I: IntoIterator<Item = Value>>(values: I) -> Operands {
        let mut operands = Operands::default();
        for (place, value) in operands.values.iter_mut().zip(values) {
            *place = value;
            operands.len += 1;
        }
        operands
    }
}

impl Deref for Operands {
    type Target = [Value];

    fn deref(&self) -> &[Value] {
        &self.values[..usize::from(self.len)]
    }
}

/// The operations of a program under replacement, with their uses.
pub(super) struct Cones {
    operands: Vec<Operands>,
    costs: Vec<usize>,
    early: Vec<bool>,
    /// The number of uses of each value by needed values. Queries change it temporarily.
    uses: RefCell<Vec<usize>>,
    /// The number of values that queries have visited.
    visits: Cell<u64>,
    /// For each value, the number of the last query of [`Cones::depend_on`] that visited it.
    met: RefCell<Vec<u64>>,
    /// The number of queries of [`Cones::depend_on`].
    queries: Cell<u64>,
}

impl Cones {
    pub(super) fn new(program: &Program) -> Cones {
        let early: Vec<bool> = program.stages().iter().map(|stage| *stage < Stage::Call).collect();
        let cost = |(value, operation): (Value, Operation)| {
            let free = operation.is_leaf() || matches!(operation, Operation::Neg(_));
            usize::from(!free && !early[value.index()])
        };
        Cones {
            operands: program.values().map(|(_, op)| op.operands().collect()).collect(),
            costs: program.values().map(cost).collect(),
            uses: RefCell::new(program.uses().into_iter().map(|uses| uses as usize).collect()),
            met: RefCell::new(vec![0; early.len()]),
            early,
            visits: Cell::new(0),
            queries: Cell::new(0),
        }
    }

    /// Whether a value is known before the call.
    pub(super) fn is_early(&self, value: Value) -> bool {
        self.early[value.index()]
    }

    /// The values from which a value is computed.
    pub(super) fn operands(&self, value: Value) -> &[Value] {
        &self.operands[value.index()]
    }

    /// The number of operations that would be removed if the value were not needed.
    pub(super) fn size(&self, value: Value) -> usize {
        self.gain(value, &[], 0)
    }

    /// The number of operations that would be saved if the value were computed from other operands at this cost; 0
    /// if none would, or if the limit of visits has been reached.
    pub(super) fn gain(&self, value: Value, operands: &[Value], cost: usize) -> usize {
        let mut uses = self.uses.borrow_mut();
        if uses[value.index()] == 0 || self.visits.get() > MAX_VISITS {
            return 0;
        }
        let added: usize = operands.iter().map(|operand| self.retain(*operand, &mut uses)).sum();
        let inside = self.operands(value);
        let freed: usize = inside.iter().map(|operand| self.release(*operand, &mut uses)).sum();
        for operand in inside {
            self.retain(*operand, &mut uses);
        }
        for operand in operands {
            self.release(*operand, &mut uses);
        }
        (freed + self.costs[value.index()]).saturating_sub(added + cost)
    }

    /// Replaces the operands and the cost of a value.
    pub(super) fn replace(&mut self, value: Value, operands: Operands, cost: usize) {
        let mut uses = self.uses.borrow_mut();
        for operand in operands.iter() {
            self.retain(*operand, &mut uses);
        }
        for operand in self.operands(value) {
            self.release(*operand, &mut uses);
        }
        drop(uses);
        self.operands[value.index()] = operands;
        self.costs[value.index()] = cost;
    }

    /// Whether any of these values depends on a value.
    pub(super) fn depend_on(&self, values: &[Value], value: Value) -> bool {
        let query = self.queries.get() + 1;
        self.queries.set(query);
        let mut met = self.met.borrow_mut();
        let mut pending = values.to_vec();
        while let Some(next) = pending.pop() {
            if next == value {
                return true;
            }
            if std::mem::replace(&mut met[next.index()], query) != query {
                self.visits.set(self.visits.get() + 1);
                pending.extend(self.operands(next));
            }
        }
        false
    }

    /// Removes one use of a value; returns the cost of the values that are then no longer needed.
    fn release(&self, value: Value, uses: &mut [usize]) -> usize {
        let (mut pending, mut cost) = (vec![value], 0);
        while let Some(value) = pending.pop() {
            self.visits.set(self.visits.get() + 1);
            uses[value.index()] -= 1;
            if uses[value.index()] == 0 {
                cost += self.costs[value.index()];
                pending.extend(self.operands(value));
            }
        }
        cost
    }

    /// Adds one use of a value; returns the cost of the values that were not needed before.
    fn retain(&self, value: Value, uses: &mut [usize]) -> usize {
        let (mut pending, mut cost) = (vec![value], 0);
        while let Some(value) = pending.pop() {
            self.visits.set(self.visits.get() + 1);
            uses[value.index()] += 1;
            if uses[value.index()] == 1 {
                cost += self.costs[value.index()];
                pending.extend(self.operands(value));
            }
        }
        cost
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::dead_code;
    use crate::passes::testing::random_polynomials;
    use crate::program::{Builder, Source};

    #[test]
    fn queries_on_a_long_sum_end() {
        let mut b = Builder::new();
        let x = b.load(Source::Input(0));
        let mut sum = x;
        for number in 1..=40_000 {
            let factor = b.constant(1.0 + f64::from(number) / 7.0);
            let term = b.mul(factor, x);
            sum = b.add(sum, term);
        }
        let program = b.finish(vec![sum]);
        let cones = Cones::new(&program);
        assert_eq!(cones.size(sum), 80_000);
        let sizes: Vec<usize> = program.values().map(|(value, _)| cones.size(value)).collect();
        // Without the limit, 40,000 queries of up to 160,000 visits each would visit 3.2 billion values.
        assert!(cones.visits.get() <= MAX_VISITS + 400_000, "{}", cones.visits.get());
        assert_eq!(sizes.last(), Some(&0));
        // The queries do not stop before the limit.
        assert!(cones.visits.get() > MAX_VISITS, "{}", cones.visits.get());
    }

    /// The last query may reach the limit of visits; after that, every gain is 0.
    #[test]
    fn gains_end_after_the_limit_of_visits() {
        let mut b = Builder::new();
        let x = b.load(Source::Input(0));
        let square = b.mul(x, x);
        let cones = Cones::new(&b.finish(vec![square]));
        for (visits, size) in [(0, 1), (MAX_VISITS, 1), (MAX_VISITS + 1, 0)] {
            cones.visits.set(visits);
            assert_eq!(cones.size(square), size, "{visits}");
        }
    }

    /// Returns the cost of all needed values, with one value computed from other operands.
    fn needed(
        cones: &Cones,
        results: &[Value],
        value: Value,
        form: Option<(&[Value], usize)>,
    ) -> usize {
        let (mut pending, mut met, mut cost) =
            (results.to_vec(), vec![false; cones.costs.len()], 0);
        while let Some(next) = pending.pop() {
            if std::mem::replace(&mut met[next.index()], true) {
                continue;
            }
            let (operands, own) = match form {
                Some(form) if next == value => form,
                _ => (cones.operands(next), cones.costs[next.index()]),
            };
            cost += own;
            pending.extend(operands);
        }
        cost
    }

    /// A query gives the same result as a count of all operations, also after replacements.
    #[test]
    fn gains_are_differences_of_counts() {
        let mut gained = 0;
        for seed in 0..60 {
            let program = dead_code::run(&random_polynomials(seed));
            let results = program.results();
            let mut cones = Cones::new(&program);
            let values: Vec<Value> = program.values().map(|(value, _)| value).collect();
            for (value, operation) in program.values().filter(|(_, op)| !op.is_leaf()) {
                let call = program.stages()[value.index()] == Stage::Call;
                assert_eq!(cones.is_early(value), !call);
                let cost = usize::from(call && !matches!(operation, Operation::Neg(_)));
                assert_eq!(cones.costs[value.index()], cost);
            }
            for step in 0..40 {
                let value = values[(7 * step + 3) % values.len()];
                let operands = [values[step % values.len()], values[(5 * step) % values.len()]];
                if cones.uses.borrow()[value.index()] == 0 || cones.depend_on(&operands, value) {
                    continue;
                }
                let count = |form| needed(&cones, results, value, form);
                for cost in [0, 1, 2] {
                    let saved = count(None).saturating_sub(count(Some((&operands, cost))));
                    assert_eq!(cones.gain(value, &operands, cost), saved, "seed {seed}, {step}");
                }
                assert_eq!(cones.size(value), count(None) - count(Some((&[], 0))));
                if cones.gain(value, &operands, 1) > 0 {
                    gained += 1;
                    cones.replace(value, operands.into_iter().collect(), 1);
                    assert_eq!(cones.operands(value), operands);
                }
            }
        }
        assert!(gained > 100, "{gained}");
    }

    /// The gain of a value that nothing needs is 0, and a value depends on itself and its operands.
    #[test]
    fn dependence_is_along_operands() {
        let mut b = Builder::new();
        let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
        let sum = b.add(x, y);
        let (square, other) = (b.mul(sum, sum), b.mul(y, z));
        let unused = b.add(x, z);
        let program = b.finish(vec![square, other]);
        let cones = Cones::new(&program);
        // The query visits the operands of the square: the sum twice and its two loads, first to release and then to
        // hold them.
        assert_eq!((cones.size(square), cones.visits.get()), (2, 8));
        // This query visits the square, the sum once, and one of its loads.
        assert!(cones.depend_on(&[square], x) && cones.visits.get() > 9);
        assert_eq!([square, other, sum, unused].map(|value| cones.size(value)), [2, 1, 1, 0]);
        for _ in 0..2 {
            assert!(cones.depend_on(&[square], x) && cones.depend_on(&[other, sum], x));
            assert!(cones.depend_on(&[sum], sum) && !cones.depend_on(&[sum], square));
            assert!(!cones.depend_on(&[other], x) && !cones.depend_on(&[], x));
        }
    }

    /// A value with two uses stays if one of them is removed.
    #[test]
    fn shared_values_stay() {
        let mut b = Builder::new();
        let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
        let sum = b.add(x, y);
        let (first, second) = (b.mul(sum, x), b.mul(sum, y));
        let cones = Cones::new(&b.finish(vec![first, second]));
        assert_eq!((cones.size(first), cones.size(second), cones.size(sum)), (1, 1, 1));
    }
}
