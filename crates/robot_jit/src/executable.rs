//! Functions that run on every machine: as machine code if the machine is supported, otherwise in the interpreter.

use robot_codegen::program::Operation;
use robot_codegen::{
    Callable, Errors, Input, Interpreter, Module, Output, OutputValues, Trigonometry,
};

use crate::compiled::{Compiled, Function, Options, code_of};
use crate::error::Error;

/// A module with values of its parameters. Its functions are machine code if the machine and the source of sines are
/// supported; otherwise they are interpreted. Functions with multiply-adds are always interpreted, because
/// multiply-adds round once in machine code and twice in the interpreter. So the bits are those of the interpreter on
/// every machine, except for those of NaN.
#[derive(Debug)]
pub struct Executable<'m>(Code<'m>);

#[derive(Debug)]
enum Code<'m> {
    Native(Compiled<'m>),
    Interpreted(Interpreter<'m>),
}

/// A function of an [`Executable`], looked up once.
#[derive(Clone, Copy, Debug)]
pub struct Handle<'e>(Found<'e>);

#[derive(Clone, Copy, Debug)]
enum Found<'e> {
    Native(Function<'e>),
    Interpreted(Callable<'e>),
}

impl<'m> Executable<'m> {
    /// Runs the constructor and compiles all functions with the parameter values in `given`; all other parameters have
    /// their nominal values.
    ///
    /// # Errors
    ///
    /// The errors of [`Interpreter::new`].
    pub fn new(
        module: &'m Module,
        given: &[(&str, f64)],
        trigonometry: Trigonometry,
    ) -> Result<Executable<'m>, Errors> {
        Ok(Executable::of(Interpreter::new(module, given)?, trigonometry))
    }

    /// Does the same as [`Executable::new`], but takes ownership of the module.
    ///
    /// # Errors
    ///
    /// The errors of [`Interpreter::new`].
    pub fn owned(
        module: Module,
        given: &[(&str, f64)],
        trigonometry: Trigonometry,
    ) -> Result<Executable<'static>, Errors> {
        Ok(Executable::of(Interpreter::owned(module, given)?, trigonometry))
    }

    fn of(interpreter: Interpreter<'_>, trigonometry: Trigonometry) -> Executable<'_> {
        let interpreter = interpreter.with_trigonometry(trigonometry);
        let functions = interpreter.module().functions.iter();
        let plain = functions.filter(|function| !has_multiply_adds(function));
        let mut names: Vec<String> = plain.map(|function| function.name.clone()).collect();
        // Functions that cannot be compiled are interpreted.
        let code = loop {
            let functions = Some(names.clone());
            match code_of(&interpreter, &Options { trigonometry, functions, ..Options::default() })
            {
                Ok(code) => break Code::Native(Compiled::new(interpreter, code)),
                Err(Error::Size { function, .. } | Error::Stack { function, .. }) => {
                    names.retain(|name| *name != function);
                }
                Err(_) => break Code::Interpreted(interpreter),
            }
        };
        Executable(code)
    }

    /// Looks up a function by its name.
    ///
    /// # Errors
    ///
    /// An unknown function.
    pub fn function(&self, name: &str) -> Result<Handle<'_>, Errors> {
        Ok(Handle(match &self.0 {
            Code::Native(compiled) => match compiled.compiled(name) {
                Some(function) => Found::Native(function),
                None => Found::Interpreted(compiled.interpreter().function(name)?),
            },
            Code::Interpreted(interpreter) => Found::Interpreted(interpreter.function(name)?),
        }))
    }
}

fn has_multiply_adds(function: &robot_codegen::module::Function) -> bool {
    let mut operations = function.angles.operations().iter().chain(function.core.operations());
    operations.any(|operation| matches!(operation, Operation::MulAdd(..)))
}

impl<'e> Handle<'e> {
    /// Whether the function is machine code.
    #[must_use]
    pub fn is_native(self) -> bool {
        matches!(self.0, Found::Native(_))
    }

    fn callable(self) -> Callable<'e> {
        match self.0 {
            Found::Native(function) => function.callable(),
            Found::Interpreted(callable) => callable,
        }
    }

    /// The name.
    #[must_use]
    pub fn name(self) -> &'e str {
        self.callable().name()
    }

    /// The inputs.
    #[must_use]
    pub fn inputs(self) -> &'e [Input] {
        self.callable().inputs()
    }

    /// The outputs.
    #[must_use]
    pub fn outputs(self) -> &'e [Output] {
        self.callable().outputs()
    }

    /// The number of entries of all inputs.
    #[must_use]
    pub fn input_size(self) -> usize {
        self.callable().input_size()
    }

    /// The number of entries of all outputs.
    #[must_use]
    pub fn output_size(self) -> usize {
        self.callable().output_size()
    }

    /// Splits the entries of all outputs into outputs with their names and shapes.
    #[must_use]
    pub fn named(self, values: Vec<f64>) -> Vec<OutputValues> {
        self.callable().named(values)
    }

    /// Computes the entries of all outputs at one state; the inputs are given by name.
    ///
    /// # Errors
    ///
    /// Inputs that are missing, unknown or of the wrong length.
    pub fn call(self, inputs: &[(&str, &[f64])]) -> Result<Vec<f64>, Errors> {
        match self.0 {
            Found::Native(function) => function.call(inputs),
            Found::Interpreted(callable) => callable.call(inputs),
        }
    }

    /// Computes one state. `inputs` has the entries of all inputs, in their order; `outputs` receives those of all
    /// outputs.
    ///
    /// # Errors
    ///
    /// The number of entries is wrong.
    pub fn entries(self, inputs: &[f64], outputs: &mut [f64]) -> Result<(), Errors> {
        match self.0 {
            Found::Native(function) => function.entries(inputs, outputs),
            Found::Interpreted(callable) => callable.entries(inputs, outputs),
        }
    }

    /// Computes many states, as [`Callable::columns`] does.
    ///
    /// # Errors
    ///
    /// The errors of [`Callable::columns`].
    pub fn columns(self, inputs: &[&[f64]], outputs: &mut [&mut [f64]]) -> Result<(), Errors> {
        match self.0 {
            Found::Native(function) => function.columns(inputs, outputs),
            Found::Interpreted(callable) => callable.columns(inputs, outputs),
        }
    }

    /// Computes several states, as [`Callable::states`] does.
    ///
    /// # Errors
    ///
    /// The errors of [`Callable::states`].
    pub fn states(
        self,
        states: usize,
        inputs: &[(&str, &[Vec<f64>])],
    ) -> Result<Vec<Vec<f64>>, Errors> {
        match self.0 {
            Found::Native(function) => function.states(states, inputs),
            Found::Interpreted(callable) => callable.states(states, inputs),
        }
    }
}
