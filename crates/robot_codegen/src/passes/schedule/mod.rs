//! Scheduling: the order of statements.

mod throughput;

use crate::program::{Operation, Program, Value};

/// The order of statements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Schedule {
    /// As the expressions were built.
    Construction,
    /// Depth first from the results, so that values are alive for a short time. Of two operands, the one that needs
    /// more registers comes first.
    DepthFirst,
    /// The operation for which results wait longest comes first, while there are free registers, so that a processor
    /// has work while it waits (`schedule/throughput.rs`). Programs that are too long for one function are ordered
    /// depth first, so that few values are passed from one function to the next.
    #[default]
    Throughput,
}

/// The number of operations above which [`Schedule::Throughput`] orders depth first.
const LONG: usize = 6000;

/// Orders the statements. No bits change.
#[must_use]
pub(super) fn run(program: &Program, schedule: Schedule) -> Program {
    match schedule {
        Schedule::Construction => program.clone(),
        Schedule::Throughput if program.operations().len() <= LONG => throughput::run(program),
        Schedule::DepthFirst | Schedule::Throughput => depth_first(program),
    }
}

/// The operations of a program in another order, each after its operands.
struct Reordering {
    moved: Vec<Option<Value>>,
    operations: Vec<Operation>,
}

impl Reordering {
    fn of(program: &Program) -> Reordering {
        Reordering { moved: vec![None; program.operations().len()], operations: vec![] }
    }

    fn has(&self, value: Value) -> bool {
        self.moved[value.index()].is_some()
    }

    /// Appends an operation, whose operands must already be in the new order.
    fn push(&mut self, value: Value, operation: Operation) {
        let at = |operand: Value| self.moved[operand.index()].unwrap_or(operand);
        self.operations.push(operation.map(at));
        self.moved[value.index()] = Some(Value(self.operations.len() as u32 - 1));
    }

    fn finish(self, program: &Program) -> Program {
        let results = program.results().iter();
        let results = results.map(|value| self.moved[value.index()].unwrap_or(*value)).collect();
        Program::new(self.operations, results)
    }
}

fn depth_first(program: &Program) -> Program {
    let registers = registers(program);
    let mut order = Reordering::of(program);
    for result in program.results() {
        let mut pending = vec![*result];
        while let Some(value) = pending.last().copied() {
            let operation = program.operation(value);
            let mut missing: Vec<Value> = vec![];
            if !order.has(value) {
                missing.extend(operation.operands().filter(|operand| !order.has(*operand)));
            }
            if missing.is_empty() {
                pending.pop();
                if !order.has(value) {
                    order.push(value, operation);
                }
            } else {
                // The last of `pending` is taken first.
                missing.sort_by_key(|operand| registers[operand.index()]);
                pending.extend(missing);
            }
        }
    }
    order.finish(program)
}

