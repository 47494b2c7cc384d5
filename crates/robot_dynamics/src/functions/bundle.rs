//! Several functions in one call that compute common expressions once.

use robot_model::functions::{Bundle, FunctionKind};

use super::{Derivation, Function, Input, Output, sharing};

impl<'g> Derivation<'_, 'g> {
    /// Derives the functions of a bundle as one function. Common expressions are computed once, and if it needs fewer
    /// operations, one function is computed from others, for example τ = M q̈ + C q̇ + g.
    ///
    /// An output that is the only one of its function has the name of the function. If a function has several outputs,
    /// they keep their names; if two functions have outputs with the same name, the name of the function precedes it.
    #[must_use]
    pub fn bundle(&self, bundle: &Bundle) -> Function<'g> {
        // Either all functions use the same plan, or each uses its own; in the latter case, they share fewer
        // expressions.
        let under_one = self.cheapest_plan(&bundle.functions, |derivation| {
            derivation.shared(bundle, |kind| derivation.acting(kind))
        });
        let apart = self.shared(bundle, |kind| self.functions(kind));
        let is_cheaper = self.cost(&apart) < self.cost(&under_one);
        let functions = if is_cheaper { apart } else { under_one };
        let names: Vec<String> =
            functions.iter().map(|function| format!("`{}`", function.name)).collect();
        let mut doc = vec![format!(
            "Computes several functions in one call that shares their work: {}. Each output is \
             that of the function of its name.",
            names.join(", ")
        )];
        let mut inputs: Vec<Input> = vec![];
        for function in &functions {
            let paragraphs =
                function.doc.iter().enumerate().map(|(index, paragraph)| match index {
                    0 => format!("`{}`: {paragraph}", function.name),
                    _ => paragraph.clone(),
                });
            doc.extend(paragraphs);
            for input in &function.inputs {
                if inputs.iter().all(|known| known.name != input.name) {
                    inputs.push(input.clone());
                }
            }
        }
        let outputs = outputs(functions);
        Function { name: bundle.name.clone(), doc, inputs, outputs }
    }

    /// The functions of a bundle, each derived by `derive` or computed from the others.
    fn shared(
        &self,
        bundle: &Bundle,
        derive: impl Fn(FunctionKind) -> Vec<Function<'g>>,
    ) -> Vec<Function<'g>> {
        let mut functions: Vec<Function<'g>> =
            bundle.functions.iter().flat_map(|kind| derive(*kind)).collect();
        sharing::share(self, &mut functions);
        functions
    }
}

/// The outputs of several functions, with distinct names.
fn outputs(functions: Vec<Function<'_>>) -> Vec<Output<'_>> {
    let names: Vec<String> = functions.iter().flat_map(own_names).collect();
    let is_shared = |name: &String| names.iter().filter(|other| *other == name).count() > 1;
    let mut outputs = vec![];
    for function in functions {
        for (name, output) in own_names(&function).into_iter().zip(function.outputs) {
            let name = if is_shared(&name) { format!("{}_{name}", function.name) } else { name };
            let doc = format!("Of `{}`: {}", function.name, output.doc);
            outputs.push(Output { name, doc, ..output });
        }
    }
    outputs
}

/// The names of a function's outputs in a bundle, before they are made distinct.
fn own_names(function: &Function<'_>) -> Vec<String> {
    match function.outputs.as_slice() {
        [_] => vec![function.name.clone()],
        several => several.iter().map(|output| output.name.clone()).collect(),
    }
}
