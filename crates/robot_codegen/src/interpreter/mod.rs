//! The interpreter, which runs programs without compiling them.
//!
//! The interpreter does the operations of the generated code in `f64`, one by one and in the same order.
//! It computes values without a compiler, and generated code can be compared with it to the last bit, except
//! for multiply-adds, including those of the runtime's sines: here they round twice on every machine, in
//! compiled code once on targets that fuse them. Limbs that are alike are computed one by one here.
//!
//! [`Interpreter::call`] takes the function and its inputs by name. If one function runs at many states,
//! [`Interpreter::function`] looks it up once and returns a [`Callable`], which computes blocks of states.

mod callable;
mod evaluation;

use std::borrow::Cow;
use std::sync::OnceLock;

use rustc_hash::FxHashMap;

pub use self::callable::{Callable, Place};
pub(crate) use self::evaluation::call;
pub use self::evaluation::evaluate;
use crate::error::{Error, Errors};
use crate::module::Module;
use crate::program::Source;
use crate::rounding::{self, Rounded};
use crate::trigonometry::Trigonometry;

/// A module with values of its parameters.
#[derive(Clone, Debug)]
pub struct Interpreter<'m> {
    module: Cow<'m, Module>,
    parameters: Vec<f64>,
    fields: Vec<f64>,
    /// The fields with bounds on their rounding errors, computed on first use.
    rounded: OnceLock<Vec<Rounded>>,
    trigonometry: Trigonometry,
}

/// One output of a call.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputValues {
    /// The name.
    pub name: String,
    /// `[]` for a scalar, `[n]` for a vector, `[rows, columns]` for a matrix.
    pub shape: Vec<usize>,
    /// The entries, row by row.
    pub values: Vec<f64>,
}

impl<'m> Interpreter<'m> {
    /// Runs the constructor with the parameter values in `given`; all other parameters have their nominal values.
    ///
    /// # Errors
    ///
    /// Names that are not parameters, and parameters with neither a given nor a nominal value.
    pub fn new(module: &'m Module, given: &[(&str, f64)]) -> Result<Interpreter<'m>, Errors> {
        Interpreter::of(Cow::Borrowed(module), given)
    }

    /// Does the same as [`Interpreter::new`], but takes ownership of the module.
    ///
    /// # Errors
    ///
    /// The errors of [`Interpreter::new`].
    pub fn owned(module: Module, given: &[(&str, f64)]) -> Result<Interpreter<'static>, Errors> {
        Interpreter::of(Cow::Owned(module), given)
    }

    fn of<'a>(module: Cow<'a, Module>, given: &[(&str, f64)]) -> Result<Interpreter<'a>, Errors> {
        let given_values: FxHashMap<&str, f64> = given.iter().copied().collect();
        let mut errors = vec![];
        for (name, _) in given {
            if module.parameters.iter().all(|parameter| parameter.name != *name) {
                errors.push(Error::UnknownParameter {
                    module: module.name.clone(),
                    parameter: (*name).to_owned(),
                    known: names(module.parameters.iter().map(|parameter| &parameter.name)),
                });
            }
        }
        let mut values = vec![];
        for parameter in &module.parameters {
            let value = given_values.get(parameter.name.as_str()).copied();
            match value.or(parameter.nominal) {
                Some(value) => values.push(value),
                None => errors.push(Error::MissingParameter { parameter: parameter.name.clone() }),
            }
        }
        let parameters = Errors::check(errors, values)?;
        let trigonometry = Trigonometry::default();
        let fields = fields(&module, &parameters, trigonometry);
        Ok(Interpreter { module, parameters, fields, rounded: OnceLock::new(), trigonometry })
    }

    /// Changes the source of sines and cosines, including those of the constructor.
    #[must_use]
    pub fn with_trigonometry(self, trigonometry: Trigonometry) -> Interpreter<'m> {
        if trigonometry == self.trigonometry {
            return self;
        }
        let fields = fields(&self.module, &self.parameters, trigonometry);
        Interpreter { fields, rounded: OnceLock::new(), trigonometry, ..self }
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
    ) -> Result<Vec<OutputValues>, Errors> {
        let function = self.function(function)?;
        Ok(function.named(function.call(inputs)?))
    }

    /// Calls a function as [`Interpreter::call`] does, but returns all outputs in one array, with bounds on their
    /// rounding errors. The bounds include the errors of the constructor and of the parameters' values: half a unit in
    /// the last place of each value.
    ///
    /// # Errors
    ///
    /// The errors of [`Interpreter::call`].
    pub fn call_rounded(
        &self,
        function: &str,
        inputs: &[(&str, &[f64])],
    ) -> Result<Vec<Rounded>, Errors> {
        let callable = self.function(function)?;
        let inputs = callable.gather(inputs)?;
        let load = callable.loads(&inputs);
        let fields = self.rounded.get_or_init(|| self.rounded_fields());
        let load = |source| match source {
            Source::Field(index) => fields[index as usize],
            other => Rounded::loaded(other, self.trigonometry, load(other)),
        };
        Ok(rounding::evaluate(callable.core(), self.trigonometry, load))
    }

    /// Computes the values that the constructor stores, with bounds on their rounding errors.
    fn rounded_fields(&self) -> Vec<Rounded> {
        rounding::evaluate(&self.module.constructor, self.trigonometry, |source| {
            let value = match source {
                Source::Parameter(index) => self.parameters[index as usize],
                _ => f64::NAN,
            };
            Rounded::loaded(source, self.trigonometry, value)
        })
    }

    /// The module.
    #[must_use]
    pub fn module(&self) -> &Module {
        &self.module
    }

    /// The fields: the values that the constructor stores.
    #[must_use]
    pub fn fields(&self) -> &[f64] {
        &self.fields
    }

    /// Looks up a function by its name.
    ///
    /// # Errors
    ///
    /// An unknown function.
    pub fn function(&self, name: &str) -> Result<Callable<'_>, Errors> {
        let function = self.module.function(name).ok_or_else(|| {
            Errors::from(Error::UnknownFunction {
                module: self.module.name.clone(),
                function: name.to_owned(),
                known: names(self.module.functions.iter().map(|function| &function.name)),
            })
        })?;
        Ok(Callable::new(function, &self.fields, self.trigonometry))
    }
}

/// Computes the values that the constructor stores.
fn fields(module: &Module, parameters: &[f64], trigonometry: Trigonometry) -> Vec<f64> {
    evaluate(&module.constructor, trigonometry, |source| match source {
        Source::Parameter(index) => parameters[index as usize],
        _ => f64::NAN,
    })
}

fn names<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let quoted: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    if quoted.is_empty() { "none".to_owned() } else { quoted.join(", ") }
}
