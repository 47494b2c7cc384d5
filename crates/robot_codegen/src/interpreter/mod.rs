//! Running programs without compiling them.
//!
//! The interpreter does the operations of the generated code in `f64`, one by one and in the same
//! order, so that numbers can be had without a compiler and generated code can be checked to the
//! last bit (but for multiply-adds, those of the runtime's sines among them, which round twice here on
//! every machine and once on targets that fuse them).

use std::borrow::Cow;
use std::sync::OnceLock;

use robot_runtime::{Scalar as _, trig};
use robot_symbolic::Function as Call;
use rustc_hash::FxHashMap;

use crate::error::{Error, Errors};
use crate::module::{Function, Module};
use crate::program::{Operation, Program, Source, Value};
use crate::rounding::{self, Rounded};
use crate::trigonometry::Trigonometry;

/// A module with its parameters given.
#[derive(Clone, Debug)]
pub struct Interpreter<'m> {
    module: Cow<'m, Module>,
    parameters: Vec<f64>,
    fields: Vec<f64>,
    /// The fields with bounds of their rounding, once these are asked for.
    rounded: OnceLock<Vec<Rounded>>,
    trigonometry: Trigonometry,
}

/// An output of a call.
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
    /// Runs the constructor: the parameters that `given` names, the others at their nominal values.
    ///
    /// # Errors
    ///
    /// Names that are no parameters, and parameters with neither a given nor a nominal value.
    pub fn new(module: &'m Module, given: &[(&str, f64)]) -> Result<Interpreter<'m>, Errors> {
        Interpreter::of(Cow::Borrowed(module), given)
    }

    /// As [`Interpreter::new`], of a module that it keeps.
    ///
    /// # Errors
    ///
    /// Those of [`Interpreter::new`].
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

    /// The same with sines and cosines, of the constructor as well, from elsewhere.
    #[must_use]
    pub fn with_trigonometry(self, trigonometry: Trigonometry) -> Interpreter<'m> {
        let fields = fields(&self.module, &self.parameters, trigonometry);
        Interpreter { fields, rounded: OnceLock::new(), trigonometry, ..self }
    }

    /// Calls a function; inputs by name.
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
        let inputs = gather_inputs(function, inputs)?;
        let mut results = self.run(function, &inputs).into_iter();
        let outputs = function.outputs.iter().map(|output| OutputValues {
            name: output.name.clone(),
            shape: output.shape.clone(),
            values: results.by_ref().take(output.len()).collect(),
        });
        Ok(outputs.collect())
    }

    /// As [`Interpreter::call`], all outputs in one array, with bounds of what rounding does to them, that
    /// of the constructor and of the parameters' values included: half a unit in the last place of each.
    ///
    /// # Errors
    ///
    /// Those of [`Interpreter::call`].
    pub fn call_rounded(
        &self,
        function: &str,
        inputs: &[(&str, &[f64])],
    ) -> Result<Vec<Rounded>, Errors> {
        let function = self.function(function)?;
        let inputs = gather_inputs(function, inputs)?;
        let circular = self.circular(function, &inputs);
        let fields = self.rounded.get_or_init(|| self.rounded_fields());
        let load = |source| match source {
            Source::Field(index) => fields[index as usize],
            other => {
                let value = self.load(other, &inputs, &circular);
                Rounded::loaded(other, self.trigonometry, value)
            }
        };
        Ok(rounding::evaluate(&function.core, self.trigonometry, load))
    }

    /// What the constructor stores, with bounds of its rounding.
    fn rounded_fields(&self) -> Vec<Rounded> {
        rounding::evaluate(&self.module.constructor, self.trigonometry, |source| {
            let value = match source {
                Source::Parameter(index) => self.parameters[index as usize],
                _ => f64::NAN,
            };
            Rounded::loaded(source, self.trigonometry, value)
        })
    }

    fn function(&self, name: &str) -> Result<&Function, Errors> {
        self.module.function(name).ok_or_else(|| {
            Errors::from(Error::UnknownFunction {
                module: self.module.name.clone(),
                function: name.to_owned(),
                known: names(self.module.functions.iter().map(|function| &function.name)),
            })
        })
    }

    /// The results of a function of the module at the entries of its inputs, all in one array.
    fn run(&self, function: &Function, inputs: &[f64]) -> Vec<f64> {
        let circular = self.circular(function, inputs);
        let load = |source| self.load(source, inputs, &circular);
        evaluate(&function.core, self.trigonometry, load)
    }

    /// The sines and cosines of the function's angles.
    fn circular(&self, function: &Function, inputs: &[f64]) -> Vec<(f64, f64)> {
        let trigonometry = self.trigonometry;
        let load = |source| self.load(source, inputs, &[]);
        let angles = evaluate(&function.angles, trigonometry, load);
        angles.iter().map(|angle| sin_cos(trigonometry, *angle)).collect()
    }

    fn load(&self, source: Source, inputs: &[f64], circular: &[(f64, f64)]) -> f64 {
        match source {
            Source::Parameter(_) => f64::NAN,
            Source::Field(index) => self.fields[index as usize],
            Source::Input(index) => inputs[index as usize],
            Source::Sin(index) => circular[index as usize].0,
            Source::Cos(index) => circular[index as usize].1,
        }
    }
}

