//! Lists of vector instructions on values, before these have registers.
//!
//! All is one kind of value: a vector register, of which code for one state uses the first lane. A function of a
//! program is a few instructions of the list, so that registers are given to sines as to sums.

mod functions;
mod lower;

use rustc_hash::FxHashMap;

pub(crate) use self::lower::{Angles, Missing, lower, sines};
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

/// A place in memory that values are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Home {
    /// A constant of the pool, the same in all lanes.
    Constant(u32),
    /// An entry of the inputs.
    Input(u32),
    /// A number of the working memory, where the parts of a function leave what the next ones read.
    Working(u32),
}

/// A place in memory that values are stored to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// An entry of the outputs.
    Output(u32),
    /// A number of the working memory.
    Working(u32),
}

/// Instructions on two values; of the floating-point numbers, of their bits, or of these as integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    /// The first if it is less than the second, else the second: this one too if either is NaN.
    Min,
    And,
    Or,
    Xor,
    AddInteger,
    SubInteger,
    /// All bits where the first is greater as a signed integer.
    GreaterInteger,
}

impl Binary {
    pub(crate) fn commutes(self) -> bool {
        use Binary::*;
        matches!(self, Add | Mul | And | Or | Xor | AddInteger)
    }

    /// Whether the instruction for one state reads one number of memory, and not all lanes of a register.
    pub(crate) fn is_arithmetic(self) -> bool {
        use Binary::*;
        matches!(self, Add | Sub | Mul | Div | Min)
    }
}

/// An instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Instruction {
    /// A value that is in memory, to be read where it is used.
    Home(Home),
    Binary(Binary, Id, Id),
    /// Square root.
    Sqrt(Id),
    /// The bits moved up.
    ShiftLeft(Id, u8),
    /// The sign in all bits; AVX-512 alone has it.
    SpreadSign(Id),
    /// a b + c, rounded once.
    MulAdd(Id, Id, Id),
}

impl Instruction {
    pub(crate) fn operands(self) -> impl Iterator<Item = Id> {
        let operands = match self {
            Instruction::Home(_) => [None; 3],
            Instruction::Sqrt(a) | Instruction::ShiftLeft(a, _) | Instruction::SpreadSign(a) => {
                [Some(a), None, None]
            }
            Instruction::Binary(_, a, b) => [Some(a), Some(b), None],
            Instruction::MulAdd(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        operands.into_iter().flatten()
    }
}

/// A step of a list.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    /// Computes the value at this position.
    Value(Instruction),
    /// Stores a value; the position has none.
    Store(Id, Target),
}

/// Instructions in their order.
#[derive(Debug)]
pub(crate) struct List {
    pub(crate) steps: Vec<Step>,
    homes: FxHashMap<Home, Id>,
}

impl List {
    pub(crate) fn new() -> List {
        List { steps: vec![], homes: FxHashMap::default() }
    }

    fn push(&mut self, step: Step) -> Id {
        self.steps.push(step);
        Id(self.steps.len() as u32 - 1)
    }

    fn value(&mut self, instruction: Instruction) -> Id {
        self.push(Step::Value(instruction))
    }

    fn home(&mut self, home: Home) -> Id {
        if let Some(id) = self.homes.get(&home) {
            return *id;
        }
        let id = self.value(Instruction::Home(home));
        self.homes.insert(home, id);
        id
    }

    fn store(&mut self, value: Id, target: Target) {
        self.push(Step::Store(value, target));
    }
}

/// The constants of a function by their bits, each once.
#[derive(Debug, Default)]
pub(crate) struct Pool {
    bits: Vec<u64>,
    index: FxHashMap<u64, u32>,
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

    /// Each constant so many times, one after the other.
    pub(crate) fn spread(&self, times: usize) -> Vec<u64> {
        self.bits.iter().flat_map(|bits| std::iter::repeat_n(*bits, times)).collect()
    }
}

/// A list under construction: its constants, and the processor that it is for.
pub(crate) struct Writer<'p> {
    pub(crate) list: List,
    pub(crate) pool: &'p mut Pool,
    pub(crate) registers: Registers,
}

impl<'p> Writer<'p> {
    pub(crate) fn new(pool: &'p mut Pool, registers: Registers) -> Writer<'p> {
        Writer { list: List::new(), pool, registers }
    }

    pub(crate) fn bits(&mut self, bits: u64) -> Id {
        let index = self.pool.constant(bits);
        self.list.home(Home::Constant(index))
    }

    pub(crate) fn number(&mut self, number: f64) -> Id {
        self.bits(number.to_bits())
    }

    pub(crate) fn binary(&mut self, binary: Binary, a: Id, b: Id) -> Id {
        self.list.value(Instruction::Binary(binary, a, b))
    }
}
