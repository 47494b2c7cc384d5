//! Machine code of x86-64 from lists.

mod codes;
mod encoder;
mod function;
mod registers;

pub(crate) use self::function::{Entry, Fault, LanesEntry, SingleEntry, emit_lanes, emit_single};
use crate::processor::Registers;

/// What code is made for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    pub(crate) registers: Registers,
    /// Whether multiply-adds of sines round once.
    pub(crate) fused: bool,
}

/// The registers, and how many of their numbers an instruction computes: 1, 4 or 8.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) registers: Registers,
    pub(crate) lanes: usize,
}

/// Where the entries of inputs and outputs are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Addressing {
    /// One after the other.
    Row,
    /// Each in a column of its own; the columns are given by pointers, and a register has the state.
    Columns,
}