/// What the constructor stores.
fn fields(module: &Module, parameters: &[f64], trigonometry: Trigonometry) -> Vec<f64> {
    evaluate(&module.constructor, trigonometry, |source| match source {
        Source::Parameter(index) => parameters[index as usize],
        _ => f64::NAN,
    })
}

/// The entries of all inputs in the order of the function.
fn gather_inputs(function: &Function, given: &[(&str, &[f64])]) -> Result<Vec<f64>, Errors> {
    let (mut errors, mut values) = (vec![], vec![]);
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
        let (function, expected) = (function.name.clone(), input.symbols.len());
        let name = input.name.clone();
        match given.iter().find(|(given, _)| *given == name) {
            Some((_, entries)) if entries.len() == expected => values.extend_from_slice(entries),
            Some((_, entries)) => errors.push(Error::InputLength {
                function,
                input: name,
                expected,
                found: entries.len(),
            }),
            None => errors.push(Error::MissingInput { function, input: name, length: expected }),
        }
    }
    Errors::check(errors, values)
}

fn names<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let quoted: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    if quoted.is_empty() { "none".to_owned() } else { quoted.join(", ") }
}

fn sin_cos(trigonometry: Trigonometry, angle: f64) -> (f64, f64) {
    match trigonometry {
        Trigonometry::Standard => angle.sin_cos(),
        Trigonometry::Polynomial => trig::double::portable_sin_cos(angle),
    }
}

/// The functions as generated code has them.
pub(crate) fn call(trigonometry: Trigonometry, function: Call, argument: f64) -> f64 {
    match function {
        Call::Sin => sin_cos(trigonometry, argument).0,
        Call::Cos => sin_cos(trigonometry, argument).1,
        Call::Sign => argument.signum0(),
        Call::Tanh => robot_runtime::Scalar::tanh(argument),
        Call::RecipPositive => argument.recip_positive(),
        Call::Sqrt | Call::Abs => function.apply(argument),
    }
}

/// The results of a program, given what its loads read. A multiply-add rounds twice.
#[must_use]
pub fn evaluate(
    program: &Program,
    trigonometry: Trigonometry,
    load: impl Fn(Source) -> f64,
) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::with_capacity(program.operations().len());
    for operation in program.operations() {
        let at = |value: Value| values[value.index()];
        values.push(match *operation {
            Operation::Constant(constant) => constant.get(),
            Operation::Load(source) => load(source),
            Operation::Add(a, b) => at(a) + at(b),
            Operation::Sub(a, b) => at(a) - at(b),
            Operation::Mul(a, b) => at(a) * at(b),
            Operation::Div(a, b) => at(a) / at(b),
            Operation::Neg(a) => -at(a),
            Operation::MulAdd(a, b, c) => at(a) * at(b) + at(c),
            Operation::Call(function, a) => call(trigonometry, function, at(a)),
        });
    }
    let results = program.results().iter();
    results.map(|value| values[value.index()]).collect()
}
