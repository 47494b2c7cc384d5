//! Value numbering: equal operations become one value, by the rules of [`Builder`].

use crate::program::{Builder, Program, Value};

/// Rebuilds the program so that each operation occurs once. No bits of a finite result change.
#[must_use]
pub(super) fn run(program: &Program) -> Program {
    let mut builder = Builder::new();
    let mut values: Vec<Value> = Vec::with_capacity(program.operations().len());
    for operation in program.operations() {
        let operation = operation.map(|operand| values[operand.index()]);
        values.push(builder.apply(operation));
    }
    let results = program.results().iter().map(|value| values[value.index()]);
    builder.finish(results.collect())
}
