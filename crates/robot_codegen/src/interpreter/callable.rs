//! A function of a module whose parameters are given.

use super::evaluation::{evaluate_block, sin_cos};
use super::{OutputValues, names};
use crate::error::{Error, Errors};
use crate::module::{Function, Output};
use crate::program::{Program, Source};
use crate::spec::Input;
use crate::trigonometry::Trigonometry;

/// The number of states in a block. It is large enough that decoding an operation takes little time per state, and
/// small enough that the values of a program stay in the cache.
const BLOCK: usize = 16;

/// The rows of an input, one for each state, and the index of an entry in each row.
pub type Place<'v> = (&'v [Vec<f64>], usize);

/// A function of a module whose parameters are given. It is looked up once and can be called many times.
#[derive(Clone, Copy, Debug)]
pub struct Callable<'i> {
    function: &'i Function,
    fields: &'i [f64],
    trigonometry: Trigonometry,
}

/// The values of a function's programs at a block of states.
struct Block<const STATES: usize> {
    values: Vec<[f64; STATES]>,
    /// The sines and cosines of the angles.
    circular: Vec<[[f64; STATES]; 2]>,
}

impl<const STATES: usize> Block<STATES> {
    fn new(function: &Function) -> Block<STATES> {
        let values = function.core.operations().len().max(function.angles.operations().len());
        Block {
            values: Vec::with_capacity(values),
            circular: Vec::with_capacity(function.angles.results().len()),
        }
    }
}