/// Returns the number of registers that each value would need if no values were shared (Sethi and Ullman 1970).
fn registers(program: &Program) -> Vec<u32> {
    let mut registers: Vec<u32> = Vec::with_capacity(program.operations().len());
    for operation in program.operations() {
        let mut needs: Vec<u32> = operation.operands().map(|a| registers[a.index()]).collect();
        needs.sort_unstable_by(|a, b| b.cmp(a));
        let need = needs.iter().zip(0..).map(|(need, held)| need + held).max();
        registers.push(need.unwrap_or(u32::from(!operation.is_leaf())).max(1));
    }
    registers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::testing::{assert_same_bits, random_program};
    use crate::program::{Builder, Source};

    #[test]
    fn bits_stay() {
        assert_same_bits("depth first", |program| run(program, Schedule::DepthFirst));
        assert_same_bits("throughput", |program| run(program, Schedule::Throughput));
    }

    #[test]
    fn values_live_no_longer() {
        // The sum of the live ranges of all values, over many programs.
        let lifetimes = |program: &Program| -> usize {
            let mut last: Vec<usize> = (0..program.operations().len()).collect();
            for (value, operation) in program.values() {
                for operand in operation.operands() {
                    last[operand.index()] = value.index();
                }
            }
            last.iter().enumerate().map(|(index, last)| last - index).sum()
        };
        let programs = || (0..200).map(|seed| super::super::dead_code::run(&random_program(seed)));
        let before: usize = programs().map(|program| lifetimes(&program)).sum();
        let after: usize =
            programs().map(|program| lifetimes(&run(&program, Schedule::DepthFirst))).sum();
        assert!(after * 10 < before * 9, "{before} became {after}");
    }

    /// Two registers for a chain of loads, and one more for each level of a tree.
    #[test]
    fn registers_are_those_of_sethi_and_ullman() {
        let mut b = Builder::new();
        let loads: Vec<Value> = (0..8).map(|index| b.load(Source::Input(index))).collect();
        let pairs: Vec<Value> = loads.chunks(2).map(|pair| b.add(pair[0], pair[1])).collect();
        let fours: Vec<Value> = pairs.chunks(2).map(|pair| b.mul(pair[0], pair[1])).collect();
        let tree = b.sub(fours[0], fours[1]);
        let chain = loads[1..].iter().fold(loads[0], |chain, load| b.mul(chain, *load));
        let (root, three) =
            (b.neg(fours[0]), b.push(Operation::MulAdd(pairs[0], loads[5], pairs[1])));
        let program = b.finish(vec![tree, chain, root, three]);
        let registers = registers(&program);
        let of = |value: Value| registers[value.index()];
        assert_eq!([loads[0], pairs[3], fours[1], tree, chain, root].map(of), [1, 2, 3, 4, 2, 3]);
        // Two pairs, of which the first is kept while the second is computed, and one more load.
        assert_eq!(of(three), 3);
    }

    /// Of two operands, the one that needs more registers comes first, on either side.
    #[test]
    fn the_operand_of_more_registers_is_first() {
        for swapped in [false, true] {
            let mut b = Builder::new();
            let [x, y, z, w] = [0, 1, 2, 3].map(|index| b.load(Source::Input(index)));
            let single = b.call(robot_symbolic::Function::Abs, x);
            let (first, second) = (b.add(x, y), b.add(z, w));
            let tree = b.mul(first, second);
            let last = if swapped { b.div(tree, single) } else { b.div(single, tree) };
            let ordered = run(&b.finish(vec![last]), Schedule::DepthFirst);
            let place =
                |wanted: fn(&Operation) -> bool| ordered.operations().iter().position(wanted);
            let product = place(|operation| matches!(operation, Operation::Mul(..)));
            let call = place(|operation| matches!(operation, Operation::Call(..)));
            assert!(product < call, "{ordered:?}");
        }
    }

    #[test]
    fn long_programs_are_ordered_depth_first() {
        let products = |operations: usize| {
            let mut b = Builder::new();
            let (x, y) = (b.load(Source::Input(0)), b.load(Source::Input(1)));
            let (mut first, mut second) = (x, y);
            let count = operations - 3;
            for index in 0..count {
                // The second chain, built last, is the longer.
                let chain = if index < count / 3 { &mut first } else { &mut second };
                *chain = b.mul(*chain, x);
            }
            let sum = b.add(first, second);
            let program = b.finish(vec![sum]);
            assert_eq!(program.operations().len(), operations);
            program
        };
        let (short, long) = (products(LONG), products(LONG + 1));
        assert_eq!(run(&short, Schedule::Throughput), throughput::run(&short));
        assert_eq!(run(&long, Schedule::Throughput), depth_first(&long));
        for program in [&short, &long] {
            assert_ne!(throughput::run(program), depth_first(program));
            assert_eq!(run(program, Schedule::DepthFirst), depth_first(program));
            assert_eq!(&run(program, Schedule::Construction), program);
        }
    }

    /// Each operation occurs once, after its operands, and there are no others.
    #[test]
    fn no_operation_is_lost_or_made() {
        for seed in 0..100 {
            let program = super::super::dead_code::run(&random_program(seed));
            for schedule in [Schedule::Construction, Schedule::DepthFirst, Schedule::Throughput] {
                let ordered = run(&program, schedule);
                assert_eq!(ordered.operations().len(), program.operations().len());
                assert_eq!(super::super::dead_code::run(&ordered), ordered);
            }
        }
    }
}
