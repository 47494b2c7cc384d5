//! Translation of the steps of a list to instructions of cranelift.

use cranelift_codegen::cursor::FuncCursor;
use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::types::{F64, F64X2, I64, I64X2};
use cranelift_codegen::ir::{Endianness, InstBuilder, MemFlagsData, Type, Value};

use crate::list::{Binary, Home, Id, Instruction, List, Step, needed};

/// The size of a number, in bytes.
const NUMBER: i32 = 8;

/// The number of steps for which a value that is also in memory keeps its register; later uses read it again.
const KEPT: usize = 24;

/// The arguments of a function.
#[derive(Clone, Copy)]
pub(super) struct Pointers {
    pub(super) inputs: Value,
    pub(super) outputs: Value,
    pub(super) pool: Value,
    /// In code for columns, the number of bytes from the start of a column to the current state. If `None`, inputs and
    /// outputs are rows.
    pub(super) state: Option<Value>,
}

struct Body<'l, 'b, 'f> {
    list: &'l List,
    cursor: &'b mut FuncCursor<'f>,
    pointers: Pointers,
    /// The type of values; `integer` is that of their bits.
    float: Type,
    integer: Type,
    /// For each step, its value and the last step that may use it; later steps read it again from memory.
    values: Vec<Option<(Value, usize)>>,
    /// The index of the current step.
    position: usize,
}

/// Writes the instructions of the list's steps at the cursor; each value has `lanes` numbers, one or two.
pub(super) fn write(
    list: &List,
    cursor: &mut FuncCursor<'_>,
    lanes: usize,
    pointers: Pointers,
) -> Result<(), String> {
    let (float, integer) = if lanes == 1 { (F64, I64) } else { (F64X2, I64X2) };
    let values = vec![None; list.steps.len()];
    let mut body = Body { list, cursor, pointers, float, integer, values, position: 0 };
    let needed = needed(list);
    for (position, step) in list.steps.iter().enumerate().filter(|(position, _)| needed[*position])
    {
        body.position = position;
        match *step {
            Step::Value(Instruction::Home(_)) => {}
            Step::Value(instruction) => {
                let value = body.compute(instruction)?;
                body.values[position] = Some((value, usize::MAX));
            }
            Step::Store(value, entry) => {
                let value = body.value(value)?;
                let (pointer, offset) = body.entry(pointers.outputs, entry);
                body.cursor.ins().store(Body::memory(), value, pointer, offset);
            }
        }
    }
    Ok(())
}

impl Body<'_, '_, '_> {
    /// The flags of accesses to memory that exists and is aligned at least as a number.
    fn memory() -> MemFlagsData {
        MemFlagsData::new().with_notrap()
    }

    /// Returns the pointer and offset of an entry of the inputs or outputs.
    fn entry(&mut self, pointers: Value, entry: u32) -> (Value, i32) {
        let offset = NUMBER * entry as i32;
        match self.pointers.state {
            None => (pointers, offset),
            Some(state) => {
                let column = self.cursor.ins().load(I64, Body::memory(), pointers, offset);
                (self.cursor.ins().iadd(column, state), 0)
            }
        }
    }

    fn value(&mut self, id: Id) -> Result<Value, String> {
        if let Some((value, last)) = self.values[id.index()]
            && self.position <= last
        {
            return Ok(value);
        }
        let Step::Value(Instruction::Home(home)) = self.list.steps[id.index()] else {
            return Err(format!("step {} is used before it is computed", id.index()));
        };
        let value = match home {
            Home::Constant(index) => {
                let offset = NUMBER * index as i32;
                let number =
                    self.cursor.ins().load(F64, Body::memory(), self.pointers.pool, offset);
                if self.float == F64 { number } else { self.cursor.ins().splat(F64X2, number) }
            }
            Home::Input(entry) => {
                let (pointer, offset) = self.entry(self.pointers.inputs, entry);
                self.cursor.ins().load(self.float, Body::memory(), pointer, offset)
            }
            Home::Row(_) => return Err("there are no rows of 128 bits".to_owned()),
        };
        self.values[id.index()] = Some((value, self.position + KEPT));
        Ok(value)
    }

    fn cast(&mut self, to: Type, value: Value) -> Value {
        let flags = MemFlagsData::new().with_endianness(Endianness::Little);
        self.cursor.ins().bitcast(to, flags, value)
    }

    /// Appends an operation on the bits of values.
    fn on_bits(
        &mut self,
        values: [Value; 2],
        operation: impl FnOnce(&mut FuncCursor<'_>, Value, Value) -> Value,
    ) -> Value {
        let [a, b] = values.map(|value| self.cast(self.integer, value));
        let result = operation(self.cursor, a, b);
        self.cast(self.float, result)
    }

    fn compute(&mut self, instruction: Instruction) -> Result<Value, String> {
        Ok(match instruction {
            Instruction::Binary(binary, a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                return self.binary(binary, a, b);
            }
            Instruction::Sqrt(a) => {
                let a = self.value(a)?;
                self.cursor.ins().sqrt(a)
            }
            Instruction::MulAdd(a, b, c) => {
                let (a, b, c) = (self.value(a)?, self.value(b)?, self.value(c)?);
                self.cursor.ins().fma(a, b, c)
            }
            Instruction::ShiftLeft(a, by) => {
                let a = self.value(a)?;
                let by = i64::from(by);
                self.on_bits([a; 2], |cursor, a, _| cursor.ins().ishl_imm_u(a, by))
            }
            Instruction::SpreadSign(a) => {
                let a = self.value(a)?;
                self.on_bits([a; 2], |cursor, a, _| cursor.ins().sshr_imm_u(a, 63))
            }
            Instruction::Home(_)
            | Instruction::Pair(..)
            | Instruction::Join(..)
            | Instruction::Second(_)
            | Instruction::Upper(_) => return Err(format!("{instruction:?} is of wide values")),
        })
    }

    fn binary(&mut self, binary: Binary, a: Value, b: Value) -> Result<Value, String> {
        Ok(match binary {
            Binary::Add => self.cursor.ins().fadd(a, b),
            Binary::Sub => self.cursor.ins().fsub(a, b),
            Binary::Mul => self.cursor.ins().fmul(a, b),
            Binary::Div => self.cursor.ins().fdiv(a, b),
            Binary::And => self.cursor.ins().band(a, b),
            Binary::Or => self.cursor.ins().bor(a, b),
            Binary::Xor => self.cursor.ins().bxor(a, b),
            Binary::Min => {
                let is_less = self.cursor.ins().fcmp(FloatCC::LessThan, a, b);
                if self.float == F64 {
                    self.cursor.ins().select(is_less, a, b)
                } else {
                    let mask = self.cast(self.float, is_less);
                    self.cursor.ins().bitselect(mask, a, b)
                }
            }
            Binary::AddInteger => self.on_bits([a, b], |cursor, a, b| cursor.ins().iadd(a, b)),
            Binary::SubInteger => self.on_bits([a, b], |cursor, a, b| cursor.ins().isub(a, b)),
            Binary::GreaterInteger => return Err("signs are spread instead".to_owned()),
        })
    }
}
