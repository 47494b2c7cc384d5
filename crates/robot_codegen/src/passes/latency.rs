//! The latencies of operations, in cycles.
//!
//! The values are those of current x86-64 cores (Zen 4, from Fog's instruction tables); their ratios are similar on
//! 64-bit ARM cores. [`latency`] is the latency of a single call by itself; it determines the order of sums and
//! products. [`shared_latency`] is the latency if calls overlap; it determines the order of statements.

use robot_symbolic::Function;

use crate::program::Operation;

/// Cycles from the operands of a sum to its value.
pub(super) const SUM: u32 = 3;
/// Cycles from the factors of a product to its value.
pub(super) const PRODUCT: u32 = 3;
/// Cycles from the operands of a multiply-add to its value.
pub(super) const FUSED: u32 = 4;
/// Cycles from the operands of a quotient to its value.
pub(super) const QUOTIENT: u32 = 13;
/// Cycles from the argument of a function to its value.
pub(super) const CALL: u32 = 20;

/// Cycles from the argument of a function to its value; a reciprocal counts as a quotient.
pub(super) fn of_call(function: Function) -> u32 {
    if function == Function::RecipPositive { QUOTIENT } else { CALL }
}

/// Cycles from the operands of an operation to its value. Changes of sign are part of the instructions that follow.
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

/// Cycles from the start of an operation to its value in the scheduler's model of a processor: half of [`latency`],
/// rounded up, because processors work on the next call while this one waits. In the model, a change of sign is a
/// separate instruction.
pub(super) fn shared_latency(operation: Operation) -> u32 {
    match operation {
        Operation::Neg(_) => 1,
        other => latency(other).div_ceil(2),
    }
}
