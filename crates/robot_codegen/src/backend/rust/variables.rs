//! The variables of a method, which its loads read, and the patterns that split arrays into variables.

use proc_macro2::Ident;
use syn::{Pat, Stmt, parse_quote};

use super::namer::Namer;
use super::scope::Scope;
use super::syntax;
use crate::backend::common::{angle_names, symbols, used_inputs};
use crate::module::Function;
use crate::program::{Program, Source};

/// The variables of a method.
pub(super) struct Variables {
    /// The namer for further variables.
    pub(super) namer: Namer,
    /// The arrays of the inputs.
    pub(super) inputs: Vec<Ident>,
    /// The entries of the inputs, all in one list.
    entries: Vec<Ident>,
    /// The array of sines.
    pub(super) sines: Ident,
    sine: Vec<Ident>,
    /// The array of cosines.
    pub(super) cosines: Ident,
    cosine: Vec<Ident>,
}

impl Variables {
    pub(super) fn new(scope: &Scope<'_>, function: &Function) -> Variables {
        let mut namer = scope.variables();
        let inputs = namer.names(function.inputs.iter().map(|input| input.name.as_str()));
        let (sines, cosines) = (namer.name("s"), namer.name("c"));
        let entries = namer.names(symbols(function));
        let angles = angle_names(function);
        let mut prefixed = |prefix: &str| {
            let names = angles.iter();
            names.map(|angle| namer.name(&format!("{prefix}{angle}"))).collect()
        };
        let (sine, cosine) = (prefixed("s"), prefixed("c"));
        Variables { namer, inputs, entries, sines, sine, cosines, cosine }
    }

    /// Returns the variable that a load reads, if it reads one.
    pub(super) fn name(&self, source: Source) -> Option<Ident> {
        let (names, index) = match source {
            Source::Input(index) => (&self.entries, index),
            Source::Sin(index) => (&self.sine, index),
            Source::Cos(index) => (&self.cosine, index),
            Source::Field(_) | Source::Parameter(_) => return None,
        };
        names.get(index as usize).cloned()
    }

    /// Returns the variables of the chosen inputs.
    pub(super) fn chosen(&self, choice: &[bool]) -> Vec<&Ident> {
        let inputs = self.inputs.iter().zip(choice);
        inputs.filter(|(_, chosen)| **chosen).map(|(input, _)| input).collect()
    }

    /// Makes `let [q1, _, q3] = *q;` for each input whose entries the program loads.
    pub(super) fn take_entries(&self, function: &Function, program: &Program) -> Vec<Stmt> {
        let sources = program.sources();
        let mut entries = self.entries.iter().zip(0..);
        let mut statements = vec![];
        let used = used_inputs(function, program);
        for ((input, array), used) in function.inputs.iter().zip(&self.inputs).zip(used) {
            let entries = entries.by_ref().take(input.symbols.len());
            let patterns: Vec<Pat> = entries
                .map(|(name, index)| pattern(name, &sources, Source::Input(index)))
                .collect();
            if used {
                statements.push(take(array, patterns));
            }
        }
        statements
    }

    /// Makes `let [q1, q2, q3, _] = *anywhere(q);` for the entries of a lane, for each chosen input.
    pub(super) fn take_lane(
        &self,
        function: &Function,
        choice: &[bool],
        of_lane: &[usize],
        runtime: &syn::Path,
    ) -> Vec<Stmt> {
        let mut entries = self.entries.iter().enumerate();
        let mut statements = vec![];
        for ((input, array), chosen) in function.inputs.iter().zip(&self.inputs).zip(choice) {
            let entries = entries.by_ref().take(input.symbols.len());
            let patterns = entries.map(|(index, name)| {
                syntax::optional_binding(of_lane.contains(&index).then_some(name))
            });
            let pattern = syntax::array_pattern(patterns.collect::<Vec<Pat>>());
            if *chosen {
                statements.push(parse_quote!(let #pattern = *#runtime::anywhere(#array);));
            }
        }
        statements
    }

    /// Makes `let [sq1, _] = *s;` and the same for the cosines.
    pub(super) fn take_angles(&self, program: &Program) -> [Stmt; 2] {
        let sources = program.sources();
        let sines = self.sine.iter().zip(0..);
        let sines = sines.map(|(name, index)| pattern(name, &sources, Source::Sin(index)));
        let cosines = self.cosine.iter().zip(0..);
        let cosines = cosines.map(|(name, index)| pattern(name, &sources, Source::Cos(index)));
        [take(&self.sines, sines.collect()), take(&self.cosines, cosines.collect())]
    }

    /// Makes the pattern `(sq1, cq1)` for each angle.
    pub(super) fn sines_and_cosines(&self, program: &Program) -> Vec<Pat> {
        let sources = program.sources();
        let pairs = self.sine.iter().zip(&self.cosine).zip(0..);
        let pairs = pairs.map(|((sine, cosine), index)| -> Pat {
            let sine = pattern(sine, &sources, Source::Sin(index));
            let cosine = pattern(cosine, &sources, Source::Cos(index));
            parse_quote!((#sine, #cosine))
        });
        pairs.collect()
    }

    /// Binds inputs that are not used to `_`, so that the compiler does not warn about unused variables.
    pub(super) fn ignore(&self, used: &[bool]) -> Vec<Stmt> {
        let unused: Vec<bool> = used.iter().map(|used| !used).collect();
        let inputs = self.chosen(&unused).into_iter();
        inputs.map(|input| parse_quote!(let [..] = *#input;)).collect()
    }
}

/// A name if the source is loaded, `_` if it is not.
fn pattern(name: &Ident, loaded: &[Source], source: Source) -> Pat {
    syntax::optional_binding(loaded.binary_search(&source).is_ok().then_some(name))
}

fn take(array: &Ident, patterns: Vec<Pat>) -> Stmt {
    syntax::binding_statement(syntax::array_pattern(patterns), parse_quote!(*#array))
}
