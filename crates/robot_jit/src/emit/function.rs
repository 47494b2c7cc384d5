//! The code of a function, made from its list.

use iced_x86::IcedError;
use robot_codegen::module::Function;

use super::encoder::Bytes;
use super::{Addressing, Shape, Target, Vectors, registers};
use crate::cranelift;
use crate::list::{List, Missing, Model, Pool, Sines, Writer, lower};
use crate::processor::Registers;

/// The code of a function, with the sizes of the memory that it uses.
#[derive(Debug)]
pub(crate) struct Entry {
    pub(crate) code: Vec<u8>,
    /// The constants, to which the code gets a pointer.
    pub(crate) pool: Vec<u64>,
    /// The size of the working memory, in numbers.
    pub(crate) working: usize,
    /// The number of entries of all inputs; the code reads no others.
    pub(crate) inputs: usize,
    /// The number of entries of all outputs; the code writes no others.
    pub(crate) outputs: usize,
    /// The registers that the machine must have.
    pub(crate) registers: Registers,
}

/// Code for one state: `fn(inputs, outputs, constants, working)`.
#[derive(Debug)]
pub(crate) struct SingleEntry(pub(crate) Entry);

/// Code for several states: `fn(columns of inputs, columns of outputs, constants, working, first state, end)`.
#[derive(Debug)]
pub(crate) struct LanesEntry(pub(crate) Entry);

/// The number of entries of all inputs.
fn inputs(function: &Function) -> usize {
    function.inputs.iter().map(|input| input.symbols.len()).sum()
}

/// A reason why there is no code.
#[derive(Debug)]
pub(crate) enum Fault {
    Missing,
    /// The message of the encoder.
    Encoding(String),
    /// The code of the function would take this many bytes of the stack, which is too many.
    Stack(u32),
}

impl From<Missing> for Fault {
    fn from(_: Missing) -> Fault {
        Fault::Missing
    }
}

impl From<IcedError> for Fault {
    fn from(error: IcedError) -> Fault {
        Fault::Encoding(error.to_string())
    }
}

/// Makes code for states in columns; it loops over them, as many at a time as a register has lanes.
pub(crate) fn emit_lanes(
    function: &Function,
    fields: &[f64],
    target: Target,
) -> Result<LanesEntry, Fault> {
    emit(function, fields, target, Addressing::Columns).map(LanesEntry)
}

/// Makes code for one state.
pub(crate) fn emit_single(
    function: &Function,
    fields: &[f64],
    target: Target,
) -> Result<SingleEntry, Fault> {
    emit(function, fields, target, Addressing::Row).map(SingleEntry)
}

/// The most stack that code may use, in bytes; threads that the standard library spawns have 2 MiB by default.
const MOST_STACK: u32 = 256 << 10;

/// The number of steps above which code advances its pointers, because displacements are long.
const LONG: usize = 1000;

/// The size of code, in bytes, above which its time is that of fetching it. An order that spills fewer registers is
/// then faster than one that waits less: the Panda's derivatives of forward dynamics took 530 ns instead of 640 ns.
const CACHED: usize = 24 << 10;

fn emit(
    function: &Function,
    fields: &[f64],
    target: Target,
    addressing: Addressing,
) -> Result<Entry, Fault> {
    let mut pool = Pool::default();
    let mut writer = Writer::new(&mut pool, target.registers, target.fused);
    let lanes = match addressing {
        Addressing::Row => 1,
        Addressing::Columns => target.registers.lanes(),
    };
    let vectors = Vectors::of(target.registers);
    let sines = match (vectors, addressing) {
        (Some(_), Addressing::Row) => Sines::SideBySide,
        _ => Sines::Single,
    };
    lower(&mut writer, function, fields, sines)?;
    let list = writer.list;
    let (code, working, numbers) = match vectors {
        Some(vectors) => {
            let shape = Shape { vectors, lanes };
            let (code, working) = ordered(&list, &pool, shape, addressing)?;
            (code, working, Bytes::constant_numbers(shape))
        }
        None => {
            let (code, stack) = cranelift::encode(&list.depth_first(), lanes, addressing)?;
            if stack > MOST_STACK {
                return Err(Fault::Stack(stack));
            }
            (code, 0, 1)
        }
    };
    Ok(Entry {
        code,
        pool: pool.spread(numbers),
        working: working as usize,
        inputs: inputs(function),
        outputs: function.core.results().len(),
        registers: target.registers,
    })
}

/// Reorders a list and encodes it; returns the code and the size of its working memory, in numbers.
fn ordered(
    list: &List,
    pool: &Pool,
    shape: Shape,
    addressing: Addressing,
) -> Result<(Vec<u8>, u32), IcedError> {
    // 24 of 32 registers, or 12 of 16: a few are left for operands from memory.
    let registers = shape.vectors.count() / 4 * 3;
    let overlap = if addressing == Addressing::Row { 3 } else { 4 };
    let scheduled = list.scheduled(Model { registers, overlap });
    let found = encode(&scheduled, pool, shape, addressing)?;
    if found.0.len() > CACHED {
        return encode(&scheduled.depth_first(), pool, shape, addressing);
    }
    Ok(found)
}

/// Encodes a list; returns the code and the size of its working memory, in numbers.
fn encode(
    list: &List,
    pool: &Pool,
    shape: Shape,
    addressing: Addressing,
) -> Result<(Vec<u8>, u32), IcedError> {
    let rows = pool.count() * Bytes::constant_numbers(shape);
    let mut bytes = Bytes::new(shape, addressing, rows);
    if list.steps.len() > LONG {
        bytes.extend_reach();
    }
    let working = registers::emit(list, &mut bytes);
    if addressing == Addressing::Columns {
        bytes.repeat();
    }
    bytes.end();
    Ok((bytes.finish()?, working))
}
