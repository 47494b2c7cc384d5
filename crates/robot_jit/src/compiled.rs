//! Compiled modules, and handles to their functions.

use robot_codegen::{
    Callable, Errors, Input, Interpreter, Module, Output, OutputValues, Trigonometry,
};

use crate::emit::{Fault, LanesEntry, SingleEntry, Target, emit_lanes, emit_single};
use crate::error::Error;
use crate::memory::{LanesCode, SingleCode, place};
use crate::processor::Registers;

/// The number of states that are copied into columns at once.
const BLOCK: usize = 64;

/// The largest number of values of a function, so that all addresses fit into 31 bits.
const MOST_VALUES: usize = 1 << 18;

/// The functions to compile, the processor, and the arithmetic.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The vector registers; those of this machine if `None`.
    pub registers: Option<Registers>,
    /// The source of sines and cosines; must be the polynomials.
    pub trigonometry: Trigonometry,
    /// Whether multiply-adds in sines and cosines round once, as in code that rustc compiles for this processor. This
    /// is faster, but the bits differ from those of the interpreter.
    pub fused: bool,
    /// The names of the functions; all if `None`.
    pub functions: Option<Vec<String>>,
}

/// A module with values of its parameters, as machine code.
#[derive(Debug)]
pub struct Compiled<'m> {
    interpreter: Interpreter<'m>,
    registers: Registers,
    /// The functions that were compiled, by their names.
    functions: Vec<Placed>,
}

/// A function in machine code.
#[derive(Clone, Copy, Debug)]
pub struct Function<'c> {
    callable: Callable<'c>,
    single: &'c SingleCode,
    lanes: &'c LanesCode,
    registers: Registers,
}

/// Compiles all functions with the parameter values in `given`; all other parameters have their nominal values. The
/// interpreter runs the constructor.
///
/// # Errors
///
/// The machine does not have the registers; the parameters are invalid, see [`Interpreter::new`]; a function is too large
/// or needs too much of the stack; the system does not provide memory for code.
pub fn compile<'m>(module: &'m Module, given: &[(&str, f64)]) -> Result<Compiled<'m>, Error> {
    compile_with(module, given, &Options::default())
}

/// Does the same as [`compile`], with options.
///
/// # Errors
///
/// The errors of [`compile`]; sines of the standard library; unknown names of functions.
pub fn compile_with<'m>(
    module: &'m Module,
    given: &[(&str, f64)],
    options: &Options,
) -> Result<Compiled<'m>, Error> {
    let interpreter = Interpreter::new(module, given)?;
    let code = code_of(&interpreter, options)?;
    Ok(Compiled::new(interpreter, code))
}

/// Does the same as [`compile_with`], but takes ownership of the module, for callers that cannot borrow it.
///
/// # Errors
///
/// The errors of [`compile_with`].
pub fn compile_owned(
    module: Module,
    given: &[(&str, f64)],
    options: &Options,
) -> Result<Compiled<'static>, Error> {
    let interpreter = Interpreter::owned(module, given)?;
    let code = code_of(&interpreter, options)?;
    Ok(Compiled::new(interpreter, code))
}

/// The name of a function, its code for one state and its code for several.
type Placed = (String, SingleCode, LanesCode);

/// The registers, and the code of functions that uses them.
pub(crate) type Code = (Registers, Vec<Placed>);

/// Makes the code of the functions that the options name.
pub(crate) fn code_of(interpreter: &Interpreter<'_>, options: &Options) -> Result<Code, Error> {
    let module = interpreter.module();
    let registers = match options.registers {
        Some(registers) => registers.check()?,
        None => Registers::detect()?,
    };
    if options.trigonometry != Trigonometry::Polynomial {
        return Err(Error::Trigonometry);
    }
    let target = Target { registers, fused: options.fused };
    let names: Vec<&str> = match &options.functions {
        Some(names) => names.iter().map(String::as_str).collect(),
        None => module.functions.iter().map(|function| function.name.as_str()).collect(),
    };
    let mut entries = vec![];
    for name in &names {
        interpreter.function(name)?;
        if let Some(function) = module.function(name) {
            entries.push(emit(function, interpreter.fields(), target)?);
        }
    }
    let names = names.into_iter().map(str::to_owned);
    let functions = names.zip(place(entries)?).map(|(name, (single, lanes))| (name, single, lanes));
    Ok((registers, functions.collect()))
}

