//! List scheduling (Graham 1969): the order in which a simple processor would start the operations.
//!
//! A call waits for chains of dependent operations: about 100 cycles for an arm with six joints, without the sines
//! and cosines, which is twice the time that its operations need if they overlap. A processor looks only a few hundred
//! instructions ahead, so it does not find work at the other end of a function. Here, the operation for which
//! results wait longest starts first.
//!
//! The model of a processor starts two products and two sums in each cycle, as current x86-64 and 64-bit ARM cores do.
//! Its latencies are half of theirs (`latency.rs`), because they work on the next call while this one waits. Other
//! values of the model change the time of a call by up to 2 % for the arms in `docs/performance.md`. While more values
//! are live than there are registers, operations that end the live ranges of others go first.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use super::Reordering;
use crate::passes::latency::shared_latency;
use crate::program::{Operation, Program, Value};

/// The number of products, quotients and calls that start in a cycle.
const PRODUCTS: usize = 2;
/// The number of sums and changes of sign that start in a cycle.
const SUMS: usize = 2;
/// The number of live values from which on operations that end live ranges go first: 32 registers, minus a few for
/// operands from memory.
const REGISTERS: isize = 24;

fn is_sum(operation: Operation) -> bool {
    matches!(operation, Operation::Add(..) | Operation::Sub(..) | Operation::Neg(_))
}

/// The cycles from the start of each operation to the last result that waits for it.
fn heights(program: &Program) -> Vec<u32> {
    let mut heights = vec![0; program.operations().len()];
    for (value, operation) in program.values().rev() {
        let height = heights[value.index()] + shared_latency(operation);
        heights[value.index()] = height;
        for operand in operation.operands() {
            heights[operand.index()] = heights[operand.index()].max(height);
        }
    }
    heights
}

pub(super) fn run(program: &Program) -> Program {
    let mut list = List::new(program);
    while !list.is_empty() {
        list.cycle();
    }
    list.order.finish(program)
}

/// The state of the scheduler.
struct List<'p> {
    program: &'p Program,
    /// The cycles from the start of each operation to the last result that waits for it.
    height: Vec<u32>,
    /// The operations that use each value, each once.
    users: Vec<Vec<Value>>,
    /// For each operation, the number of operands that have not started.
    missing: Vec<usize>,
    /// For each value, the number of operations that still need it, plus one if it is a result.
    needed: Vec<usize>,
    /// For each operation, the number of operands that no other operation still needs: their live ranges end with it.
    ends: Vec<isize>,
    /// For each operation, the cycle in which its operands are known.
    start: Vec<u32>,
    /// Operations whose operands are known; first the one for which results wait longest.
    ready: BTreeSet<(Reverse<u32>, Value)>,
    /// Operations whose operands have started, by the cycle in which the operands are known.
    waiting: BTreeMap<u32, Vec<Value>>,
    now: u32,
    alive: isize,
    order: Reordering,
}

