//! Machine code from lists: of x86-64 here, of other processors by cranelift.

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

/// Instructions of x86-64.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vectors {
    Avx2,
    Avx512,
}

impl Vectors {
    /// The instructions on registers, if they are of x86-64 and code is made for them here.
    fn of(registers: Registers) -> Option<Vectors> {
        match registers {
            Registers::Avx2 => Some(Vectors::Avx2),
            Registers::Avx512 => Some(Vectors::Avx512),
            Registers::Bits128 => None,
        }
    }

    /// How many registers there are.
    const fn count(self) -> usize {
        match self {
            Vectors::Avx2 => 16,
            Vectors::Avx512 => 32,
        }
    }
}

/// The instructions, and how many numbers one computes: 1, 4 or 8.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) vectors: Vectors,
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
