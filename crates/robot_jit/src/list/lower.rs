//! Lists from programs.

use robot_codegen::module::Function;
use robot_codegen::program::{Operation, Program, Source};
use robot_symbolic::Function as Call;
use rustc_hash::FxHashMap;

use super::{Binary, Home, Id, Instruction, Target, Writer};

/// Where sines and cosines of the angles of a function come from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Angles<'p> {
    /// They are computed before they are first used, from what this program gives.
    Here(&'p Program),
    /// They are in the working memory: sines from one number on, cosines from another.
    Working { sines: u32, cosines: u32 },
    /// The program has none.
    None,
}

/// Something that a program loads and does not exist.
#[derive(Debug)]
pub(crate) struct Missing;

struct Lowering<'w, 'p, 'f> {
    writer: &'w mut Writer<'p>,
    function: &'f Function,
    fields: &'f [f64],
    angles: Angles<'f>,
    /// The values of the program of angles.
    angle_values: Vec<Id>,
    /// Sines and cosines of angles by their index.
    pairs: Vec<Option<(Id, Id)>>,
    /// Sines and cosines of other values.
    calls: FxHashMap<Id, (Id, Id)>,
}

/// Appends a program; `results` has positions of its values and where these go.
pub(crate) fn lower(
    writer: &mut Writer<'_>,
    function: &Function,
    program: &Program,
    fields: &[f64],
    angles: Angles<'_>,
    results: &[(usize, Target)],
) -> Result<(), Missing> {
    let mut lowering = Lowering {
        writer,
        function,
        fields,
        angles,
        angle_values: vec![],
        pairs: vec![None; function.angles.results().len()],
        calls: FxHashMap::default(),
    };
    if let Angles::Here(angles) = angles {
        lowering.angle_values = lowering.values(angles, |_, _, _| {})?;
    }
    let mut results = results.to_vec();
    results.sort_by_key(|(position, _)| *position);
    let mut results = results.into_iter().peekable();
    // Stored as soon as they are known.
    lowering.values(program, |writer, position, value| {
        while let Some((_, target)) = results.next_if(|(result, _)| *result == position) {
            writer.list.store(value, target);
        }
    })?;
    Ok(())
}

/// Appends sines and cosines of so many lanes from a place on, and stores them.
pub(crate) fn sines(writer: &mut Writer<'_>, angle: Home, sine: u32, cosine: u32) {
    let angle = writer.list.home(angle);
    let (sine_value, cosine_value) = writer.sin_cos(angle);
    writer.list.store(sine_value, Target::Working(sine));
    writer.list.store(cosine_value, Target::Working(cosine));
}

impl Lowering<'_, '_, '_> {
    /// The values of a program; `then` is called after each with its position.
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
                self.writer.list.value(Instruction::MulAdd(at(a), at(b), at(c)))
            }
            Operation::Call(Call::Sin, a) => self.pair(at(a)).0,
            Operation::Call(Call::Cos, a) => self.pair(at(a)).1,
            Operation::Call(function, a) => self.writer.call(function, at(a)),
        })
    }

    fn load(&mut self, source: Source) -> Result<Id, Missing> {
        let inputs = || self.function.inputs.iter().map(|input| input.symbols.len()).sum::<usize>();
        Ok(match source {
            // The interpreter gives the same: functions load fields.
            Source::Parameter(_) => self.writer.number(f64::NAN),
            Source::Field(index) => {
                let value = *self.fields.get(index as usize).ok_or(Missing)?;
                self.writer.number(value)
            }
            Source::Input(index) if (index as usize) < inputs() => {
                self.writer.list.home(Home::Input(index))
            }
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

    /// Sine and cosine of an angle of the function.
    fn angle(&mut self, index: u32) -> Result<(Id, Id), Missing> {
        let known = self.pairs.get(index as usize).ok_or(Missing)?;
        if let Some(pair) = known {
            return Ok(*pair);
        }
        let pair = match self.angles {
            Angles::None => return Err(Missing),
            Angles::Working { sines, cosines } => {
                let list = &mut self.writer.list;
                let sine = list.home(Home::Working(sines + index));
                (sine, list.home(Home::Working(cosines + index)))
            }
            Angles::Here(program) => {
                let value = program.results().get(index as usize).ok_or(Missing)?;
                let angle = *self.angle_values.get(value.index()).ok_or(Missing)?;
                self.pair(angle)
            }
        };
        self.pairs[index as usize] = Some(pair);
        Ok(pair)
    }
}
