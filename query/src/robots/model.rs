//! A robot with the functions that were compiled for it.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use robot_build::{FunctionKind, Functions, Options, Robot, Source};
use robot_codegen::program::Operation;
use robot_codegen::{Program, Trigonometry};
use robot_jit::Executable;

use crate::error::Error;

/// A robot after reading. Its functions are compiled when they are first needed.
#[derive(Debug)]
pub struct Model {
    /// The robot.
    pub robot: Robot,
    /// The robot file: its name in messages, and its text.
    pub source: Source,
    options: Options,
    compiled: Mutex<HashMap<FunctionKind, Arc<Compiled>>>,
}

/// A compiled function.
#[derive(Debug)]
pub struct Compiled {
    /// Machine code, or the interpreter if there is no machine code for the processor; its only function has the
    /// kind's name.
    pub executable: Executable<'static>,
    /// For each entry of the outputs, whether it is 0 at all states by structure.
    pub(crate) zeros: Vec<bool>,
}

impl Model {
    pub(crate) fn new(source: Source, options: Options) -> Result<Model, Error> {
        let described = robot_build::read_with(&source, &options)
            .map_err(|errors| failed(&source.name, &errors))?;
        Ok(Model { robot: described.robot, source, options, compiled: Mutex::default() })
    }

    /// The number of coordinates.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.robot.degrees_of_freedom()
    }

    /// Returns a function, which is compiled when it is first needed.
    ///
    /// # Errors
    ///
    /// A function that the robot does not have; parameters without a nominal value.
    pub fn compiled(&self, kind: FunctionKind) -> Result<Arc<Compiled>, Error> {
        let mut known = self.compiled.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(compiled) = known.get(&kind) {
            return Ok(compiled.clone());
        }
        if let Some(reason) = kind.missing_in(&self.robot) {
            return Err(failed(&self.source.name, &format!("{}: {reason}", kind.name())));
        }
        let options = Options { functions: Functions::Chosen(vec![kind]), ..self.options.clone() };
        let programs = robot_build::programs_of(self.robot.clone(), &self.source.name, &options)
            .map_err(|errors| failed(&self.source.name, &errors))?;
        let zeros = programs.module.function(kind.name()).map(|function| zeros(&function.core));
        let executable = Executable::owned(programs.module, &[], Trigonometry::default())
            .map_err(|errors| failed(&self.source.name, &errors))?;
        let compiled = Arc::new(Compiled { executable, zeros: zeros.unwrap_or_default() });
        known.insert(kind, compiled.clone());
        Ok(compiled)
    }
}

/// For each result of a program, whether it is the constant 0.
fn zeros(program: &Program) -> Vec<bool> {
    let operations = program.operations();
    let is_zero = |operation: Operation| matches!(operation, Operation::Constant(constant) if constant.get() == 0.0);
    program.results().iter().map(|result| is_zero(operations[result.index()])).collect()
}

fn failed(robot: &str, reason: &dyn std::fmt::Display) -> Error {
    Error::Robot { robot: robot.to_owned(), reason: reason.to_string() }
}
