//! Matrices among the results of a loop over states.
//!
//! LLVM vectorizes such a loop only if it can prove that no result is an input of another state, and if it tracks
//! every entry separately, which it does for up to about 250 of them. Otherwise a state takes five to ten times as
//! long. Therefore inputs are copied before the loop, entries are stored one by one, except those that are always 0,
//! and several loops store more entries than one can.

use proc_macro2::Ident;
use syn::{Pat, Stmt, parse_quote};

use super::batch::{Layout, Slices};
use super::function::Methods;
use super::outputs;
use super::syntax;
use crate::module::Output;
use crate::program::Operation;

/// The most entries that a loop stores. LLVM joins the sets of memory that may overlap once it has 250 of them, and
/// then no longer knows that the stores are independent. Entries that would need more than [`MAX_LOOPS`] loops are stored
/// by a single one.
const MAX_ENTRIES: usize = 240;

/// The most loops for one function: each computes again what the entries of several loops have in common.
const MAX_LOOPS: usize = 4;

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

    /// Whether each entry of the outputs is something other than the constant 0.
    fn not_zero(&self) -> Vec<bool> {
        let core = &self.function.core;
        let is_stored = core.results().iter().map(|value| match core.operation(*value) {
            Operation::Constant(constant) => constant.get().to_bits() != 0,
            _ => true,
        });
        is_stored.collect()
    }

    /// Whether [`entries`](Self::entries) stores entries of each output.
    pub(super) fn has_entries(&self) -> Vec<bool> {
        let mut stored = self.not_zero().into_iter();
        let of_output =
            |length| stored.by_ref().take(length).filter(|is_stored| *is_stored).count() > 0;
        self.function.outputs.iter().map(Output::len).map(of_output).collect()
    }

    /// Makes the statements that store the entries of all outputs in lane `lane`, except those that are always 0, in a
    /// group for each loop.
    pub(super) fn entries(&self, slices: &Slices) -> Vec<Vec<Stmt>> {
        let stored = self.not_zero();
        let count = stored.iter().filter(|is_stored| **is_stored).count();
        let loops = count.div_ceil(MAX_ENTRIES);
        let loops = if loops > MAX_LOOPS { 1 } else { loops.max(1) };
        let size = count.div_ceil(loops);
        let groups = (0..loops).map(|group| {
            let mut place = 0..;
            let of_group = stored.iter().map(|is_stored| {
                *is_stored && place.next().is_some_and(|place| place / size.max(1) == group)
            });
            self.stored(slices, &of_group.collect::<Vec<_>>())
        });
        groups.collect()
    }

    /// The statements that store some of the entries.
    fn stored(&self, slices: &Slices, chosen: &[bool]) -> Vec<Stmt> {
        let runtime = self.number.runtime();
        let mut chosen = chosen.iter();
        let mut namer = slices.variables.namer.clone();
        let mut statements = vec![];
        let values = outputs::of_result(self.scope, self.function);
        let outputs = self.function.outputs.iter().zip(slices.output_names()).zip(values);
        for ((output, name), value) in outputs {
            let chosen = chosen.by_ref().take(output.len());
            let stored =
                chosen.map(|is_chosen| is_chosen.then(|| (namer.name("from"), namer.name("to"))));
            let stored: Vec<Option<(Ident, Ident)>> = stored.collect();
            if stored.iter().all(Option::is_none) {
                continue;
            }
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
