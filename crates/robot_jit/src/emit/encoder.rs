//! Bytes of single instructions. Code uses no stack: all memory is given to it by pointers.

use iced_x86::{Code, Encoder, IcedError, Instruction, MemoryOperand, Register};

use super::codes::{self, code};
use super::{Addressing, Shape};
use crate::list::{Binary, Home, Target};
use crate::processor::Registers;

/// The arguments of a function, as the ABI of System V has them.
const INPUTS: Register = Register::RDI;
const OUTPUTS: Register = Register::RSI;
const POOL: Register = Register::RDX;
const WORKING: Register = Register::RCX;
const STATE: Register = Register::R8;
const END: Register = Register::R9;
/// For pointers to columns.
const COLUMN: Register = Register::RAX;

/// The bytes of a number.
const NUMBER: i64 = 8;

/// What an instruction reads beside its registers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operand {
    Register(u8),
    Memory(Memory),
}

/// A place in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Memory {
    Home(Home),
    /// A register that was put aside.
    Spill(u32),
}

/// The forms of a multiply-add, named as the processor does: `first` is replaced by the result.
#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    /// first · third + second
    F132,
    /// second · first + third
    F213,
    /// second · third + first
    F231,
}

/// Encodes instructions one after the other.
pub(super) struct Bytes {
    encoder: Encoder,
    length: u64,
    pub(super) shape: Shape,
    pub(super) addressing: Addressing,
    /// The number of the working memory at which registers are put aside.
    pub(super) spills: u32,
    /// The number at which the constants of the list lie.
    pub(super) constants: usize,
    /// The first thing that had no encoding.
    error: Option<IcedError>,
}

impl Bytes {
    pub(super) fn new(shape: Shape, addressing: Addressing, spills: u32) -> Bytes {
        let encoder = Encoder::new(64);
        Bytes { encoder, length: 0, shape, addressing, spills, constants: 0, error: None }
    }

    pub(super) fn finish(mut self) -> Result<Vec<u8>, IcedError> {
        match self.error {
            Some(error) => Err(error),
            None => Ok(self.encoder.take_buffer()),
        }
    }

    fn put(&mut self, instruction: Result<Instruction, IcedError>) {
        let length = self.length;
        match instruction.and_then(|instruction| self.encoder.encode(&instruction, length)) {
            Ok(length) => self.length += length as u64,
            Err(error) => self.error = self.error.take().or(Some(error)),
        }
    }

    fn vector(&self, register: u8) -> Register {
        let first = match self.shape.lanes {
            1 => Register::XMM0,
            4 => Register::YMM0,
            _ => Register::ZMM0,
        };
        first + u32::from(register)
    }

    /// The bytes between constants in memory. AVX2 has no instruction that spreads one, so that there
    /// they fill a register; masks for one number read sixteen bytes.
    pub(super) fn constant_numbers(shape: Shape) -> usize {
        match (shape.registers, shape.lanes) {
            (Registers::Avx512, _) => 1,
            (Registers::Avx2, 1) => 2,
            (Registers::Avx2, lanes) => lanes,
        }
    }

    fn at(base: Register, numbers: i64, spread: bool) -> MemoryOperand {
        MemoryOperand::new(base, Register::None, 1, NUMBER * numbers, 1, spread, Register::None)
    }

    fn column(&mut self, table: Register, entry: u32) -> MemoryOperand {
        let pointer = Bytes::at(table, i64::from(entry), false);
        self.put(Instruction::with2(Code::Mov_r64_rm64, COLUMN, pointer));
        MemoryOperand::new(COLUMN, STATE, NUMBER as u32, 0, 0, false, Register::None)
    }

    /// The address; `spread` where the instruction is to spread one number over its lanes.
    fn memory(&mut self, memory: Memory, spread: bool) -> MemoryOperand {
        let lanes = self.shape.lanes as i64;
        match memory {
            Memory::Spill(slot) => {
                let numbers = i64::from(self.spills) + i64::from(slot) * lanes;
                Bytes::at(WORKING, numbers, spread)
            }
            Memory::Home(Home::Working(index)) => Bytes::at(WORKING, i64::from(index), spread),
            Memory::Home(Home::Constant(index)) => {
                let numbers = Bytes::constant_numbers(self.shape) as i64;
                Bytes::at(POOL, self.constants as i64 + i64::from(index) * numbers, spread)
            }
            Memory::Home(Home::Input(entry)) => match self.addressing {
                Addressing::Row => Bytes::at(INPUTS, i64::from(entry), spread),
                Addressing::Columns => self.column(INPUTS, entry),
            },
        }
    }

