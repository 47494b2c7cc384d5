//! An estimate of the stack that generated code needs, without a compiler.

use super::LANGUAGE;
use crate::module::Function;
use crate::program::{Program, Statements, Value};

/// The stack of a function in bytes, without its named values: return addresses, saved registers, places of
/// arguments, values within an expression.
const FIXED: usize = 256;

/// Estimates from above the bytes of stack that a call of a function needs without optimization, not counting the
/// stack of sines and cosines. `scalar` is the size of a number, 8 or 4 bytes.
///
/// Without optimization, rustc gives every named value a place of its own. The estimate counts each statement of the
/// program once; the values that leave a block twice more, as parts of its tuple and under their outer names;
/// the entries of inputs, angles, sines and cosines twice, in their arrays and in patterns; the outputs four times, as
/// numbers, as rows, as arrays and as the result; and a quarter of the values that wait within an expression for
/// another operand, because registers hold the others. Optimized code needs less. The estimate is not a proof: tests
/// compare it with compiled code of every robot of the project, and `robot-symbolic prove` measures the stack.
#[must_use]
pub fn estimate(function: &Function, scalar: usize) -> usize {
    let programs = [&function.core, &function.angles];
    let statements: usize = programs.iter().map(|program| statements(program).count()).sum();
    let inputs: usize = function.inputs.iter().map(|input| input.symbols.len()).sum();
    let angles = 3 * function.angles.results().len();
    let outputs = function.core.results().len();
    let leaving: usize = programs.iter().map(|program| leaving(program)).sum();
    let live_values: usize = programs.iter().map(|program| live_values(program)).sum();
    FIXED
        + scalar
            * (statements + live_values / 4 + 2 * leaving + 2 * (inputs + angles) + 4 * outputs)
}

/// The number of values without a name that wait for another operand of the operation that uses them.
fn live_values(program: &Program) -> usize {
    let grouped = statements(program);
    let is_inside =
        |value: &Value| !grouped.is_named(*value) && !program.operation(*value).is_leaf();
    let inside =
        program.operations().iter().map(|operation| operation.operands().filter(is_inside));
    inside.map(|operands| operands.count().saturating_sub(1)).sum()
}

/// The number of values that leave blocks, if there are several blocks.
fn leaving(program: &Program) -> usize {
    let grouped = statements(program);
    let blocks = || grouped.parts.iter().flat_map(|part| &part.blocks);
    if blocks().count() < 2 { 0 } else { blocks().map(|block| block.leaving.len()).sum() }
}

/// Groups a program into statements of Rust.
fn statements(program: &Program) -> Statements {
    Statements::new(program, &LANGUAGE.limits)
}
