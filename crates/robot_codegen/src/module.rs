//! A compiled module, which backends print and the interpreter runs.

use std::fmt::{self, Display, Formatter};

use crate::counts::{Counts, FunctionCounts, PassCounts};
use crate::error::Errors;
use crate::limbs::Limbs;
use crate::lower;
use crate::passes::{self, Options};
use crate::program::{Program, Source};
pub use crate::spec::{Input, Output};
use crate::spec::{ModuleSpec, ParameterSpec};
use crate::stage;

/// A compiled module.
#[derive(Clone, Debug, PartialEq)]
pub struct Module {
    /// The name.
    pub name: String,
    /// Documentation, a paragraph or line each.
    pub doc: Vec<String>,
    /// The parameters, which [`Source::Parameter`] refers to by index.
    pub parameters: Vec<ParameterSpec>,
    /// The program that computes, once for each set of parameters, all values that depend only on them. Its
    /// results are the fields of the model, which [`Source::Field`] refers to by index.
    pub constructor: Program,
    /// The functions.
    pub functions: Vec<Function>,
}

/// A compiled function.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// The name.
    pub name: String,
    /// Documentation, a paragraph or line each.
    pub doc: Vec<String>,
    /// The inputs. [`Source::Input`] refers to their entries by one index that runs over all inputs in order.
    pub inputs: Vec<Input>,
    /// The outputs. The results of `core` are their entries, output by output.
    pub outputs: Vec<Output>,
    /// The program that computes the arguments of all sines and cosines: first those that are entries of inputs, in
    /// their order, then the other expressions. It loads inputs and fields.
    pub angles: Program,
    /// The program of the arithmetic. It loads inputs, fields, and the sines and cosines of the angles by their index.
    pub core: Program,
    /// The operations of `core` at a call after each pass, in the order in which the passes ran.
    pub passes: Vec<PassCounts>,
    /// The same function computed limb by limb, in lanes, if the robot has limbs that are alike.
    pub limbs: Option<Limbs>,
}

/// Prints the inputs with their lengths, the programs, and the values of `core` that are the outputs.
impl Display for Function {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let inputs = self.inputs.iter();
        let inputs = inputs.map(|input| format!("{}[{}]", input.name, input.symbols.len()));
        let inputs: Vec<String> = inputs.collect();
        writeln!(formatter, "function {}({})", self.name, inputs.join(", "))?;
        if !self.angles.results().is_empty() {
            writeln!(formatter, "\nangles:\n{}", self.angles)?;
        }
        writeln!(formatter, "core:\n{}", self.core)?;
        let mut results = self.core.results().iter();
        for output in &self.outputs {
            let values: Vec<String> =
                results.by_ref().take(output.len()).map(ToString::to_string).collect();
            writeln!(formatter, "{}{:?} = {}", output.name, output.shape, values.join(", "))?;
        }
        Ok(())
    }
}

impl Module {
    /// Compiles a specification: checks it, lowers the expressions, runs the passes and moves the operations that
    /// depend only on parameters into the constructor.
    ///
    /// # Errors
    ///
    /// All errors in the specification.
    pub fn compile(spec: &ModuleSpec<'_>, options: &Options) -> Result<Module, Errors> {
        let lowered = lower::lower(spec)?;
        let mut functions = vec![];
        for (function, lowered) in spec.functions.iter().zip(lowered) {
            let (core, report) = passes::run(&lowered.core, &lowered.angles, options);
            functions.push(Function {
                name: function.name.clone(),
                doc: function.doc.clone(),
                inputs: function.inputs.clone(),
                outputs: function.outputs.iter().map(Output::described).collect(),
                angles: passes::tidy(&lowered.angles),
                core,
                passes: report,
                limbs: None,
            });
        }
        let programs = functions.iter_mut().flat_map(|function| {
            let Function { angles, core, .. } = function;
            [angles, core]
        });
        let constructor = stage::hoist_parameters(programs);
        for function in &mut functions {
            let (core, report) = passes::finish(&function.core, options);
            function.core = core;
            function.passes.extend(report);
        }
        Ok(Module {
            name: spec.name.clone(),
            doc: spec.doc.clone(),
            parameters: spec.parameters.clone(),
            constructor: passes::tidy(&constructor),
            functions,
        })
    }

    /// Returns the function with a name.
    #[must_use]
    pub fn function(&self, name: &str) -> Option<&Function> {
        self.functions.iter().find(|function| function.name == name)
    }

    /// Returns the index of the parameter that a field of the model is a copy of, if it is one.
    #[must_use]
    pub fn field_parameter(&self, field: usize) -> Option<usize> {
        use crate::program::Operation;
        match self.constructor.operation(*self.constructor.results().get(field)?) {
            Operation::Load(Source::Parameter(index)) => Some(index as usize),
            _ => None,
        }
    }

    /// Counts the operations of one call of a function, and those of the part of the constructor that it needs.
    #[must_use]
    pub fn counts(&self, function: &Function) -> FunctionCounts {
        FunctionCounts::new(&self.constructor, function)
    }

    /// Counts the operations of the constructor of the whole module.
    #[must_use]
    pub fn constructor_counts(&self) -> Counts {
        Counts::of(&self.constructor)
    }
}
