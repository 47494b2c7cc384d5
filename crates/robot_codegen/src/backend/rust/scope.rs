//! The names of a module and what every printer of its items needs.

use proc_macro2::Ident;

use super::namer::{Namer, type_name};
use super::number::Number;
use super::options::{RustOptions, Scalar};
use crate::error::{Error, Errors};
use crate::module::{Function, Module};
use crate::program::{Operation, Program, Source};

/// The names of a module.
pub(super) struct Scope<'a> {
    pub(super) module: &'a Module,
    pub(super) options: &'a RustOptions,
    /// The number type of the functions.
    pub(super) number: Number,
    /// The number type of the constructor.
    pub(super) constructor_number: Number,
    /// The constants that the caller adds.
    pub(super) constants: Vec<Ident>,
    /// The fields of `Parameters`.
    pub(super) parameters: Vec<Ident>,
    /// The fields of `Model`.
    pub(super) fields: Vec<Ident>,
    /// For each function with several outputs, the type that holds them.
    output_types: Vec<Option<Ident>>,
    /// What variables must not be called: a pattern would mean the constant or type.
    values: Namer,
    /// The functions of the module.
    pub(super) methods: Namer,
}

fn runtime_path(path: &str) -> Result<syn::Path, Error> {
    syn::parse_str(path).map_err(|_| Error::RuntimePath { path: path.to_owned() })
}

/// Checks a path of the runtime, such as `::robot_runtime`, as generated code shall name it.
///
/// # Errors
///
/// A text that is not a path of Rust.
pub fn check_runtime_path(path: &str) -> Result<(), Error> {
    runtime_path(path).map(drop)
}

impl<'a> Scope<'a> {
    pub(super) fn new(module: &'a Module, options: &'a RustOptions) -> Result<Scope<'a>, Errors> {
        let runtime = runtime_path(&options.runtime)?;
        if options.scalar == Scalar::F32 {
            check_single_precision(module)?;
        }
        let mut values = Namer::with(&["Model", "Parameters", "T"]);
        let constants = options.constants.iter();
        let constants = constants.map(|item| values.name(&item.name.to_uppercase())).collect();
        let output_type = |function: &Function| {
            (function.outputs.len() > 1).then(|| values.name(&type_name(&function.name)))
        };
        let output_types = module.functions.iter().map(output_type).collect();
        let mut parameter_namer = Namer::default();
        let parameters = module.parameters.iter();
        let parameters =
            parameters.map(|parameter| parameter_namer.name(&parameter.name)).collect();
        let number = Number::scalar(options.scalar, &runtime, options.trigonometry);
        Ok(Scope {
            module,
            options,
            constructor_number: Number::scalar(Scalar::F64, &runtime, options.trigonometry),
            number,
            constants,
            parameters,
            fields: field_names(module),
            output_types,
            values,
            methods: Namer::with(&["new"]),
        })
    }

    /// A namer for the variables of a function.
    pub(super) fn variables(&self) -> Namer {
        self.values.clone()
    }

    /// The type that holds the outputs of a function with several.
    pub(super) fn output_type(&self, function: &Function) -> Option<Ident> {
        let mut functions = self.module.functions.iter();
        let index = functions.position(|known| known.name == function.name)?;
        self.output_types[index].clone()
    }

    /// Whether the module's model exists without parameters being given.
    pub(super) fn has_parameters(&self) -> bool {
        !self.module.parameters.is_empty()
    }
}

/// A field that copies a parameter has its name; the others are numbered.
fn field_names(module: &Module) -> Vec<Ident> {
    let mut namer = Namer::default();
    let fields = 0..module.constructor.results().len();
    // Copies first, so that none of them has to give way to a number.
    let copies: Vec<Option<Ident>> = fields
        .map(|field| module.field_parameter(field).map(|parameter| namer.name(&parameter.name)))
        .collect();
    let mut count = 0;
    let name = |copy: Option<Ident>| {
        copy.unwrap_or_else(|| {
            count += 1;
            namer.name(&format!("k{count}"))
        })
    };
    copies.into_iter().map(name).collect()
}

fn check_single_precision(module: &Module) -> Result<(), Errors> {
    let mut errors = vec![];
    let mut check = |program: &Program, place: &str| {
        for operation in program.operations() {
            if let Operation::Constant(constant) = operation
                && (constant.get() as f32).is_infinite()
            {
                errors.push(Error::BeyondSinglePrecision {
                    value: format!("{:e}", constant.get()),
                    place: place.to_owned(),
                });
            }
        }
    };
    for function in &module.functions {
        let place = format!("function `{}`", function.name);
        check(&function.angles, &place);
        check(&function.core, &place);
    }
    Errors::check(errors, ())
}

/// Where the sources of a function stand: `(input, entry)`.
pub(super) fn input_entry(function: &Function, index: u32) -> (usize, usize) {
    let mut rest = index as usize;
    for (input, spec) in function.inputs.iter().enumerate() {
        if rest < spec.symbols.len() {
            return (input, rest);
        }
        rest -= spec.symbols.len();
    }
    (function.inputs.len(), rest)
}

/// Which inputs a program reads.
pub(super) fn used_inputs(function: &Function, program: &Program) -> Vec<bool> {
    let mut used = vec![false; function.inputs.len()];
    for source in program.sources() {
        if let Source::Input(index) = source
            && let Some(used) = used.get_mut(input_entry(function, index).0)
        {
            *used = true;
        }
    }
    used
}
