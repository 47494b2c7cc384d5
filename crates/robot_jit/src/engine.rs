//! Functions that run wherever they can: as machine code, or in the interpreter where machine code is not to be had.

use robot_codegen::{Callable, Errors, Input, Interpreter, Module, Output, OutputValues};

use crate::compiled::{Compiled, Function, Options, compile_owned};

/// A module with its parameters given, as machine code or interpreted.
#[derive(Debug)]
pub enum Engine {
    /// Machine code.
    Native(Compiled<'static>),
    /// The interpreter, on machines that no code is made for.
    Interpreted(Interpreter<'static>),
}

/// A function of an [`Engine`].
#[derive(Clone, Copy, Debug)]
pub enum Handle<'e> {
    /// Machine code.
    Native(Function<'e>),
    /// The interpreter.
    Interpreted(Callable<'e>),
}

impl Engine {
    /// All functions of a module: the parameters that `given` names, the others at their nominal values. Where there
    /// is no machine code, for whatever reason, the interpreter computes the same.
    ///
    /// # Errors
    ///
    /// Names that are not parameters, and parameters with neither a given nor a nominal value.
    pub fn new(module: &Module, given: &[(&str, f64)]) -> Result<Engine, Errors> {
        // What is wrong with the parameters is wrong with both.
        let interpreter = Interpreter::owned(module.clone(), given)?;
        match compile_owned(module.clone(), given, &Options::default()) {
            Ok(compiled) => Ok(Engine::Native(compiled)),
            Err(_) => Ok(Engine::Interpreted(interpreter)),
        }
    }

    /// Whether the functions are machine code.
    #[must_use]
    pub fn is_native(&self) -> bool {
        matches!(self, Engine::Native(_))
    }

    /// A function by its name.
    ///
    /// # Errors
    ///
    /// A function that the module has not.
    pub fn function(&self, name: &str) -> Result<Handle<'_>, crate::Error> {
        match self {
            Engine::Native(compiled) => compiled.function(name).map(Handle::Native),
            Engine::Interpreted(program) => Ok(Handle::Interpreted(program.function(name)?)),
        }
    }
}

impl<'e> Handle<'e> {
    /// The inputs.
    #[must_use]
    pub fn inputs(self) -> &'e [Input] {
        match self {
            Handle::Native(function) => function.inputs(),
            Handle::Interpreted(function) => function.inputs(),
        }
    }

    /// The outputs.
    #[must_use]
    pub fn outputs(self) -> &'e [Output] {
        match self {
            Handle::Native(function) => function.outputs(),
            Handle::Interpreted(function) => function.outputs(),
        }
    }

    /// The number of entries of all inputs.
    #[must_use]
    pub fn input_size(self) -> usize {
        match self {
            Handle::Native(function) => function.input_size(),
            Handle::Interpreted(function) => function.input_size(),
        }
    }

    /// The number of entries of all outputs.
    #[must_use]
    pub fn output_size(self) -> usize {
        match self {
            Handle::Native(function) => function.output_size(),
            Handle::Interpreted(function) => function.output_size(),
        }
    }

    /// The entries of all outputs with their names and shapes.
    #[must_use]
    pub fn named(self, values: Vec<f64>) -> Vec<OutputValues> {
        match self {
            Handle::Native(function) => function.named(values),
            Handle::Interpreted(function) => function.named(values),
        }
    }

    /// Computes many states, a column for each entry, as [`Function::columns`] does.
    ///
    /// # Errors
    ///
    /// Another number of columns than there are entries; columns that are not all of one length.
    pub fn columns(self, inputs: &[&[f64]], outputs: &mut [&mut [f64]]) -> Result<(), Errors> {
        match self {
            Handle::Native(function) => function.columns(inputs, outputs),
            Handle::Interpreted(function) => function.columns(inputs, outputs),
        }
    }

    /// Computes one state: the entries of all inputs, in their order, and those of all outputs.
    ///
    /// # Errors
    ///
    /// Another number of entries.
    pub fn entries(self, inputs: &[f64], outputs: &mut [f64]) -> Result<(), Errors> {
        match self {
            Handle::Native(function) => function.entries(inputs, outputs),
            Handle::Interpreted(function) => {
                let inputs: Vec<&[f64]> = inputs.chunks(1).collect();
                let mut outputs: Vec<&mut [f64]> = outputs.chunks_mut(1).collect();
                function.columns(&inputs, &mut outputs)
            }
        }
    }
}