    /// An operand of an instruction that computes numbers (`arithmetic`) or bits of whole registers.
    fn third(&mut self, memory: Memory, arithmetic: bool) -> MemoryOperand {
        let is_constant = matches!(memory, Memory::Home(Home::Constant(_)));
        let spread = match self.shape.registers {
            Registers::Avx2 => false,
            Registers::Avx512 if self.shape.lanes == 1 => !arithmetic,
            Registers::Avx512 => is_constant,
        };
        self.memory(memory, spread)
    }

    /// Whether an instruction may read this memory itself.
    pub(super) fn reads(&self, memory: Memory, arithmetic: bool) -> bool {
        let Shape { registers, lanes } = self.shape;
        let is_constant = matches!(memory, Memory::Home(Home::Constant(_)));
        // Masks for one number would read beyond it.
        arithmetic || lanes > 1 || registers == Registers::Avx512 || is_constant
    }

    fn three(&mut self, code: Code, to: u8, a: u8, b: Operand, arithmetic: bool) {
        let (to, a) = (self.vector(to), self.vector(a));
        let instruction = match b {
            Operand::Register(b) => Instruction::with3(code, to, a, self.vector(b)),
            Operand::Memory(memory) => {
                let memory = self.third(memory, arithmetic);
                Instruction::with3(code, to, a, memory)
            }
        };
        self.put(instruction);
    }

    pub(super) fn binary(&mut self, binary: Binary, to: u8, a: u8, b: Operand) {
        let code = code(codes::binary(binary), self.shape);
        self.three(code, to, a, b, binary.is_arithmetic());
    }

    pub(super) fn multiply_add(&mut self, form: Form, first: u8, second: u8, third: Operand) {
        let codes = match form {
            Form::F132 => &codes::FMA_132,
            Form::F213 => &codes::FMA_213,
            Form::F231 => &codes::FMA_231,
        };
        self.three(code(codes, self.shape), first, second, third, true);
    }

    pub(super) fn sqrt(&mut self, to: u8, a: u8) {
        let code = code(&codes::SQRT, self.shape);
        let (to, a) = (self.vector(to), self.vector(a));
        self.put(match self.shape.lanes {
            1 => Instruction::with3(code, to, a, a),
            _ => Instruction::with2(code, to, a),
        });
    }

    pub(super) fn shift_left(&mut self, to: u8, a: u8, by: u8) {
        self.shift(code(&codes::SHIFT_LEFT, self.shape), to, a, by);
    }

    pub(super) fn spread_sign(&mut self, to: u8, a: u8) {
        self.shift(code(&codes::SPREAD_SIGN, self.shape), to, a, 63);
    }

    fn shift(&mut self, code: Code, to: u8, a: u8, by: u8) {
        let (to, a) = (self.vector(to), self.vector(a));
        self.put(Instruction::with3(code, to, a, u32::from(by)));
    }

    pub(super) fn copy(&mut self, to: u8, from: u8) {
        let (to, from) = (self.vector(to), self.vector(from));
        self.put(Instruction::with2(code(&codes::COPY, self.shape), to, from));
    }

    pub(super) fn load(&mut self, to: u8, memory: Memory) {
        let codes = match memory {
            Memory::Home(Home::Constant(_)) => &codes::SPREAD,
            _ => &codes::LOAD,
        };
        let (to, memory) = (self.vector(to), self.memory(memory, false));
        self.put(Instruction::with2(code(codes, self.shape), to, memory));
    }

    fn store_to(&mut self, memory: MemoryOperand, from: u8) {
        let from = self.vector(from);
        self.put(Instruction::with2(code(&codes::STORE, self.shape), memory, from));
    }

    /// Puts a register aside.
    pub(super) fn spill(&mut self, slot: u32, from: u8) {
        let memory = self.memory(Memory::Spill(slot), false);
        self.store_to(memory, from);
    }

    pub(super) fn store(&mut self, target: Target, from: u8) {
        let memory = match (target, self.addressing) {
            (Target::Working(index), _) => Bytes::at(WORKING, i64::from(index), false),
            (Target::Output(entry), Addressing::Row) => Bytes::at(OUTPUTS, i64::from(entry), false),
            (Target::Output(entry), Addressing::Columns) => self.column(OUTPUTS, entry),
        };
        self.store_to(memory, from);
    }

    /// Goes on with the next states, back at the start, until all are done.
    pub(super) fn repeat(&mut self) {
        let lanes = self.shape.lanes as i32;
        self.put(Instruction::with2(Code::Add_rm64_imm8, STATE, lanes));
        self.put(Instruction::with2(Code::Cmp_r64_rm64, STATE, END));
        self.put(Instruction::with_branch(Code::Jb_rel32_64, 0));
    }

    pub(super) fn end(&mut self) {
        self.put(Ok(Instruction::with(Code::VEX_Vzeroupper)));
        self.put(Ok(Instruction::with(Code::Retnq)));
    }
}
