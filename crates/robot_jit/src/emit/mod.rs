//! Machine code from lists: for x86-64 here, for other processors by cranelift.

mod codes;
mod encoder;
mod function;
mod registers;

pub(crate) use self::function::{Entry, Fault, LanesEntry, SingleEntry, emit_lanes, emit_single};
use crate::processor::Registers;

/// The target of code.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    pub(crate) registers: Registers,
    /// Whether multiply-adds in sines and cosines round once.
    pub(crate) fused: bool,
}

/// The vector instructions of x86-64.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vectors {
    Avx2,
    Avx512,
}

impl Vectors {
    /// Returns the instructions for these registers, if they are registers of x86-64 that are supported here.
    fn of(registers: Registers) -> Option<Vectors> {
        match registers {
            Registers::Avx2 => Some(Vectors::Avx2),
            Registers::Avx512 => Some(Vectors::Avx512),
            Registers::Bits128 => None,
        }
    }

    /// The number of registers.
    const fn count(self) -> usize {
        match self {
            Vectors::Avx2 => 16,
            Vectors::Avx512 => 32,
        }
    }
}

/// The instructions, and the number of lanes on which each computes: 1, 4 or 8.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) vectors: Vectors,
    pub(crate) lanes: usize,
}

/// The layout of the entries of inputs and outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Addressing {
    /// One after the other.
    Row,
    /// Each in a column of its own. The arguments point to pointers to the columns, and a register has the state.
    Columns,
}
