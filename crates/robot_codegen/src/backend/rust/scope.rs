//! The names of a module and other data that all printers of its items need.

use proc_macro2::Ident;

use super::namer::{Namer, ident, type_name};
use super::names::Names;
use super::number::Number;
use super::options::RustOptions;
use crate::backend::common::{Scalar, check_range};
use crate::error::{Error, Errors};
use crate::module::{Function, Module};

/// The names of a module, its options and its number types.
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
    /// The setters.
    pub(super) setters: Vec<Ident>,
    /// The methods that compute the module's functions.
    pub(super) functions: Vec<Ident>,
    /// For each function with several outputs, the type that holds them.
    output_types: Vec<Option<Ident>>,
    /// The namer of variables, which must not have the names of constants and types: a pattern would refer to these.
    values: Namer,
    /// The namer of the functions of `Model`.
    pub(super) methods: Namer,
}

fn runtime_path(path: &str) -> Result<syn::Path, Error> {
    syn::parse_str(path).map_err(|_| Error::RuntimePath { path: path.to_owned() })
}

/// Checks a path of the runtime that generated code will use, such as `::robot_runtime`.
///
/// # Errors
///
/// The text is not a Rust path.
pub fn check_runtime_path(path: &str) -> Result<(), Error> {
    runtime_path(path).map(drop)
}

impl<'a> Scope<'a> {
    pub(super) fn new(module: &'a Module, options: &'a RustOptions) -> Result<Scope<'a>, Errors> {
        let runtime = runtime_path(&options.runtime)?;
        check_range(module, options.scalar)?;
        let mut values = Namer::with(&["Model", "Parameters", "T", "A", "Kernel"]);
        if options.generic {
            values.name("P");
        }
        let constants = options.constants.iter();
        let constants = constants.map(|item| values.name(&item.printed_name())).collect();
        let output_type = |function: &Function| {
            (function.outputs.len() > 1).then(|| values.name(&type_name(&function.name)))
        };
        let output_types = module.functions.iter().map(output_type).collect();
        let (names, methods) = Names::new(module, &options.setters, &options.constants);
        let idents = |names: &[String]| names.iter().map(|name| ident(name)).collect();
        let number = Number::scalar(options.scalar, &runtime, options.trigonometry);
        Ok(Scope {
            module,
            options,
            constructor_number: Number::scalar(Scalar::F64, &runtime, options.trigonometry),
            number,
            constants,
            parameters: idents(&names.parameters),
            fields: idents(&names.fields),
            setters: idents(&names.setters),
            functions: idents(&names.functions),
            output_types,
            values,
            methods,
        })
    }

    /// Makes a namer for the variables of a function.
    pub(super) fn variables(&self) -> Namer {
        self.values.clone()
    }

    /// The type that holds the outputs of a function, if it has several.
    pub(super) fn output_type(&self, function: &Function) -> Option<Ident> {
        let mut functions = self.module.functions.iter();
        let index = functions.position(|known| known.name == function.name)?;
        self.output_types[index].clone()
    }

    /// Whether the type of the model's fields is a parameter, that is, if there are fields and functions over any
    /// scalar.
    pub(super) fn has_own_fields(&self) -> bool {
        self.has_parameters() && self.options.generic
    }

    /// Whether the module has parameters.
    pub(super) fn has_parameters(&self) -> bool {
        !self.module.parameters.is_empty()
    }
}
