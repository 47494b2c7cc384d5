//! The inputs of a function and their entries.

use crate::module::Function;
use crate::program::{Operation, Program, Source};

/// Returns the place that the source `Input(index)` of a function reads: the index of the input and that of its entry.
#[must_use]
pub fn input_entry(function: &Function, index: u32) -> (usize, usize) {
    let mut rest = index as usize;
    for (input, spec) in function.inputs.iter().enumerate() {
        if rest < spec.symbols.len() {
            return (input, rest);
        }
        rest -= spec.symbols.len();
    }
    (function.inputs.len(), rest)
}

/// For each input of a function, whether `program`, one of its programs, reads an entry of the input.
#[must_use]
pub fn used_inputs(function: &Function, program: &Program) -> Vec<bool> {
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

/// The symbols of the entries of all inputs, in the order of the sources `Input(0)`, `Input(1)` and so on.
#[must_use]
pub fn symbols(function: &Function) -> Vec<&str> {
    let inputs = function.inputs.iter();
    inputs.flat_map(|input| &input.symbols).map(String::as_str).collect()
}

/// For each angle, the symbol if the angle is an entry of an input, otherwise the number of the angle, from 1.
#[must_use]
pub fn angle_names(function: &Function) -> Vec<String> {
    let symbols = symbols(function);
    let results = function.angles.results().iter().enumerate();
    let names = results.map(|(index, value)| match function.angles.operation(*value) {
        Operation::Load(Source::Input(input)) => symbols[input as usize].to_owned(),
        _ => (index + 1).to_string(),
    });
    names.collect()
}