/// Makes the code of a function for one state and for several.
fn emit(
    function: &robot_codegen::module::Function,
    fields: &[f64],
    target: Target,
) -> Result<(SingleEntry, LanesEntry), Error> {
    let name = || function.name.clone();
    let inputs: usize = function.inputs.iter().map(|input| input.symbols.len()).sum();
    let values = function.angles.operations().len()
        + function.angles.results().len()
        + function.core.operations().len()
        + function.core.results().len()
        + inputs;
    if values > MOST_VALUES {
        return Err(Error::Size { function: name(), values, most: MOST_VALUES });
    }
    let failed = |fault| match fault {
        Fault::Missing => Error::Load { function: name() },
        Fault::Encoding(reason) => Error::Encoding { function: name(), reason },
        Fault::Stack(bytes) => Error::Stack { function: name(), bytes },
    };
    let single = emit_single(function, fields, target).map_err(failed)?;
    let lanes = emit_lanes(function, fields, target).map_err(failed)?;
    Ok((single, lanes))
}

impl<'m> Compiled<'m> {
    /// Combines an interpreter and the code of its functions.
    pub(crate) fn new(interpreter: Interpreter<'m>, code: Code) -> Compiled<'m> {
        let (registers, functions) = code;
        Compiled { interpreter, registers, functions }
    }

    /// Looks up a function by its name.
    ///
    /// # Errors
    ///
    /// A function that the module does not have, or that was not compiled.
    pub fn function(&self, name: &str) -> Result<Function<'_>, Error> {
        // An unknown name is reported as such, not as that of a function that was not compiled.
        self.interpreter.function(name)?;
        self.compiled(name).ok_or_else(|| Error::NotCompiled { function: name.to_owned() })
    }

    /// Looks up a function by its name; `None` if it was not compiled.
    pub(crate) fn compiled(&self, name: &str) -> Option<Function<'_>> {
        let callable = self.interpreter.function(name).ok()?;
        let (_, single, lanes) = self.functions.iter().find(|(compiled, ..)| compiled == name)?;
        Some(Function { callable, single, lanes, registers: self.registers })
    }

    /// The size of the code of all functions in bytes, without constants.
    #[must_use]
    pub fn code_size(&self) -> usize {
        self.functions.iter().map(|(_, single, lanes)| single.size() + lanes.size()).sum()
    }

    /// The registers for which the code was made.
    #[must_use]
    pub fn registers(&self) -> Registers {
        self.registers
    }

    /// The interpreter of the same module and parameters.
    #[must_use]
    pub fn interpreter(&self) -> &Interpreter<'m> {
        &self.interpreter
    }

    /// Calls a function; the inputs are given by name.
    ///
    /// # Errors
    ///
    /// An unknown function; inputs that are missing, unknown or of the wrong length.
    pub fn call(
        &self,
        function: &str,
        inputs: &[(&str, &[f64])],
    ) -> Result<Vec<OutputValues>, Error> {
        let function = self.function(function)?;
        Ok(function.named(function.call(inputs)?))
    }
}

