//! The code of a function: its lists one after the other.

use iced_x86::IcedError;
use robot_codegen::module::Function;
use robot_codegen::program::{Operation, Source};

use super::encoder::Bytes;
use super::{Addressing, Shape, registers};
use crate::list::{Angles, Home, List, Missing, Pool, Target, Writer, lower, sines};
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

/// The entries of all outputs, as the results of the arithmetic.
fn outputs(function: &Function) -> Vec<(usize, Target)> {
    let results = function.core.results().iter().enumerate();
    results.map(|(index, value)| (value.index(), Target::Output(index as u32))).collect()
}

/// Code for states side by side, in columns, as many as a register has numbers, until all are done.
pub(crate) fn emit_lanes(
    function: &Function,
    fields: &[f64],
    registers: Registers,
) -> Result<LanesEntry, Fault> {
    let shape = Shape { registers, lanes: registers.lanes() };
    let mut pool = Pool::default();
    let mut writer = Writer::new(&mut pool, registers);
    let angles = Angles::Here(&function.angles);
    lower(&mut writer, function, &function.core, fields, angles, &outputs(function))?;
    let list = writer.list;
    let mut bytes = Bytes::new(shape, Addressing::Columns, 0);
    let slots = registers::emit(&list, &mut bytes) as usize;
    bytes.repeat();
    bytes.end();
    Ok(LanesEntry(Entry {
        code: bytes.finish()?,
        pool: pool.spread(Bytes::constant_numbers(shape)),
        working: slots * shape.lanes,
        inputs: inputs(function),
        outputs: function.core.results().len(),
        registers,
    }))
}

/// The widest register, in numbers, to which parts of the working memory are padded.
const WIDEST: usize = 8;

/// How the sines of one state are computed: side by side, angles from the inputs or the working memory.
struct Plan {
    lanes: usize,
    /// For each register full of angles where they are.
    chunks: Vec<Home>,
}

impl Plan {
    /// A plan, if there is more than one angle.
    fn new(function: &Function) -> Option<Plan> {
        let angles = function.angles.results();
        if angles.len() < 2 {
            return None;
        }
        // Registers of 512 bits took longer: UR5's inverse dynamics 81 ns in place of 44 on a Xeon with AVX-512.
        let lanes = Registers::Avx2.lanes();
        let inputs = inputs(function);
        let input = |index: usize| match function.angles.operation(*angles.get(index)?) {
            Operation::Load(Source::Input(entry)) => Some(entry as usize),
            _ => None,
        };
        let chunks = (0..angles.len()).step_by(lanes).map(|start| {
            let end = angles.len().min(start + lanes);
            let plain = input(start).filter(|first| {
                // The entries behind the last angle are read too.
                first + lanes <= inputs
                    && (start..end).all(|index| input(index) == Some(first + index - start))
            });
            match plain {
                Some(first) => Home::Input(first as u32),
                None => Home::Working(start as u32),
            }
        });
        Some(Plan { lanes, chunks: chunks.collect() })
    }
}

/// Code for one state.
pub(crate) fn emit_single(
    function: &Function,
    fields: &[f64],
    registers: Registers,
) -> Result<SingleEntry, Fault> {
    let scalar = Shape { registers, lanes: 1 };
    let count = function.angles.results().len().next_multiple_of(WIDEST) as u32;
    let plan = Plan::new(function);
    // Constants of lists for one number, and of those for several.
    let (mut single, mut wide) = (Pool::default(), Pool::default());
    // Angles, sines and cosines lie in the working memory before the registers put aside.
    let mut bytes = Bytes::new(scalar, Addressing::Row, if plan.is_some() { 3 * count } else { 0 });
    let mut lists: Vec<(Shape, List)> = vec![];
    let mut angles = Angles::Here(&function.angles);
    if let Some(plan) = &plan {
        if plan.chunks.iter().any(|home| matches!(home, Home::Working(_))) {
            let mut writer = Writer::new(&mut single, registers);
            let results = padded_angles(function, count);
            lower(&mut writer, function, &function.angles, fields, Angles::None, &results)?;
            lists.push((scalar, writer.list));
        }
        let mut writer = Writer::new(&mut wide, registers);
        for (index, chunk) in plan.chunks.iter().enumerate() {
            let start = (index * plan.lanes) as u32;
            sines(&mut writer, *chunk, count + start, 2 * count + start);
        }
        lists.push((Shape { registers, lanes: plan.lanes }, writer.list));
        angles = Angles::Working { sines: count, cosines: 2 * count };
    }
    let mut writer = Writer::new(&mut single, registers);
    lower(&mut writer, function, &function.core, fields, angles, &outputs(function))?;
    lists.push((scalar, writer.list));
    let mut constants = single.spread(Bytes::constant_numbers(scalar));
    let first_wide = constants.len();
    if let Some(plan) = &plan {
        let shape = Shape { registers, lanes: plan.lanes };
        constants.extend(wide.spread(Bytes::constant_numbers(shape)));
    }
    let mut working = bytes.spills as usize;
    for (shape, list) in &lists {
        bytes.shape = *shape;
        bytes.constants = if shape.lanes == 1 { 0 } else { first_wide };
        let slots = registers::emit(list, &mut bytes) as usize;
        working = working.max(bytes.spills as usize + slots * shape.lanes);
    }
    bytes.end();
    Ok(SingleEntry(Entry {
        code: bytes.finish()?,
        pool: constants,
        working,
        inputs: inputs(function),
        outputs: function.core.results().len(),
        registers,
    }))
}

/// The angles and, in the rest of the last register, the last again: numbers of the right size.
fn padded_angles(function: &Function, count: u32) -> Vec<(usize, Target)> {
    let angles = function.angles.results();
    let last = angles.len().saturating_sub(1);
    let each = (0..count).filter_map(|index| {
        let value = angles.get(last.min(index as usize))?;
        Some((value.index(), Target::Working(index)))
    });
    each.collect()
}
