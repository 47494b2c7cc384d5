//! Functions of robots with limbs that are alike: one program computes several limbs, one in each lane.
//!
//! The limbs of a robot are attached to a base at rest and are not coupled, so each result of a function is a result of
//! one limb, or 0. Limbs that are alike differ only in numbers, which the program of the limb loads as fields.

use rustc_hash::FxHashMap;

use crate::interpreter::evaluate;
use crate::module::{Function, Module};
use crate::program::{Builder, Operation, Program, Source, Value};
use crate::trigonometry::Trigonometry;

/// The most lanes of a call; more limbs of a kind need several calls.
const MAX_LANES: usize = 8;
/// The number of lanes for which a call was measured to be faster than separate code for each limb. With two or eight
/// lanes it was not.
const MEASURED_LANES: usize = 4;
/// The most operations of one limb's function, because rustc takes minutes to compile a few thousand over lanes.
const MAX_OPERATIONS: usize = 600;

/// A kind of limb: the module of a single limb, and the limbs of this kind.
#[derive(Clone, Debug)]
pub struct LimbKind {
    /// The functions of a single limb. Its parameters are the numbers in which the limbs differ.
    pub module: Module,
    /// For each limb, the indices of its coordinates among those of the robot, in the order of the limb's coordinates.
    pub coordinates: Vec<Vec<usize>>,
    /// For each limb, the values of the module's parameters.
    pub values: Vec<Vec<f64>>,
}

/// A function that is computed limb by limb.
#[derive(Clone, Debug, PartialEq)]
pub struct Limbs {
    /// The calls that compute it.
    pub calls: Vec<LimbCall>,
    /// For each result of the function, the limb's result that it equals; `None` if it is 0.
    pub results: Vec<Option<LimbResult>>,
}

/// A call of the function of a limb, for several limbs, one in each lane.
#[derive(Clone, Debug, PartialEq)]
pub struct LimbCall {
    /// The function of a single limb; its fields are those of `fields`.
    pub function: Function,
    /// For each field, its value in each lane. Empty if there is only one lane.
    pub fields: Vec<Vec<f64>>,
    /// For each lane, the index among the robot's inputs of each entry of the limb's inputs.
    pub inputs: Vec<Vec<usize>>,
}

/// The place of a result: a call, a lane and a result of the limb's function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LimbResult {
    /// The index of the call.
    pub call: usize,
    /// The index of the lane.
    pub lane: usize,
    /// The index of the result of the limb's function.
    pub result: usize,
}

impl LimbCall {
    /// The number of lanes, a power of two; lanes without a limb of their own repeat a limb.
    #[must_use]
    pub fn lanes(&self) -> usize {
        self.inputs.len()
    }
}

impl Module {
    /// Adds programs of limbs to the functions with these names, where possible: all inputs of the function and all
    /// dimensions of its outputs must be as long as the robot has coordinates. A function keeps its ordinary program
    /// alone if a call would have a number of lanes that is not known to be faster, or a program that is too long.
    pub fn set_limbs(&mut self, kinds: &[LimbKind], names: &[String], trigonometry: Trigonometry) {
        let coordinates = kinds.iter().flat_map(|kind| &kind.coordinates).map(Vec::len).sum();
        for function in &mut self.functions {
            if names.contains(&function.name) {
                function.limbs = limbs(function, kinds, coordinates, trigonometry);
            }
        }
    }
}

/// Returns the function as its limbs compute it, if that is possible and worthwhile.
fn limbs(
    function: &Function,
    kinds: &[LimbKind],
    coordinates: usize,
    trigonometry: Trigonometry,
) -> Option<Limbs> {
    let sides = function.outputs.iter().flat_map(|output| &output.shape);
    let lengths = function.inputs.iter().map(|input| input.symbols.len());
    if function.outputs.iter().any(|output| output.shape.is_empty())
        || sides.copied().chain(lengths).any(|length| length != coordinates)
    {
        return None;
    }
    let mut limbs = Limbs { calls: vec![], results: vec![None; function.core.results().len()] };
    for kind in kinds {
        let alone = kind.module.function(&function.name)?;
        let numbered: Vec<usize> = (0..kind.coordinates.len()).collect();
        for chunk in numbered.chunks(MAX_LANES) {
            let call = limb_call(function, kind, alone, chunk, trigonometry);
            for (lane, limb) in chunk.iter().enumerate() {
                place(&mut limbs, function, &kind.coordinates[*limb], lane);
            }
            limbs.calls.push(call);
        }
    }
    limbs.calls.iter().all(is_worth_it).then_some(limbs)
}

