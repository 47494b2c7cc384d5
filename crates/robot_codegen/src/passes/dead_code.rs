//! Dead code: operations that no result needs. In generated code they would be unused variables.

use crate::program::{Operation, Program, Value};

/// Removes operations that no result needs; the order of the others does not change.
#[must_use]
pub(super) fn run(program: &Program) -> Program {
    let mut needed = vec![false; program.operations().len()];
    for value in program.results() {
        needed[value.index()] = true;
    }
    for (value, operation) in program.values().rev() {
        if needed[value.index()] {
            for operand in operation.operands() {
                needed[operand.index()] = true;
            }
        }
    }
    let mut operations: Vec<Operation> = vec![];
    let mut moved = vec![Value(0); needed.len()];
    for (value, operation) in program.values() {
        if needed[value.index()] {
            moved[value.index()] = Value(operations.len() as u32);
            operations.push(operation.map(|operand| moved[operand.index()]));
        }
    }
    let results = program.results().iter().map(|value| moved[value.index()]);
    Program::new(operations, results.collect())
}
