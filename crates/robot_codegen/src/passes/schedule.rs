//! Scheduling: the order of statements.

use crate::program::{Operation, Program, Value};

/// The order of statements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Schedule {
    /// As the expressions were built.
    Construction,
    /// Depth first from the results, of two operands first the one that needs more registers, so
    /// that values live briefly.
    #[default]
    DepthFirst,
}

/// Orders the statements. Not a bit changes.
#[must_use]
pub fn run(program: &Program, schedule: Schedule) -> Program {
    match schedule {
        Schedule::Construction => program.clone(),
        Schedule::DepthFirst => depth_first(program),
    }
}

fn depth_first(program: &Program) -> Program {
    let registers = registers(program);
    let mut moved: Vec<Option<Value>> = vec![None; registers.len()];
    let mut operations: Vec<Operation> = vec![];
    for result in program.results() {
        let mut pending = vec![*result];
        while let Some(value) = pending.last().copied() {
            let operation = program.operation(value);
            let mut missing: Vec<Value> = vec![];
            if moved[value.index()].is_none() {
                missing.extend(
                    operation.operands().filter(|operand| moved[operand.index()].is_none()),
                );
            }
            if missing.is_empty() {
                pending.pop();
                if moved[value.index()].is_none() {
                    let at = |operand: Value| moved[operand.index()].unwrap_or(operand);
                    operations.push(operation.map(at));
                    moved[value.index()] = Some(Value(operations.len() as u32 - 1));
                }
            } else {
                // The last goes first.
                missing.sort_by_key(|operand| registers[operand.index()]);
                pending.extend(missing);
            }
        }
    }
    let results = program.results().iter();
    let results = results.map(|value| moved[value.index()].unwrap_or(*value));
    Program::new(operations, results.collect())
}

/// The registers that each value needs if nothing were shared (Sethi and Ullman 1970).
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

    #[test]
    fn bits_stay() {
        assert_same_bits("scheduling", |program| run(program, Schedule::DepthFirst));
    }

    #[test]
    fn values_live_no_longer() {
        // The sum over all values of how long they live, over many programs.
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
}
