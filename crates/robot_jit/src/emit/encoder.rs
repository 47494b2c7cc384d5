//! Encoding of single instructions. The code does not use the stack: it gets pointers to all memory that it uses.

use iced_x86::{Code, Encoder, IcedError, Instruction, MemoryOperand, Register};

use super::codes::{self, Codes, code};
use super::{Addressing, Shape, Vectors};
use crate::list::{Binary, Home, WIDE};

/// The registers of the arguments of a function in the System V ABI.
const INPUTS: Register = Register::RDI;
const OUTPUTS: Register = Register::RSI;
const POOL: Register = Register::RDX;
const WORKING: Register = Register::RCX;
const STATE: Register = Register::R8;
const END: Register = Register::R9;
/// The register for pointers to columns.
const COLUMN: Register = Register::RAX;

/// The size of a number, in bytes.
const NUMBER: i64 = 8;

/// The last operand of an instruction.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operand {
    Register(u8),
    Memory(Memory),
}

/// A place in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Memory {
    Home(Home),
    /// A spilled value, at this number of the working memory.
    Spill(u32),
}

/// The forms of a multiply-add, named as for the processor; the result replaces `first`.
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
    pub(super) length: u64,
    /// The shape of values that are not wide.
    narrow: Shape,
    /// The shape of the current instruction.
    pub(super) shape: Shape,
    pub(super) addressing: Addressing,
    /// The number in the pool at which the rows of constants start.
    rows: usize,
    /// How many numbers the pointers to working memory and to constants are advanced by, so that displacements of one
    /// byte reach twice as many.
    reach: [i64; 2],
    /// The offset at which the code of a state starts.
    start: u64,
    /// The first error of the encoder.
    error: Option<IcedError>,
}

impl Bytes {
    pub(super) fn new(narrow: Shape, addressing: Addressing, rows: usize) -> Bytes {
        let encoder = Encoder::new(64);
        let reach = [0; 2];
        Bytes {
            encoder,
            length: 0,
            start: 0,
            narrow,
            shape: narrow,
            addressing,
            rows,
            reach,
            error: None,
        }
    }

    /// Advances the pointers of long code.
    pub(super) fn extend_reach(&mut self) {
        const STEPS: i64 = 128;
        self.reach = [STEPS * self.narrow.lanes as i64, STEPS];
        for (pointer, numbers) in [WORKING, POOL].into_iter().zip(self.reach) {
            let moved = (NUMBER * numbers) as i32;
            self.put(Instruction::with2(Code::Add_rm64_imm32, pointer, moved));
        }
        self.start = self.length;
    }

    /// The number of numbers in a value.
    pub(super) fn numbers(&self, wide: bool) -> u32 {
        if wide { WIDE as u32 } else { self.narrow.lanes as u32 }
    }

