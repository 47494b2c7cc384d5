//! The latencies of operations, in cycles.
//!
//! The numbers are those of current x86-64 cores (Zen 4, after Fog's instruction tables); on 64-bit ARM
//! cores their ratios are much the same. One call by itself waits for [`latency`], which orders its sums and products;
//! among other calls it waits for [`shared_latency`], which orders the statements.

use robot_symbolic::Function;

use crate::program::Operation;

/// From the operands of a sum to its value.
pub(super) const SUM: u32 = 3;
/// From the factors of a product to its value.
pub(super) const PRODUCT: u32 = 3;
/// From the operands of a multiply-add to its value.
pub(super) const FUSED: u32 = 4;
/// From the operands of a quotient to its value.
pub(super) const QUOTIENT: u32 = 13;
/// From the argument of a function to its value.
pub(super) const CALL: u32 = 20;

/// From the argument of a function to its value; a reciprocal is a quotient.
pub(super) fn of_call(function: Function) -> u32 {
    if function == Function::RecipPositive { QUOTIENT } else { CALL }
}

/// Cycles from the operands of an operation to its value; signs are part of the instructions that follow.
pub(super) fn latency(operation: Operation) -> u32 {
    match operation {
        Operation::Constant(_) | Operation::Load(_) | Operation::Neg(_) => 0,
        Operation::Add(..) | Operation::Sub(..) => SUM,
        Operation::Mul(..) => PRODUCT,
        Operation::MulAdd(..) => FUSED,
        Operation::Div(..) => QUOTIENT,
        Operation::Call(function, _) => of_call(function),
    }
}

/// Cycles that the scheduler's processor takes from the start of an operation to its value: half of [`latency`], rounded
/// up, for processors work on the next call while this one waits. A change of sign is an instruction of its own there.
pub(super) fn shared_latency(operation: Operation) -> u32 {
    match operation {
        Operation::Neg(_) => 1,
        other => latency(other).div_ceil(2),
    }
}
