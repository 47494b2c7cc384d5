//! Lists of vector instructions on values, before registers are allocated.
//!
//! All values are of one kind: a vector register, of which code for one state uses the first lane. A function call in a
//! program becomes a few instructions of the list, so that registers are allocated for sines as for sums.

mod functions;
mod lower;
mod order;
mod schedule;
mod side_by_side;
mod stores;

use rustc_hash::FxHashMap;

pub(crate) use self::lower::{Missing, Sines, lower};
pub(crate) use self::order::{needed, operands};
pub(crate) use self::schedule::Model;
use crate::processor::Registers;

/// The value of an instruction, by its position in the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Id(u32);

impl Id {
    pub(crate) fn at(position: usize) -> Id {
        Id(position as u32)
    }

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A place in memory from which values are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Home {
    /// A constant of the pool, the same in all lanes.
    Constant(u32),
    /// A row of different constants of the pool, for a wide value.
    Row(u32),
    /// An entry of the inputs; for a wide value, the first entry.
    Input(u32),
}

/// Instructions on two values: on floating-point numbers, on their bits, or on these as integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    /// The first if it is less than the second, otherwise the second, also if either is NaN.
    Min,
    And,
    Or,
    Xor,
    AddInteger,
    SubInteger,
    /// All bits in lanes in which the first is greater as a signed integer, otherwise none.
    GreaterInteger,
}

impl Binary {
    pub(crate) fn commutes(self) -> bool {
        use Binary::*;
        matches!(self, Add | Mul | And | Or | Xor | AddInteger)
    }

    /// Whether the instruction for one state reads a single number from memory, not all lanes of a register.
    pub(crate) fn is_arithmetic(self) -> bool {
        use Binary::*;
        matches!(self, Add | Sub | Mul | Div | Min)
    }
}

/// An instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Instruction {
    /// A value that is in memory and is read where it is used.
    Home(Home),
    Binary(Binary, Id, Id),
    /// Square root.
    Sqrt(Id),
    /// The bits shifted to the left.
    ShiftLeft(Id, u8),
    /// The sign bit in all bits; AVX2 does not have this instruction.
    SpreadSign(Id),
    /// a b + c, rounded once.
    MulAdd(Id, Id, Id),
    /// The first numbers of two values, in the lanes of one.
    Pair(Id, Id),
    /// The first two numbers of two values, in the lanes of one.
    Join(Id, Id),
    /// The second number of a value, as the first.
    Second(Id),
    /// The third and fourth numbers of a value, as the first and second.
    Upper(Id),
}

impl Instruction {
    /// The same instruction on other values.
    pub(crate) fn map(self, at: impl Fn(Id) -> Id) -> Instruction {
        match self {
            Instruction::Home(home) => Instruction::Home(home),
            Instruction::Binary(binary, a, b) => Instruction::Binary(binary, at(a), at(b)),
            Instruction::Sqrt(a) => Instruction::Sqrt(at(a)),
            Instruction::ShiftLeft(a, by) => Instruction::ShiftLeft(at(a), by),
            Instruction::SpreadSign(a) => Instruction::SpreadSign(at(a)),
            Instruction::MulAdd(a, b, c) => Instruction::MulAdd(at(a), at(b), at(c)),
            Instruction::Pair(a, b) => Instruction::Pair(at(a), at(b)),
            Instruction::Join(a, b) => Instruction::Join(at(a), at(b)),
            Instruction::Second(a) => Instruction::Second(at(a)),
            Instruction::Upper(a) => Instruction::Upper(at(a)),
        }
    }
}

/// A step of a list. An [`Id`] is the position of the step that computes the value.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    /// Computes the value whose [`Id`] is the position of this step.
    Value(Instruction),
    /// Stores a value in the outputs, in the entry with this index. A wide value takes this entry and those that follow
    /// it. The step computes nothing, so no instruction refers to its position.
    Store(Id, u32),
    /// Stores two values, which are not wide, in the outputs: the first in the entry with this index, the second in the
    /// entry after it.
    StorePair(Id, Id, u32),
}

impl Step {
    /// Whether the step stores results.
    fn is_store(self) -> bool {
        matches!(self, Step::Store(..) | Step::StorePair(..))
    }
}