impl<'i> Callable<'i> {
    pub(super) fn new(
        function: &'i Function,
        fields: &'i [f64],
        trigonometry: Trigonometry,
    ) -> Callable<'i> {
        Callable { function, fields, trigonometry }
    }

    /// The name.
    #[must_use]
    pub fn name(self) -> &'i str {
        &self.function.name
    }

    /// The inputs.
    #[must_use]
    pub fn inputs(self) -> &'i [Input] {
        &self.function.inputs
    }

    /// The outputs.
    #[must_use]
    pub fn outputs(self) -> &'i [Output] {
        &self.function.outputs
    }

    /// The number of entries of all inputs.
    #[must_use]
    pub fn input_size(self) -> usize {
        self.inputs().iter().map(|input| input.symbols.len()).sum()
    }

    /// The number of entries of all outputs.
    #[must_use]
    pub fn output_size(self) -> usize {
        self.function.core.results().len()
    }

    pub(super) fn core(self) -> &'i Program {
        &self.function.core
    }

    /// Computes the entries of all outputs at one state; the inputs are given by name.
    ///
    /// # Errors
    ///
    /// Inputs that are missing, unknown or of the wrong length.
    pub fn call(self, inputs: &[(&str, &[f64])]) -> Result<Vec<f64>, Errors> {
        let entries = self.gather(inputs)?;
        let mut found = vec![0.0; self.output_size()];
        self.entries(&entries, &mut found)?;
        Ok(found)
    }

    /// Computes one state. `inputs` has the entries of all inputs, in their order; `outputs` receives those of all
    /// outputs.
    ///
    /// # Errors
    ///
    /// The number of entries is wrong.
    pub fn entries(self, inputs: &[f64], outputs: &mut [f64]) -> Result<(), Errors> {
        self.check_columns(inputs.len(), outputs.len())?;
        self.blocks::<1>(1, |entry, _| inputs[entry], |entry, _, value| outputs[entry] = value);
        Ok(())
    }

    /// Splits the values returned by [`Callable::call`] into outputs with their names and shapes.
    #[must_use]
    pub fn named(self, values: Vec<f64>) -> Vec<OutputValues> {
        let mut values = values.into_iter();
        let outputs = self.outputs().iter().map(|output| OutputValues {
            name: output.name.clone(),
            shape: output.shape.clone(),
            values: values.by_ref().take(output.len()).collect(),
        });
        outputs.collect()
    }

    /// Computes many states. `inputs` has a column for each entry of the inputs, in their order, and `outputs` has one
    /// for each entry of the outputs; row i of every column belongs to state i. Memory is not allocated for each state.
    ///
    /// # Errors
    ///
    /// The number of columns differs from the number of entries, or the columns have different lengths.
    pub fn columns(self, inputs: &[&[f64]], outputs: &mut [&mut [f64]]) -> Result<(), Errors> {
        let states = self.check_lengths(inputs, outputs)?;
        let read = |entry: usize, state: usize| inputs[entry][state];
        self.blocks::<BLOCK>(states, read, |entry, state, value| outputs[entry][state] = value);
        Ok(())
    }

    /// Returns the number of states, if the columns are valid arguments of [`Callable::columns`].
    ///
    /// # Errors
    ///
    /// Those of [`Callable::columns`].
    pub fn check_lengths(self, inputs: &[&[f64]], outputs: &[&mut [f64]]) -> Result<usize, Errors> {
        let mut errors = match self.check_columns(inputs.len(), outputs.len()) {
            Ok(()) => vec![],
            Err(errors) => errors.as_slice().to_vec(),
        };
        let lengths = || {
            let inputs = inputs.iter().map(|column| column.len());
            inputs.chain(outputs.iter().map(|column| column.len()))
        };
        let states = lengths().next().unwrap_or_default();
        if let Some(found) = lengths().find(|length| *length != states) {
            let function = self.function.name.clone();
            errors.push(Error::States { function, expected: states, found });
        }
        Errors::check(errors, states)
    }

    /// Checks that there are as many columns, or numbers of one state, as entries.
    ///
    /// # Errors
    ///
    /// The number is different.
    pub fn check_columns(self, inputs: usize, outputs: usize) -> Result<(), Errors> {
        let mut errors = vec![];
        for (kind, expected, found) in
            [("inputs", self.input_size(), inputs), ("outputs", self.output_size(), outputs)]
        {
            if expected != found {
                let function = self.function.name.clone();
                errors.push(Error::Columns { function, kind, expected, found });
            }
        }
        Errors::check(errors, ())
    }

    /// Computes the function at several states. `inputs` has the entries of each named input at each state; the result
    /// has, for each state, the entries of all outputs.
    ///
    /// # Errors
    ///
    /// Inputs that are missing or unknown, have the wrong length at a state, or have different numbers of states.
    pub fn states(
        self,
        states: usize,
        inputs: &[(&str, &[Vec<f64>])],
    ) -> Result<Vec<Vec<f64>>, Errors> {
        let entries = self.rows(states, inputs)?;
        let mut found = vec![vec![0.0; self.output_size()]; states];
        let read = |entry: usize, state: usize| {
            let (rows, entry) = entries[entry];
            rows[state][entry]
        };
        self.blocks::<BLOCK>(states, read, |entry, state, value| found[state][entry] = value);
        Ok(found)
    }

    /// Returns, for each entry of the inputs, in their order, the rows that contain it and its index in them.
    ///
    /// # Errors
    ///
    /// Those of [`Callable::states`].
    pub fn rows<'v>(
        self,
        states: usize,
        inputs: &[(&str, &'v [Vec<f64>])],
    ) -> Result<Vec<Place<'v>>, Errors> {
        let mut errors = vec![];
        for (_, rows) in inputs.iter().filter(|(_, rows)| rows.len() != states) {
            let (function, found) = (self.function.name.clone(), rows.len());
            errors.push(Error::States { function, expected: states, found });
        }
        Errors::check(errors, ())?;
        let mut lengths: Vec<(&str, usize)> = vec![];
        for state in 0..states {
            lengths.clear();
            lengths.extend(inputs.iter().map(|(name, rows)| (*name, rows[state].len())));
            self.check(&lengths)?;
        }
        let given = |input: &Input| inputs.iter().find(|(name, _)| *name == input.name);
        let entries = self.inputs().iter().flat_map(|input| {
            (0..input.symbols.len()).filter_map(move |entry| Some((given(input)?.1, entry)))
        });
        Ok(entries.collect())
    }

    /// Computes the states block by block. `read` returns an entry of the inputs at a state, `write` stores an entry of
    /// the outputs. The last state is repeated to fill the last block.
    fn blocks<const STATES: usize>(
        self,
        states: usize,
        read: impl Fn(usize, usize) -> f64,
        mut write: impl FnMut(usize, usize, f64),
    ) {
        let mut block = Block::<STATES>::new(self.function);
        for start in (0..states).step_by(STATES) {
            let last = states - 1;
            let read =
                |entry: usize| std::array::from_fn(|state| read(entry, last.min(start + state)));
            self.block(read, &mut block);
            for (entry, value) in self.function.core.results().iter().enumerate() {
                let values = block.values[value.index()];
                for (state, value) in (start..states).zip(values) {
                    write(entry, state, value);
                }
            }
        }
    }

    /// Computes the values of the arithmetic at a block of states.
    fn block<const STATES: usize>(
        self,
        read: impl Fn(usize) -> [f64; STATES],
        block: &mut Block<STATES>,
    ) {
        let (function, trigonometry) = (self.function, self.trigonometry);
        let Block { values, circular } = block;
        circular.clear();
        if !function.angles.results().is_empty() {
            let load = |source| self.load(source, &read, &[]);
            evaluate_block(&function.angles, trigonometry, load, values);
            circular.extend(function.angles.results().iter().map(|angle| {
                let pairs = values[angle.index()].map(|angle| sin_cos(trigonometry, angle));
                [pairs.map(|(sin, _)| sin), pairs.map(|(_, cos)| cos)]
            }));
        }
        let load = |source| self.load(source, &read, circular);
        evaluate_block(&function.core, trigonometry, load, values);
    }

    fn load<const STATES: usize>(
        self,
        source: Source,
        read: impl Fn(usize) -> [f64; STATES],
        circular: &[[[f64; STATES]; 2]],
    ) -> [f64; STATES] {
        match source {
            Source::Parameter(_) => [f64::NAN; STATES],
            Source::Field(index) => [self.fields[index as usize]; STATES],
            Source::Input(index) => read(index as usize),
            Source::Sin(index) => circular[index as usize][0],
            Source::Cos(index) => circular[index as usize][1],
        }
    }

    /// The values that the loads of the arithmetic read at a state.
    pub(super) fn loads(self, inputs: &[f64]) -> impl Fn(Source) -> f64 {
        let mut block = Block::<1>::new(self.function);
        let read = |entry: usize| [inputs[entry]];
        self.block(read, &mut block);
        move |source| {
            let [value] = self.load(source, |entry| [inputs[entry]], &block.circular);
            value
        }
    }

    /// The entries of all inputs in the order of the function.
    ///
    /// # Errors
    ///
    /// Inputs that are missing, unknown or of the wrong length.
    pub fn gather(self, given: &[(&str, &[f64])]) -> Result<Vec<f64>, Errors> {
        let lengths: Vec<(&str, usize)> =
            given.iter().map(|(name, entries)| (*name, entries.len())).collect();
        self.check(&lengths)?;
        let of = |input: &Input| given.iter().find(|(name, _)| *name == input.name);
        let entries = self.inputs().iter().filter_map(of).flat_map(|(_, entries)| *entries);
        Ok(entries.copied().collect())
    }

    /// Checks that the function has exactly these inputs with these numbers of entries.
    fn check(self, given: &[(&str, usize)]) -> Result<(), Errors> {
        let function = self.function;
        let mut errors = vec![];
        for (name, _) in given {
            if function.inputs.iter().all(|input| input.name != *name) {
                errors.push(Error::UnknownInput {
                    function: function.name.clone(),
                    input: (*name).to_owned(),
                    known: names(function.inputs.iter().map(|input| &input.name)),
                });
            }
        }
        for input in &function.inputs {
            let (function, expected) = (&function.name, input.symbols.len());
            match given.iter().find(|(given, _)| *given == input.name) {
                Some((_, length)) if *length == expected => {}
                Some((_, found)) => errors.push(Error::InputLength {
                    function: function.clone(),
                    input: input.name.clone(),
                    expected,
                    found: *found,
                }),
                None => errors.push(Error::MissingInput {
                    function: function.clone(),
                    input: input.name.clone(),
                    length: expected,
                }),
            }
        }
        Errors::check(errors, ())
    }
}
