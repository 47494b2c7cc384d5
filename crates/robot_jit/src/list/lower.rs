//! Translation of programs to lists.

use robot_codegen::module::Function;
use robot_codegen::program::{Operation, Program, Source};
use robot_symbolic::Function as Call;
use rustc_hash::{FxHashMap, FxHashSet};

use super::{Binary, Home, Id, Instruction, WIDE, Writer};

/// The way in which the sines and cosines of a function's angles are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sines {
    /// Each by itself, before it is first used.
    Single,
    /// At the start, several at a time in wide values.
    SideBySide,
}

/// The program loads a value that does not exist.
#[derive(Debug)]
pub(crate) struct Missing;

struct Lowering<'w, 'p, 'f> {
    writer: &'w mut Writer<'p>,
    function: &'f Function,
    fields: &'f [f64],
    /// The angles of the function.
    angles: Vec<Id>,
    /// Sines and cosines of angles by their index.
    pairs: Vec<Option<(Id, Id)>>,
    /// Sines and cosines of other values.
    calls: FxHashMap<Id, (Id, Id)>,
}

/// Appends the steps of a function.
pub(crate) fn lower(
    writer: &mut Writer<'_>,
    function: &Function,
    fields: &[f64],
    sines: Sines,
) -> Result<(), Missing> {
    let angles = function.angles.results();
    let pairs = vec![None; angles.len()];
    let calls = FxHashMap::default();
    let mut lowering = Lowering { writer, function, fields, angles: vec![], pairs, calls };
    let values = lowering.values(&function.angles, |_, _, _| {})?;
    lowering.angles = angles.iter().map(|angle| values[angle.index()]).collect();
    if sines == Sines::SideBySide && angles.len() > 1 {
        let inputs = lowering.inputs();
        let pairs = lowering.writer.side_by_side(&lowering.angles, inputs);
        lowering.pairs = pairs.into_iter().map(Some).collect();
    }
    let mut results: Vec<(usize, u32)> = match sines {
        Sines::Single => lowering.results(&[]),
        Sines::SideBySide => {
            let rows = lowering.constant_rows();
            rows.iter().for_each(|(entry, row)| lowering.writer.store_row(*entry, *row));
            lowering.results(&rows)
        }
    };
    results.sort_unstable();
    let mut results = results.into_iter().peekable();
    // Results are stored as soon as they are known.
    lowering.values(&function.core, |writer, position, value| {
        while let Some((_, entry)) = results.next_if(|(result, _)| *result == position) {
            writer.store(value, entry);
        }
    })?;
    Ok(())
}

impl Lowering<'_, '_, '_> {
    /// Finds rows of neighboring outputs that are constants; each has the index of its first entry.
    fn constant_rows(&self) -> Vec<(u32, [u64; WIDE])> {
        let results = self.function.core.results().iter();
        let bits: Vec<Option<u64>> = results
            .map(|value| match self.function.core.operation(*value) {
                Operation::Constant(constant) => Some(constant.get().to_bits()),
                Operation::Load(Source::Field(index)) => {
                    self.fields.get(index as usize).map(|field| field.to_bits())
                }
                _ => None,
            })
            .collect();
        let mut rows = vec![];
        let mut start = 0;
        for run in bits.chunk_by(|a, b| a.is_some() == b.is_some()) {
            let end = start + run.len();
            if run[0].is_some() && run.len() >= WIDE {
                // The last row overlaps with the one before it.
                let firsts = (start..end).step_by(WIDE).map(|first| first.min(end - WIDE));
                rows.extend(firsts.map(|first| {
                    let row = std::array::from_fn(|lane| bits[first + lane].unwrap_or_default());
                    (first as u32, row)
                }));
            }
            start = end;
        }
        rows
    }

    /// The positions of results with the entries of the outputs that they are, except entries in rows.
    fn results(&self, rows: &[(u32, [u64; WIDE])]) -> Vec<(usize, u32)> {
        let of_rows: FxHashSet<u32> =
            rows.iter().flat_map(|(entry, _)| *entry..entry + WIDE as u32).collect();
        let results = self.function.core.results().iter().zip(0..);
        let results = results.filter(|(_, entry)| !of_rows.contains(entry));
        results.map(|(value, entry)| (value.index(), entry)).collect()
    }

    /// Appends the values of a program; `then` is called after each with its position.
    fn values(
        &mut self,
        program: &Program,
        mut then: impl FnMut(&mut Writer<'_>, usize, Id),
    ) -> Result<Vec<Id>, Missing> {
        let mut values: Vec<Id> = Vec::with_capacity(program.operations().len());
        for (position, operation) in program.operations().iter().enumerate() {
            let value = self.operation(*operation, &values)?;
            then(self.writer, position, value);
            values.push(value);
        }
        Ok(values)
    }

    fn operation(&mut self, operation: Operation, values: &[Id]) -> Result<Id, Missing> {
        let at = |value: robot_codegen::program::Value| values[value.index()];
        Ok(match operation {
            Operation::Constant(constant) => self.writer.number(constant.get()),
            Operation::Load(source) => self.load(source)?,
            Operation::Add(a, b) => self.writer.binary(Binary::Add, at(a), at(b)),
            Operation::Sub(a, b) => self.writer.binary(Binary::Sub, at(a), at(b)),
            Operation::Mul(a, b) => self.writer.binary(Binary::Mul, at(a), at(b)),
            Operation::Div(a, b) => self.writer.binary(Binary::Div, at(a), at(b)),
            Operation::Neg(a) => self.writer.neg(at(a)),
            Operation::MulAdd(a, b, c) => {
                self.writer.value(Instruction::MulAdd(at(a), at(b), at(c)))
            }
            Operation::Call(Call::Sin, a) => self.pair(at(a)).0,
            Operation::Call(Call::Cos, a) => self.pair(at(a)).1,
            Operation::Call(function, a) => self.writer.call(function, at(a)),
        })
    }

    /// The number of entries of all inputs.
    fn inputs(&self) -> u32 {
        self.function.inputs.iter().map(|input| input.symbols.len() as u32).sum()
    }

    fn load(&mut self, source: Source) -> Result<Id, Missing> {
        Ok(match source {
            // Does not occur, because functions load fields instead; the interpreter also returns NaN.
            Source::Parameter(_) => self.writer.number(f64::NAN),
            Source::Field(index) => {
                let value = *self.fields.get(index as usize).ok_or(Missing)?;
                self.writer.number(value)
            }
            Source::Input(index) if index < self.inputs() => self.writer.home(Home::Input(index)),
            Source::Input(_) => return Err(Missing),
            Source::Sin(index) => self.angle(index)?.0,
            Source::Cos(index) => self.angle(index)?.1,
        })
    }

    fn pair(&mut self, argument: Id) -> (Id, Id) {
        if let Some(pair) = self.calls.get(&argument) {
            return *pair;
        }
        let pair = self.writer.sin_cos(argument);
        self.calls.insert(argument, pair);
        pair
    }

    /// Returns the sine and cosine of an angle of the function.
    fn angle(&mut self, index: u32) -> Result<(Id, Id), Missing> {
        let known = self.pairs.get(index as usize).ok_or(Missing)?;
        if let Some(pair) = known {
            return Ok(*pair);
        }
        let angle = *self.angles.get(index as usize).ok_or(Missing)?;
        let pair = self.pair(angle);
        self.pairs[index as usize] = Some(pair);
        Ok(pair)
    }
}