/// Whether a call has a single lane, or a number of lanes that is known to be faster and a program that compiles
/// quickly.
fn is_worth_it(call: &LimbCall) -> bool {
    let operations = call.function.core.operations().len();
    call.lanes() == 1 || call.lanes() == MEASURED_LANES && operations <= MAX_OPERATIONS
}

/// Records which results of the function come from a limb, which has a lane of the next call.
fn place(limbs: &mut Limbs, function: &Function, coordinates: &[usize], lane: usize) {
    let call = limbs.calls.len();
    let (mut first, mut result) = (0, 0);
    for output in &function.outputs {
        let side = output.shape[0];
        let mut set = |entry: usize| {
            limbs.results[first + entry] = Some(LimbResult { call, lane, result });
            result += 1;
        };
        for row in coordinates {
            match output.shape.len() {
                1 => set(*row),
                _ => coordinates.iter().for_each(|column| set(row * side + column)),
            }
        }
        first += output.len();
    }
}

/// Makes the call for some limbs of a kind.
fn limb_call(
    function: &Function,
    kind: &LimbKind,
    alone: &Function,
    chunk: &[usize],
    trigonometry: Trigonometry,
) -> LimbCall {
    let lanes = chunk.len().next_power_of_two();
    let last = chunk.iter().rev().cycle();
    let padded: Vec<usize> = chunk.iter().chain(last.take(lanes - chunk.len())).copied().collect();
    let fields_of = |limb: &usize| {
        let values = &kind.values[*limb];
        evaluate(&kind.module.constructor, trigonometry, |source| match source {
            Source::Parameter(index) => values[index as usize],
            _ => f64::NAN,
        })
    };
    let of_lanes: Vec<Vec<f64>> = padded.iter().map(fields_of).collect();
    let mut fields = Fields::default();
    let alone = Function {
        angles: fields.fold_common_fields(&alone.angles, &of_lanes),
        core: fields.fold_common_fields(&alone.core, &of_lanes),
        ..alone.clone()
    };
    let entries = |limb: &usize| {
        let coordinates = &kind.coordinates[*limb];
        let starts = function.inputs.iter().scan(0, |start, input| {
            let this = *start;
            *start += input.symbols.len();
            Some(this)
        });
        starts.flat_map(|start| coordinates.iter().map(move |index| start + index)).collect()
    };
    LimbCall {
        function: alone,
        fields: fields.numbers,
        inputs: padded.iter().map(entries).collect(),
    }
}

/// The fields that differ between lanes.
#[derive(Default)]
struct Fields {
    numbers: Vec<Vec<f64>>,
    index: FxHashMap<u32, u32>,
}

impl Fields {
    /// Replaces the fields that are the same in all lanes with constants.
    fn fold_common_fields(&mut self, program: &Program, of_lanes: &[Vec<f64>]) -> Program {
        let mut builder = Builder::new();
        let mut values: Vec<Value> = Vec::with_capacity(program.operations().len());
        for (_, operation) in program.values() {
            let value = match operation {
                Operation::Load(Source::Field(field)) => self.load(field, of_lanes, &mut builder),
                _ => builder.apply(operation.map(|operand| values[operand.index()])),
            };
            values.push(value);
        }
        builder.finish(program.results().iter().map(|value| values[value.index()]).collect())
    }

    fn load(&mut self, field: u32, of_lanes: &[Vec<f64>], builder: &mut Builder) -> Value {
        let numbers: Vec<f64> = of_lanes.iter().map(|fields| fields[field as usize]).collect();
        if numbers.iter().all(|number| *number == numbers[0]) {
            return builder.constant(numbers[0]);
        }
        let next = self.numbers.len() as u32;
        let index = *self.index.entry(field).or_insert(next);
        if index == next {
            self.numbers.push(numbers);
        }
        builder.load(Source::Field(index))
    }
}
