//! The code of a function: its lists one after the other.

use iced_x86::IcedError;
use robot_codegen::module::Function;

use super::encoder::Bytes;
use super::{Addressing, Shape, Target, registers};
use crate::list::{List, Missing, Model, Pool, Sines, Writer, lower};
use crate::processor::Registers;

/// Code with what it needs of memory.
#[derive(Debug)]
pub(crate) struct Entry {
    pub(crate) code: Vec<u8>,
    /// What the pointer to the constants points to.
    pub(crate) pool: Vec<u64>,
    /// The numbers of the working memory.
    pub(crate) working: usize,
    /// The entries of all inputs: the code reads no others.
    pub(crate) inputs: usize,
    /// The entries of all outputs: the code writes no others.
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

/// Why there is no code.
#[derive(Debug)]
pub(crate) enum Fault {
    Missing,
    Encoding(IcedError),
}

impl From<Missing> for Fault {
    fn from(_: Missing) -> Fault {
        Fault::Missing
    }
}

impl From<IcedError> for Fault {
    fn from(error: IcedError) -> Fault {
        Fault::Encoding(error)
    }
}

/// Code for states side by side, in columns, as many as a register has numbers, until all are done.
pub(crate) fn emit_lanes(
    function: &Function,
    fields: &[f64],
    target: Target,
) -> Result<LanesEntry, Fault> {
    let shape = Shape { registers: target.registers, lanes: target.registers.lanes() };
    let entry = emit(function, fields, target, (shape, Addressing::Columns), Sines::Single)?;
    Ok(LanesEntry(entry))
}

/// Code for one state.
pub(crate) fn emit_single(
    function: &Function,
    fields: &[f64],
    target: Target,
) -> Result<SingleEntry, Fault> {
    let shape = Shape { registers: target.registers, lanes: 1 };
    let entry = emit(function, fields, target, (shape, Addressing::Row), Sines::SideBySide)?;
    Ok(SingleEntry(entry))
}

/// Steps from which on displacements are long.
const LONG: usize = 1000;

/// The bytes of code from which on it takes the time to fetch it: then an order that puts fewer registers aside is
/// faster than one that waits less. Panda's derivatives of forward dynamics took 530 ns in place of 640.
const CACHED: usize = 24 << 10;

fn emit(
    function: &Function,
    fields: &[f64],
    target: Target,
    (shape, addressing): (Shape, Addressing),
    sines: Sines,
) -> Result<Entry, Fault> {
    let mut pool = Pool::default();
    let mut writer = Writer::new(&mut pool, target.registers, target.fused);
    lower(&mut writer, function, fields, sines)?;
    // Of 32 registers 24, of 16 twelve: a few are left for operands from memory.
    let registers = target.registers.count() / 4 * 3;
    let overlap = if addressing == Addressing::Row { 3 } else { 4 };
    let scheduled = writer.list.scheduled(Model { registers, overlap });
    let (mut code, mut working) = encode(&scheduled, &pool, shape, addressing)?;
    if code.len() > CACHED {
        (code, working) = encode(&scheduled.depth_first(), &pool, shape, addressing)?;
    }
    Ok(Entry {
        code,
        pool: pool.spread(Bytes::constant_numbers(shape)),
        working: working as usize,
        inputs: inputs(function),
        outputs: function.core.results().len(),
        registers: target.registers,
    })
}

/// The code of a list, and the numbers of working memory that it uses.
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
