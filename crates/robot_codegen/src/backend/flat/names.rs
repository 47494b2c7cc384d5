//! The names in a tree, of its functions and of their variables.

use crate::backend::Language;
use crate::backend::common::{Namer, Setter, angle_names, field_names, symbols};
use crate::module::{Function, Module};
use crate::program::Source;

/// Names that a printer uses itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct Taken<'n> {
    /// Names beside the functions and within them.
    pub scope: &'n [&'n str],
    /// Names of macros, which nothing in the text can have.
    pub macros: &'n [&'n str],
}

impl<'n> Taken<'n> {
    /// Names in a language without macros.
    #[must_use]
    pub fn of(scope: &'n [&'n str]) -> Taken<'n> {
        Taken { scope, macros: &[] }
    }

    /// A namer in a language, whose scope has these names.
    pub(super) fn namer(self, language: &Language) -> Namer {
        Namer::new(language.reserved, &[self.scope, self.macros].concat())
    }
}

/// The names of a module in a language.
pub(super) struct Names {
    pub(super) module: String,
    pub(super) parameters: Vec<String>,
    pub(super) fields: Vec<String>,
    pub(super) setters: Vec<String>,
    pub(super) functions: Vec<String>,
    /// For each function, the names of its additional forms.
    pub(super) forms: Vec<Vec<String>>,
    /// The namer of the other items next to the functions.
    pub(super) items: Namer,
}

impl Names {
    /// Makes the names of a module; none of its items has a name that is taken.
    pub(super) fn new(
        module: &Module,
        language: &Language,
        taken: Taken<'_>,
        forms: &[&str],
        setters: &[Setter],
    ) -> Names {
        let mut items = taken.namer(language);
        let members = || Taken { scope: &[], ..taken }.namer(language);
        let setters = setters.iter().map(|setter| items.name(&setter.name)).collect();
        let functions = module.functions.iter().map(|function| function.name.as_str());
        let functions = items.names(functions);
        let forms = functions.iter().map(|function| {
            let forms = forms.iter().map(|form| items.name(&format!("{function}_{form}")));
            forms.collect()
        });
        let forms = forms.collect();
        Names {
            module: language.module_name(&module.name),
            parameters: members().names(module.parameters.iter().map(|one| one.name.as_str())),
            fields: field_names(module, &mut members()),
            setters,
            functions,
            forms,
            items,
        }
    }
}

/// The variables that the loads of a function read, and the arrays of its inputs and outputs.
pub(super) struct Variables {
    pub(super) inputs: Vec<String>,
    pub(super) outputs: Vec<String>,
    entries: Vec<String>,
    pub(super) sines: Vec<String>,
    pub(super) cosines: Vec<String>,
}

impl Variables {
    pub(super) fn new(function: &Function, namer: &mut Namer) -> Variables {
        let inputs = function.inputs.iter().map(|input| input.name.as_str());
        let outputs = function.outputs.iter().map(|output| output.name.as_str());
        let inputs = namer.names(inputs);
        let outputs = namer.names(outputs);
        let entries = namer.names(symbols(function));
        let angles = angle_names(function);
        let mut prefixed = |prefix: &str| {
            let names = angles.iter();
            names.map(|angle| namer.name(&format!("{prefix}{angle}"))).collect()
        };
        let (sines, cosines) = (prefixed("s"), prefixed("c"));
        Variables { inputs, outputs, entries, sines, cosines }
    }

    /// Returns the variable that a load of the function reads.
    pub(super) fn name(&self, source: Source) -> Option<&str> {
        let (names, index) = match source {
            Source::Input(index) => (&self.entries, index),
            Source::Sin(index) => (&self.sines, index),
            Source::Cos(index) => (&self.cosines, index),
            Source::Field(_) | Source::Parameter(_) => return None,
        };
        names.get(index as usize).map(String::as_str)
    }
}