impl<'p> List<'p> {
    fn new(program: &'p Program) -> List<'p> {
        let count = program.operations().len();
        let mut list = List {
            program,
            height: heights(program),
            users: vec![vec![]; count],
            missing: vec![0; count],
            needed: vec![0; count],
            ends: vec![0; count],
            start: vec![0; count],
            ready: BTreeSet::new(),
            waiting: BTreeMap::new(),
            now: 0,
            alive: 0,
            order: Reordering::of(program),
        };
        for value in program.results() {
            list.needed[value.index()] = 1;
        }
        for (value, operation) in program.values().rev() {
            for operand in distinct(operation) {
                let index = operand.index();
                list.users[index].push(value);
                list.needed[index] += 1;
                list.missing[value.index()] += usize::from(!program.operation(operand).is_leaf());
            }
        }
        for (value, _) in program.values() {
            list.note_end(value);
        }
        for (value, operation) in program.values() {
            if operation.is_leaf() {
                list.order.push(value, operation);
            } else if list.missing[value.index()] == 0 {
                list.ready.insert((Reverse(list.height[value.index()]), value));
            }
        }
        list
    }

    fn is_empty(&self) -> bool {
        self.ready.is_empty() && self.waiting.is_empty()
    }

    /// Starts the operations of one cycle: at most `PRODUCTS` products and `SUMS` sums, fewer if no registers are left.
    fn cycle(&mut self) {
        while let Some(entry) = self.waiting.first_entry()
            && *entry.key() <= self.now
        {
            for value in entry.remove() {
                self.ready.insert((Reverse(self.height[value.index()]), value));
            }
        }
        let (mut products, mut sums) = (PRODUCTS, SUMS);
        while let Some(value) = self.choose(products > 0, sums > 0) {
            let operation = self.program.operation(value);
            // If no registers are left and this operation frees none, operations under way may free some.
            let under_way = products + sums < PRODUCTS + SUMS || !self.waiting.is_empty();
            if under_way && self.alive >= REGISTERS && self.growth(value) > 0 {
                break;
            }
            if is_sum(operation) {
                sums -= 1;
            } else {
                products -= 1;
            }
            self.begin(value, operation);
        }
        self.now += 1;
    }

    /// Returns the operation to start next, among those for which the cycle has room.
    fn choose(&self, products: bool, sums: bool) -> Option<Value> {
        let candidates = self.ready.iter().map(|(_, value)| *value);
        let mut candidates = candidates
            .filter(|value| if is_sum(self.program.operation(*value)) { sums } else { products });
        let first = candidates.next()?;
        if self.alive < REGISTERS || self.growth(first) <= 0 {
            return Some(first);
        }
        // Of those that add no live value, the one for which results wait longest.
        Some(candidates.find(|value| self.growth(*value) <= 0).unwrap_or(first))
    }

    /// Returns by how much the number of live values grows if an operation starts.
    fn growth(&self, value: Value) -> isize {
        1 - self.ends[value.index()]
    }

    /// If only one operation still needs a value, records this for all its users; for those that have already started
    /// it has no effect.
    fn note_end(&mut self, value: Value) {
        if self.needed[value.index()] == 1 && !self.program.operation(value).is_leaf() {
            for user in &self.users[value.index()] {
                self.ends[user.index()] += 1;
            }
        }
    }

    fn begin(&mut self, value: Value, operation: Operation) {
        self.ready.remove(&(Reverse(self.height[value.index()]), value));
        self.alive += self.growth(value);
        for operand in distinct(operation) {
            self.needed[operand.index()] -= 1;
            self.note_end(operand);
        }
        self.order.push(value, operation);
        let there = self.now + shared_latency(operation);
        for user in &self.users[value.index()] {
            let index = user.index();
            self.start[index] = self.start[index].max(there);
            self.missing[index] -= 1;
            if self.missing[index] == 0 {
                self.waiting.entry(self.start[index]).or_default().push(*user);
            }
        }
    }
}

/// The operands of an operation, each once.
fn distinct(operation: Operation) -> impl Iterator<Item = Value> {
    let operands: Vec<Value> = operation.operands().collect();
    let first = operands.clone();
    operands
        .into_iter()
        .enumerate()
        .filter(move |(index, operand)| !first[..*index].contains(operand))
        .map(|(_, operand)| operand)
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Function;

    use super::*;
    use crate::passes::dead_code;
    use crate::passes::testing::{random_polynomials, random_program};
    use crate::program::{Builder, Source};

    /// The sum of two chains of products, one twice as long, built one after the other.
    fn two_chains() -> Program {
        let mut builder = Builder::new();
        let x = builder.load(Source::Input(0));
        let mut chain = |source: u32, length: usize| {
            let mut value = builder.load(Source::Input(source));
            for _ in 0..length {
                value = builder.mul(value, x);
            }
            value
        };
        let (short, long) = (chain(1, 10), chain(2, 20));
        let sum = builder.add(short, long);
        builder.finish(vec![sum])
    }

    #[test]
    fn the_longest_chain_is_that_of_the_latencies() {
        assert_eq!(heights(&two_chains()).into_iter().max(), Some(20 * 2 + 2));
    }

    #[test]
    fn the_longer_chain_starts_first_and_the_shorter_fills_its_gaps() {
        let program = run(&two_chains());
        let products = program.values().filter(|(_, operation)| !operation.is_leaf());
        let height = heights(&program);
        let first: Vec<u32> = products.map(|(value, _)| height[value.index()]).take(4).collect();
        assert_eq!(first, [42, 22, 40, 20]);
    }

    #[test]
    fn few_values_are_live_although_many_could_be() {
        // A hundred products of two loads each, summed from the first to the last. All could start
        // at once, but would then have to wait for their sums.
        let mut builder = Builder::new();
        let mut sum = builder.load(Source::Input(0));
        for index in 0..100 {
            let [x, y] = [2 * index + 1, 2 * index + 2].map(|i| builder.load(Source::Input(i)));
            let product = builder.mul(x, y);
            sum = builder.add(sum, product);
        }
        let program = run(&builder.finish(vec![sum]));
        let mut last: Vec<usize> = (0..program.operations().len()).collect();
        for (value, operation) in program.values() {
            operation.operands().for_each(|operand| last[operand.index()] = value.index());
        }
        let alive = |at: usize| {
            let values = program.values().filter(|(_, operation)| !operation.is_leaf());
            values.filter(|(value, _)| value.index() <= at && last[value.index()] > at).count()
        };
        let most = (0..last.len()).map(alive).max().unwrap();
        // Operations under way are added to the 24 values; 32 registers are enough.
        assert!(most <= 26, "{most}");
    }

    /// A product of three dense matrices, with the reciprocals of some entries: many values are alive for a long time.
    fn matrices(size: u32) -> Program {
        let mut b = Builder::new();
        let mut entries = |first: u32| -> Vec<Value> {
            (0..size * size).map(|index| b.load(Source::Input(first + index))).collect()
        };
        let (left, right, third) = (entries(0), entries(100), entries(200));
        let size = size as usize;
        let mut product = |left: &[Value], right: &[Value]| -> Vec<Value> {
            let mut found = vec![];
            for (row, column) in (0..size * size).map(|index| (index / size, index % size)) {
                let mut sum = b.mul(left[row * size], right[column]);
                for k in 1..size {
                    let term = b.mul(left[row * size + k], right[k * size + column]);
                    sum = if k % 3 == 1 { b.sub(sum, term) } else { b.add(sum, term) };
                }
                found.push(if (row + column) % 4 == 0 {
                    b.call(Function::RecipPositive, sum)
                } else {
                    sum
                });
            }
            found
        };
        let first = product(&left, &right);
        let second = product(&first, &third);
        b.finish(second)
    }

    /// Returns the cycles that the model takes for a program in its order, and the largest number of values
    /// alive at once.
    fn cost(program: &Program) -> (u32, usize) {
        let mut there: Vec<u32> = vec![];
        let (mut now, mut room) = (0, [PRODUCTS, SUMS]);
        let mut last: Vec<usize> = (0..program.operations().len()).collect();
        for (value, operation) in program.values() {
            let ready =
                operation.operands().map(|operand| there[operand.index()]).max().unwrap_or(0);
            operation.operands().for_each(|operand| last[operand.index()] = value.index());
            if operation.is_leaf() {
                there.push(0);
                continue;
            }
            let kind = usize::from(is_sum(operation));
            if ready > now {
                (now, room) = (ready, [PRODUCTS, SUMS]);
            }
            if room[kind] == 0 {
                (now, room) = (now + 1, [PRODUCTS, SUMS]);
            }
            room[kind] -= 1;
            there.push(now + shared_latency(operation));
        }
        for result in program.results() {
            last[result.index()] = last.len();
        }
        let values: Vec<usize> = program
            .values()
            .filter(|(_, operation)| !operation.is_leaf())
            .map(|(value, _)| value.index())
            .collect();
        let alive =
            |at: usize| values.iter().filter(|value| **value <= at && last[**value] > at).count();
        (there.into_iter().max().unwrap_or(0), (0..last.len()).map(alive).max().unwrap_or(0))
    }

    /// Values of this model, as built and as ordered; another model would have others.
    #[test]
    fn time_and_registers_of_dense_matrices() {
        let costs = [2, 4, 6].map(|size| {
            let program = matrices(size);
            (cost(&program), cost(&run(&program)))
        });
        assert_eq!(costs, [((24, 6), (22, 7)), ((218, 20), (82, 26)), ((776, 42), (632, 62))]);
    }

    /// The sums over many random programs: of cycles, and of values alive.
    #[test]
    fn time_and_registers_of_random_programs() {
        let (mut before, mut after) = ((0, 0), (0, 0));
        for seed in 0..200 {
            let make = if seed % 2 == 0 { random_polynomials } else { random_program };
            let program = dead_code::run(&make(seed));
            let (old, new) = (cost(&program), cost(&run(&program)));
            before = (before.0 + old.0, before.1 + old.1);
            after = (after.0 + new.0, after.1 + new.1);
            let height = heights(&program).into_iter().max().unwrap_or(0);
            assert!(new.0 >= height, "seed {seed}");
        }
        assert_eq!((before, after), ((6708, 956), (3618, 1355)));
    }

    #[test]
    fn each_operation_has_its_shared_latency() {
        let mut b = Builder::new();
        let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
        let sum = b.add(x, y);
        let (minus, root) = (b.neg(sum), b.call(Function::Sqrt, sum));
        let quotient = b.div(root, x);
        let reciprocal = b.call(Function::RecipPositive, quotient);
        let fused = b.push(Operation::MulAdd(reciprocal, x, minus));
        let program = b.finish(vec![fused, sum]);
        assert_eq!(heights(&program), [28, 28, 28, 3, 26, 16, 9, 2]);
    }

    /// A value that is both operands of an operation counts as one operand.
    #[test]
    fn operands_are_listed_once() {
        let (x, y) = (Value(3), Value(5));
        let each = |operation| distinct(operation).collect::<Vec<_>>();
        assert_eq!(each(Operation::Mul(x, x)), [x]);
        assert_eq!(each(Operation::MulAdd(x, y, x)), [x, y]);
        assert_eq!(each(Operation::MulAdd(y, y, x)), [y, x]);
        assert_eq!(each(Operation::Sub(y, x)), [y, x]);
        assert!(each(Operation::Load(Source::Input(0))).is_empty());
    }

    /// The live range of a value ends with the last operation that needs it, except for results and loads.
    #[test]
    fn growth_is_one_less_what_ends() {
        let mut b = Builder::new();
        let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
        let (sum, difference) = (b.add(x, y), b.sub(x, y));
        let (product, square) = (b.mul(sum, difference), b.mul(sum, sum));
        let quotient = b.div(product, square);
        let program = b.finish(vec![quotient, difference]);
        let mut list = List::new(&program);
        let growth = |list: &List, values: [Value; 5]| values.map(|value| list.growth(value));
        let values = [sum, difference, product, square, quotient];
        assert_eq!(growth(&list, values), [1, 1, 1, 1, -1]);
        for (value, alive) in [(difference, 1), (sum, 2), (square, 3), (product, 3), (quotient, 2)]
        {
            list.begin(value, program.operation(value));
            assert_eq!(list.alive, alive, "{value:?}");
            if value == square {
                // Only the product needs the sum now.
                assert_eq!(list.growth(product), 0);
            }
        }
        assert_eq!(list.missing, [0; 7]);
    }
}
