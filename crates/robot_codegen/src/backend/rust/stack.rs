//! An estimate of the stack that generated code takes, without a compiler.

use super::LANGUAGE;
use crate::module::Function;
use crate::program::{Program, Statements, Value};

/// The stack of a function apart from its values: return addresses, saved registers, places of
/// arguments, an expression's values while it is computed.
const FIXED: usize = 256;

/// An estimate, from above, of the bytes of stack that a call of a function takes if nothing is
/// optimized, sines and cosines themselves apart. `scalar` is the size of a number, 8 or 4 bytes.
///
/// Without optimization rustc gives every named value a place of its own. There are the statements
/// of the program, those that leave a block twice more, as a part of its tuple and by their outer name;
/// the entries of inputs, angles, sines and cosines, each twice: in its array and
/// where a pattern takes it; the outputs four times: as numbers, as rows, as arrays and as the
/// result; and one in four of the values that wait inside an expression for another one, for the rest
/// while registers last. Optimized code takes less. This is not a proof: tests compare it with what the compiler
/// makes of every robot of the project, and `robot-symbolic prove` measures.
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

/// The values without a name that wait for another operand of what uses them.
fn live_values(program: &Program) -> usize {
    let grouped = statements(program);
    let is_inside =
        |value: &Value| !grouped.is_named(*value) && !program.operation(*value).is_leaf();
    let inside =
        program.operations().iter().map(|operation| operation.operands().filter(is_inside));
    inside.map(|operands| operands.count().saturating_sub(1)).sum()
}

/// The values that leave blocks, if there are several.
fn leaving(program: &Program) -> usize {
    let grouped = statements(program);
    let blocks = || grouped.parts.iter().flat_map(|part| &part.blocks);
    if blocks().count() < 2 { 0 } else { blocks().map(|block| block.leaving.len()).sum() }
}

/// The statements of a program as Rust.
fn statements(program: &Program) -> Statements {
    Statements::new(program, &LANGUAGE.limits)
}
