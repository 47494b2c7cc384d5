//! The names of a module's items, for code that calls them.

use super::LANGUAGE;
use super::namer::Namer;
use crate::backend::common::{ConstantItem, Setter};
use crate::module::{Function, Module};

/// The names of a module's items. A name that is reserved or taken is adapted, so code that calls the module must take
/// the names from here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names {
    /// The module.
    pub module: String,
    /// The fields of `Parameters`, one for each parameter.
    pub parameters: Vec<String>,
    /// The setters, in their order.
    pub setters: Vec<String>,
    /// The methods of `Model` that compute the functions, one for each function.
    pub functions: Vec<String>,
    /// The fields of `Model`.
    pub(super) fields: Vec<String>,
}

impl Names {
    /// Makes the names, and the namer for further functions of `Model`.
    pub(super) fn new(
        module: &Module,
        setters: &[Setter],
        constants: &[ConstantItem],
    ) -> (Names, Namer) {
        let parameters = module.parameters.iter().map(|parameter| parameter.name.as_str());
        // For a robot without parameters, `Model` is also a value. A call `model.into(…)` finds the method of the
        // prelude, which takes its receiver by value, before one that takes a reference; so does `try_into`.
        let taken = ["new", "new_lanes", "NOMINAL", "Model", "into", "try_into"];
        let mut methods = Namer::with(&taken);
        for constant in constants {
            methods.name(&constant.printed_name());
        }
        let setters = setters.iter().map(|setter| methods.name(&setter.name).to_string());
        let setters = setters.collect();
        let functions = module.functions.iter().map(|function| function.name.as_str());
        let names = Names {
            module: LANGUAGE.module_name(&module.name),
            parameters: strings(&mut Namer::default(), parameters),
            setters,
            functions: strings(&mut methods, functions),
            fields: Namer::default().fields(module),
        };
        (names, methods)
    }
}

/// Returns the names of the items of a module that is printed with these setters and constants.
#[must_use]
pub fn names(module: &Module, setters: &[Setter], constants: &[ConstantItem]) -> Names {
    Names::new(module, setters, constants).0
}

/// Returns the names of the fields of the type that holds a function's outputs, if it has several.
#[must_use]
pub fn output_names(function: &Function) -> Vec<String> {
    let outputs = function.outputs.iter().map(|output| output.name.as_str());
    strings(&mut Namer::default(), outputs)
}

fn strings<'t>(namer: &mut Namer, texts: impl Iterator<Item = &'t str>) -> Vec<String> {
    namer.names(texts).iter().map(ToString::to_string).collect()
}
