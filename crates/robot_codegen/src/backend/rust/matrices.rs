//! Matrices among the results of a loop over states.
//!
//! LLVM vectorizes such a loop only if it can prove that no result is an input of another state, and if it tracks
//! every entry separately, which it does for up to about 250 of them. Otherwise a state takes five to ten times as
//! long. Therefore inputs are copied before the loop, and entries are stored one by one, except those that are always
//! 0.

use proc_macro2::Ident;
use syn::{Pat, Stmt, parse_quote};

use super::batch::{Layout, Slices};
use super::function::Methods;
use super::outputs;
use super::syntax;
use crate::program::Operation;

impl Methods<'_, '_> {
    /// Whether a result is a matrix and the loop is compiled for several processors.
    pub(super) fn has_matrices(&self) -> bool {
        self.dispatched && self.function.outputs.iter().any(|output| output.shape.len() > 1)
    }

    /// Copies the inputs that a loop over lanes needs, so that they cannot overlap its results.
    pub(super) fn copied(&self, slices: &Slices, layout: Layout) -> Vec<Stmt> {
        if layout == Layout::States || !self.has_matrices() {
            return vec![];
        }
        let copies = slices.used().flat_map(|name| -> [Stmt; 2] {
            [
                parse_quote!(let #name = #name.map(|numbers| *numbers);),
                parse_quote!(let #name = #name.each_ref();),
            ]
        });
        copies.collect()
    }

    /// Stores the entries of each output in lane `lane`, except those that are always 0.
    pub(super) fn entries(&self, slices: &Slices) -> Vec<Stmt> {
        let runtime = self.number.runtime();
        let core = &self.function.core;
        let mut results = core.results().iter();
        let mut namer = slices.variables.namer.clone();
        let mut statements = vec![];
        let values = outputs::of_result(self.scope, self.function);
        let outputs = self.function.outputs.iter().zip(slices.output_names()).zip(values);
        for ((output, name), value) in outputs {
            let results = results.by_ref().take(output.len());
            let stored = results.map(|value| match core.operation(*value) {
                Operation::Constant(constant) if constant.get().to_bits() == 0 => None,
                _ => Some((namer.name("from"), namer.name("to"))),
            });
            let stored: Vec<Option<(Ident, Ident)>> = stored.collect();
            let pattern = |of: fn(&(Ident, Ident)) -> &Ident| {
                let mut entries =
                    stored.iter().map(|pair| syntax::optional_binding(pair.as_ref().map(of)));
                shaped_pattern(&output.shape, &mut entries)
            };
            let (from, to) = (pattern(|pair| &pair.0), pattern(|pair| &pair.1));
            statements.push(parse_quote!(let #from = #value;));
            statements.push(parse_quote!(let #to = &mut #name;));
            statements.extend(stored.iter().flatten().map(|(from, to)| -> Stmt {
                parse_quote!(#runtime::State::set_lane(#from, #to, lane);)
            }));
        }
        statements
    }
}

/// Makes a pattern such as `[[a, b], [c, d]]` from the next entries.
fn shaped_pattern(shape: &[usize], entries: &mut dyn Iterator<Item = Pat>) -> Pat {
    match shape.split_first() {
        None => entries.next().unwrap_or_else(|| parse_quote!(_)),
        Some((length, inner)) => {
            let parts: Vec<Pat> = (0..*length).map(|_| shaped_pattern(inner, entries)).collect();
            syntax::array_pattern(parts)
        }
    }
}