    /// Sets whether the next instructions are on wide values.
    pub(super) fn widen(&mut self, wide: bool) {
        self.shape.lanes = self.numbers(wide) as usize;
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

    /// The distance between constants in memory, in numbers. AVX2 has no operands that spread a number over all lanes,
    /// so that each constant fills a register there, a wide one in code for one state.
    pub(super) fn constant_numbers(narrow: Shape) -> usize {
        match narrow.vectors {
            Vectors::Avx512 => 1,
            Vectors::Avx2 => WIDE,
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

    /// The address of a place; `spread` is whether the instruction spreads one number over its lanes.
    fn memory(&mut self, memory: Memory, spread: bool) -> MemoryOperand {
        match memory {
            Memory::Spill(number) => Bytes::at(WORKING, i64::from(number) - self.reach[0], spread),
            Memory::Home(Home::Constant(index)) => {
                let numbers = Bytes::constant_numbers(self.narrow) as i64;
                Bytes::at(POOL, i64::from(index) * numbers - self.reach[1], spread)
            }
            Memory::Home(Home::Row(index)) => Bytes::at(
                POOL,
                self.rows as i64 + i64::from(index) * WIDE as i64 - self.reach[1],
                spread,
            ),
            Memory::Home(Home::Input(entry)) => match self.addressing {
                Addressing::Row => Bytes::at(INPUTS, i64::from(entry), spread),
                Addressing::Columns => self.column(INPUTS, entry),
            },
        }
    }

    /// The memory operand of an instruction on numbers (`arithmetic`) or on the bits of whole registers.
    fn third(&mut self, memory: Memory, arithmetic: bool) -> MemoryOperand {
        let is_constant = matches!(memory, Memory::Home(Home::Constant(_)));
        let spread = match self.shape.vectors {
            Vectors::Avx2 => false,
            Vectors::Avx512 if self.shape.lanes == 1 => !arithmetic,
            Vectors::Avx512 => is_constant,
        };
        self.memory(memory, spread)
    }

    /// Whether an instruction can read this memory as its operand.
    pub(super) fn reads(&self, memory: Memory, arithmetic: bool) -> bool {
        let Shape { vectors, lanes } = self.shape;
        let is_constant = matches!(memory, Memory::Home(Home::Constant(_)));
        // Bit operations on a single number would read beyond it.
        arithmetic || lanes > 1 || vectors == Vectors::Avx512 || is_constant
    }

    /// Returns the encoding of an instruction on these registers and memory.
    fn encoding(&self, codes: &Codes, registers: [u8; 2], memory: Option<&MemoryOperand>) -> Code {
        code(codes, self.short(registers, memory))
    }

    /// Returns the shape whose encoding is shorter. The encoding of AVX2 has only sixteen registers, and cannot spread
    /// numbers from memory.
    fn short(&self, registers: [u8; 2], memory: Option<&MemoryOperand>) -> Shape {
        let is_short = self.shape.vectors == Vectors::Avx512
            && self.shape.lanes <= WIDE
            && registers.iter().all(|register| *register < 16)
            && memory.is_none_or(|memory| {
                // The long encoding multiplies displacements of one byte by the size of the operand.
                let step = NUMBER * self.shape.lanes as i64;
                let byte = |displacement: i64| i8::try_from(displacement).is_ok();
                let displacement = memory.displacement;
                let is_scaled = displacement % step == 0 && byte(displacement / step);
                !memory.is_broadcast && (byte(displacement) || !is_scaled)
            });
        let vectors = if is_short { Vectors::Avx2 } else { self.shape.vectors };
        Shape { vectors, ..self.shape }
    }

    fn three(&mut self, codes: &Codes, to: u8, a: u8, b: Operand, arithmetic: bool) {
        let (first, second) = (self.vector(to), self.vector(a));
        let instruction = match b {
            Operand::Register(b) => {
                let code = self.encoding(codes, [to.max(a), b], None);
                Instruction::with3(code, first, second, self.vector(b))
            }
            Operand::Memory(memory) => {
                let memory = self.third(memory, arithmetic);
                let code = self.encoding(codes, [to, a], Some(&memory));
                Instruction::with3(code, first, second, memory)
            }
        };
        self.put(instruction);
    }

    pub(super) fn binary(&mut self, binary: Binary, to: u8, a: u8, b: Operand) {
        self.three(codes::binary(binary), to, a, b, binary.is_arithmetic());
    }

    pub(super) fn multiply_add(&mut self, form: Form, first: u8, second: u8, third: Operand) {
        let codes = match form {
            Form::F132 => &codes::FMA_132,
            Form::F213 => &codes::FMA_213,
            Form::F231 => &codes::FMA_231,
        };
        self.three(codes, first, second, third, true);
    }

    pub(super) fn sqrt(&mut self, to: u8, a: u8) {
        let code = self.encoding(&codes::SQRT, [to, a], None);
        let (to, a) = (self.vector(to), self.vector(a));
        self.put(match self.shape.lanes {
            1 => Instruction::with3(code, to, a, a),
            _ => Instruction::with2(code, to, a),
        });
    }

    pub(super) fn shift_left(&mut self, to: u8, a: u8, by: u8) {
        self.shift(self.encoding(&codes::SHIFT_LEFT, [to, a], None), to, a, by);
    }

    pub(super) fn spread_sign(&mut self, to: u8, a: u8) {
        self.shift(code(&codes::SPREAD_SIGN, self.shape), to, a, 63);
    }

    fn shift(&mut self, code: Code, to: u8, a: u8, by: u8) {
        let (to, a) = (self.vector(to), self.vector(a));
        self.put(Instruction::with3(code, to, a, u32::from(by)));
    }

    pub(super) fn copy(&mut self, to: u8, from: u8) {
        let code = self.encoding(&codes::COPY, [to, from], None);
        self.put(Instruction::with2(code, self.vector(to), self.vector(from)));
    }

    pub(super) fn load(&mut self, to: u8, memory: Memory) {
        let spreads = matches!(memory, Memory::Home(Home::Constant(_)));
        let memory = self.memory(memory, false);
        let code = match self.shape {
            // With AVX-512, constants are spread in either encoding.
            shape if spreads && shape.lanes > 1 => code(&codes::SPREAD, shape),
            _ => self.encoding(&codes::LOAD, [to; 2], Some(&memory)),
        };
        self.put(Instruction::with2(code, self.vector(to), memory));
    }

    fn store_to(&mut self, memory: MemoryOperand, from: u8) {
        let code = self.encoding(&codes::STORE, [from; 2], Some(&memory));
        self.put(Instruction::with2(code, memory, self.vector(from)));
    }

    /// Spills a register to working memory.
    pub(super) fn spill(&mut self, slot: u32, from: u8) {
        let memory = self.memory(Memory::Spill(slot), false);
        self.store_to(memory, from);
    }

    pub(super) fn store(&mut self, entry: u32, from: u8) {
        let memory = match self.addressing {
            Addressing::Row => Bytes::at(OUTPUTS, i64::from(entry), false),
            Addressing::Columns => self.column(OUTPUTS, entry),
        };
        self.store_to(memory, from);
    }

    /// Stores the first two numbers of a register.
    pub(super) fn store_pair(&mut self, entry: u32, from: u8) {
        let memory = Bytes::at(OUTPUTS, i64::from(entry), false);
        let code = match self.short([from; 2], None).vectors {
            Vectors::Avx2 => Code::VEX_Vmovupd_xmmm128_xmm,
            Vectors::Avx512 => Code::EVEX_Vmovupd_xmmm128_k1z_xmm,
        };
        self.put(Instruction::with2(code, memory, Register::XMM0 + u32::from(from)));
    }

    /// Puts the first numbers of two values into the lanes of one.
    pub(super) fn pair(&mut self, to: u8, a: u8, b: Operand) {
        let other = if let Operand::Register(b) = b { b } else { 0 };
        let is_long = self.short([to.max(a), other], None).vectors == Vectors::Avx512;
        let codes = |codes: [Code; 2]| codes[usize::from(is_long)];
        let (to, a) = (Register::XMM0 + u32::from(to), Register::XMM0 + u32::from(a));
        let instruction = match b {
            Operand::Register(b) => {
                let code = codes([
                    Code::VEX_Vunpcklpd_xmm_xmm_xmmm128,
                    Code::EVEX_Vunpcklpd_xmm_k1z_xmm_xmmm128b64,
                ]);
                Instruction::with3(code, to, a, Register::XMM0 + u32::from(b))
            }
            Operand::Memory(memory) => {
                let code = codes([Code::VEX_Vmovhpd_xmm_xmm_m64, Code::EVEX_Vmovhpd_xmm_xmm_m64]);
                let memory = self.memory(memory, false);
                Instruction::with3(code, to, a, memory)
            }
        };
        self.put(instruction);
    }

    /// Puts the first two numbers of two values into the lanes of one.
    pub(super) fn join(&mut self, to: u8, a: u8, b: u8) {
        let [to, a] = [to, a].map(|register| Register::YMM0 + u32::from(register));
        let code = match self.shape.vectors {
            Vectors::Avx2 => Code::VEX_Vinsertf128_ymm_ymm_xmmm128_imm8,
            Vectors::Avx512 => Code::EVEX_Vinsertf64x2_ymm_k1z_ymm_xmmm128_imm8,
        };
        self.put(Instruction::with4(code, to, a, Register::XMM0 + u32::from(b), 1));
    }

    /// Moves the second number of a value to the first lane.
    pub(super) fn second(&mut self, to: u8, a: u8) {
        let [to, a] = [to, a].map(|register| Register::XMM0 + u32::from(register));
        let code = match self.shape.vectors {
            Vectors::Avx2 => Code::VEX_Vunpckhpd_xmm_xmm_xmmm128,
            Vectors::Avx512 => Code::EVEX_Vunpckhpd_xmm_k1z_xmm_xmmm128b64,
        };
        self.put(Instruction::with3(code, to, a, a));
    }

    /// Moves the third and fourth numbers of a value to the first lanes.
    pub(super) fn upper(&mut self, to: u8, a: u8) {
        let code = match self.shape.vectors {
            Vectors::Avx2 => Code::VEX_Vextractf128_xmmm128_ymm_imm8,
            Vectors::Avx512 => Code::EVEX_Vextractf64x2_xmmm128_k1z_ymm_imm8,
        };
        let (to, a) = (Register::XMM0 + u32::from(to), Register::YMM0 + u32::from(a));
        self.put(Instruction::with3(code, to, a, 1));
    }

    /// Appends the end of the loop, which continues with the next states until all are done.
    pub(super) fn repeat(&mut self) {
        let lanes = self.narrow.lanes as i32;
        self.put(Instruction::with2(Code::Add_rm64_imm8, STATE, lanes));
        self.put(Instruction::with2(Code::Cmp_r64_rm64, STATE, END));
        self.put(Instruction::with_branch(Code::Jb_rel32_64, self.start));
    }

    pub(super) fn end(&mut self) {
        self.put(Ok(Instruction::with(Code::VEX_Vzeroupper)));
        self.put(Ok(Instruction::with(Code::Retnq)));
    }
}