/// The number of numbers in a wide value.
pub(crate) const WIDE: usize = 4;

/// Instructions in their order.
#[derive(Debug, Default)]
pub(crate) struct List {
    pub(crate) steps: Vec<Step>,
    /// For each step, whether the value that it computes or stores is wide: in code for one state, it consists of
    /// [`WIDE`] numbers in lanes.
    pub(crate) wide: Vec<bool>,
    homes: FxHashMap<(Home, bool), Id>,
}

impl List {
    fn push(&mut self, step: Step, wide: bool) -> Id {
        self.steps.push(step);
        self.wide.push(wide);
        Id(self.steps.len() as u32 - 1)
    }
}

/// The constants of a function by their bits, each once.
#[derive(Debug, Default)]
pub(crate) struct Pool {
    bits: Vec<u64>,
    index: FxHashMap<u64, u32>,
    rows: Vec<[u64; WIDE]>,
}

impl Pool {
    pub(crate) fn constant(&mut self, bits: u64) -> u32 {
        let next = self.bits.len() as u32;
        let index = *self.index.entry(bits).or_insert(next);
        if index == next {
            self.bits.push(bits);
        }
        index
    }

    /// Adds a row of constants and returns its index.
    pub(crate) fn row(&mut self, row: [u64; WIDE]) -> u32 {
        let known = self.rows.iter().position(|known| *known == row);
        let index = known.unwrap_or(self.rows.len());
        if index == self.rows.len() {
            self.rows.push(row);
        }
        index as u32
    }

    /// The number of constants, without the rows.
    pub(crate) fn count(&self) -> usize {
        self.bits.len()
    }

    /// The contents of the pool: each constant repeated `times` times, followed by the rows.
    pub(crate) fn spread(&self, times: usize) -> Vec<u64> {
        let constants = self.bits.iter().flat_map(|bits| std::iter::repeat_n(*bits, times));
        constants.chain(self.rows.iter().flatten().copied()).collect()
    }
}

/// A list under construction, with its constants and its target.
pub(crate) struct Writer<'p> {
    pub(crate) list: List,
    pub(crate) pool: &'p mut Pool,
    pub(crate) registers: Registers,
    /// Whether multiply-adds in sines and cosines round once.
    pub(crate) fused: bool,
    /// Whether the next values are wide.
    wide: bool,
}

impl<'p> Writer<'p> {
    pub(crate) fn new(pool: &'p mut Pool, registers: Registers, fused: bool) -> Writer<'p> {
        Writer { list: List::default(), pool, registers, fused, wide: false }
    }

    pub(crate) fn value(&mut self, instruction: Instruction) -> Id {
        self.list.push(Step::Value(instruction), self.wide)
    }

    pub(crate) fn store(&mut self, value: Id, entry: u32) {
        self.list.push(Step::Store(value, entry), self.wide);
    }

    /// Stores two values in an entry of the outputs and the next one.
    fn store_pair(&mut self, values: [Id; 2], entry: u32) {
        self.list.push(Step::StorePair(values[0], values[1], entry), self.wide);
    }

    /// Stores constants in neighboring entries.
    fn store_row(&mut self, entry: u32, row: [u64; WIDE]) {
        self.wide = true;
        let row = Home::Row(self.pool.row(row));
        let row = self.home(row);
        self.store(row, entry);
        self.wide = false;
    }

    pub(crate) fn home(&mut self, home: Home) -> Id {
        if let Some(id) = self.list.homes.get(&(home, self.wide)) {
            return *id;
        }
        let id = self.value(Instruction::Home(home));
        self.list.homes.insert((home, self.wide), id);
        id
    }

    pub(crate) fn bits(&mut self, bits: u64) -> Id {
        let index = self.pool.constant(bits);
        self.home(Home::Constant(index))
    }

    pub(crate) fn number(&mut self, number: f64) -> Id {
        self.bits(number.to_bits())
    }

    pub(crate) fn binary(&mut self, binary: Binary, a: Id, b: Id) -> Id {
        self.value(Instruction::Binary(binary, a, b))
    }
}