impl<'c> Function<'c> {
    /// The same function in the interpreter.
    pub(crate) fn callable(self) -> Callable<'c> {
        self.callable
    }

    /// The name.
    #[must_use]
    pub fn name(self) -> &'c str {
        self.callable.name()
    }

    /// The inputs.
    #[must_use]
    pub fn inputs(self) -> &'c [Input] {
        self.callable.inputs()
    }

    /// The outputs.
    #[must_use]
    pub fn outputs(self) -> &'c [Output] {
        self.callable.outputs()
    }

    /// The number of entries of all inputs.
    #[must_use]
    pub fn input_size(self) -> usize {
        self.callable.input_size()
    }

    /// The number of entries of all outputs.
    #[must_use]
    pub fn output_size(self) -> usize {
        self.callable.output_size()
    }

    /// Splits the values returned by [`Function::call`] into outputs with their names and shapes.
    #[must_use]
    pub fn named(self, values: Vec<f64>) -> Vec<OutputValues> {
        self.callable.named(values)
    }

    /// Computes the entries of all outputs at one state; the inputs are given by name.
    ///
    /// # Errors
    ///
    /// Inputs that are missing, unknown or of the wrong length.
    pub fn call(self, inputs: &[(&str, &[f64])]) -> Result<Vec<f64>, Errors> {
        let entries = self.callable.gather(inputs)?;
        let mut found = vec![0.0; self.output_size()];
        self.entries(&entries, &mut found)?;
        Ok(found)
    }

    /// Computes one state. `inputs` has the entries of all inputs, in their order; `outputs` receives those of all
    /// outputs. Nothing is allocated, except for functions that spill more than about 380 numbers.
    ///
    /// # Errors
    ///
    /// The number of entries is wrong.
    #[inline]
    pub fn entries(self, inputs: &[f64], outputs: &mut [f64]) -> Result<(), Errors> {
        if self.single.call(inputs, outputs) {
            return Ok(());
        }
        self.callable.check_columns(inputs.len(), outputs.len())
    }

    /// Computes many states. `inputs` has a column for each entry of the inputs, in their order, and `outputs` has one
    /// for each entry of the outputs; row i of every column belongs to state i. Memory is not allocated for each state.
    ///
    /// # Errors
    ///
    /// The number of columns differs from the number of entries, or the columns have different lengths.
    pub fn columns(self, inputs: &[&[f64]], outputs: &mut [&mut [f64]]) -> Result<(), Errors> {
        let states = self.callable.check_lengths(inputs, outputs)?;
        let whole = states - states % self.registers.lanes();
        self.lanes.call(inputs, outputs, whole);
        if whole < states {
            let read = |entry: usize, state: usize| inputs[entry][whole + state];
            let mut block = Block::new(self, self.registers.lanes());
            block.run(states - whole, read, |entry, state, value| {
                outputs[entry][whole + state] = value;
            });
        }
        Ok(())
    }

    /// Computes several states. `inputs` has the entries of each named input at each state; the result has, for each
    /// state, the entries of all outputs.
    ///
    /// # Errors
    ///
    /// Inputs that are missing or unknown, have the wrong length at a state, or have different numbers of states.
    pub fn states(
        self,
        states: usize,
        inputs: &[(&str, &[Vec<f64>])],
    ) -> Result<Vec<Vec<f64>>, Errors> {
        let entries = self.callable.rows(states, inputs)?;
        let mut found = vec![vec![0.0; self.output_size()]; states];
        let mut block = Block::new(self, BLOCK);
        for start in (0..states).step_by(BLOCK) {
            let read = |entry: usize, state: usize| {
                let (rows, entry) = entries[entry];
                rows[start + state][entry]
            };
            block.run(BLOCK.min(states - start), read, |entry, state, value| {
                found[start + state][entry] = value;
            });
        }
        Ok(found)
    }
}

/// Columns of inputs and outputs for a few states.
struct Block<'c> {
    function: Function<'c>,
    length: usize,
    inputs: Vec<f64>,
    outputs: Vec<f64>,
}

impl<'c> Block<'c> {
    /// Allocates columns for at most `length` states, a multiple of the lanes.
    fn new(function: Function<'c>, length: usize) -> Block<'c> {
        let inputs = vec![0.0; length * function.input_size()];
        let outputs = vec![0.0; length * function.output_size()];
        Block { function, length, inputs, outputs }
    }

    /// Computes `states` states, at least one; the last state is repeated to fill the last register.
    fn run(
        &mut self,
        states: usize,
        read: impl Fn(usize, usize) -> f64,
        mut write: impl FnMut(usize, usize, f64),
    ) {
        let whole = states.next_multiple_of(self.function.registers.lanes());
        for (entry, column) in self.inputs.chunks_exact_mut(self.length).enumerate() {
            for (state, value) in column[..whole].iter_mut().enumerate() {
                *value = read(entry, state.min(states - 1));
            }
        }
        let inputs: Vec<&[f64]> = self.inputs.chunks_exact(self.length).collect();
        let mut outputs: Vec<&mut [f64]> = self.outputs.chunks_exact_mut(self.length).collect();
        self.function.lanes.call(&inputs, &mut outputs, whole);
        for (entry, column) in outputs.iter().enumerate() {
            for (state, value) in column[..states].iter().enumerate() {
                write(entry, state, *value);
            }
        }
    }
}
