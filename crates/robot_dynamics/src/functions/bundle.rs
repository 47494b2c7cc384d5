//! Which functions are wanted: each by itself, and several in one call that shares their work.

use super::{Derivation, Function, FunctionKind, Input, Output, sharing};

/// Which functions are generated, each by itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Functions {
    /// The usual ones, where nothing else is said.
    #[default]
    Usual,
    /// All that the robot has.
    All,
    /// These; one that the robot lacks is an error.
    Chosen(Vec<FunctionKind>),
}

/// The word for all functions where functions are named.
pub const ALL_FUNCTIONS: &str = "all";

/// Functions in one call, whose common work is done once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// Its name: that of the function that is generated.
    pub name: String,
    /// Its functions, in the order of the outputs.
    pub functions: Vec<FunctionKind>,
}

impl Bundle {
    /// Whose name it is; `None` where a bundle can bear it.
    ///
    /// Beside the functions themselves there are their forms over sines, scalars and slices, a
    /// function for each frame, and what a module has anyhow. Names that differ in case or underscores
    /// alone are the same here, for the type that holds the outputs is named after the bundle.
    #[must_use]
    pub fn owner_of(name: &str) -> Option<&'static str> {
        const OF_MODULES: [&str; 4] = ["model", "new", "nominal", "withpayload"];
        const FORMS: [&str; 6] = ["_sc", "_angles", "_generic", "_batch", "_block", "_parallel"];
        let lower = name.to_lowercase();
        let folded = fold(name);
        if FunctionKind::ALL.iter().any(|kind| fold(kind.name()) == folded) {
            return Some("the name of a function");
        }
        if lower.starts_with("jacobian_") {
            return Some("a name of the functions of a frame");
        }
        if FORMS.iter().any(|form| lower.ends_with(form)) {
            return Some("a name of the forms of a function");
        }
        let taken = OF_MODULES.contains(&folded.as_str()) || folded == ALL_FUNCTIONS;
        taken.then_some("a name that code has for itself")
    }

    /// Whether two bundles would be confused: their names differ in case or underscores alone.
    #[must_use]
    pub fn is_alike(&self, other: &Bundle) -> bool {
        fold(&self.name) == fold(&other.name)
    }
}

fn fold(name: &str) -> String {
    name.replace('_', "").to_lowercase()
}

impl<'g> Derivation<'_, 'g> {
    /// Derives the functions of a bundle in one: expressions that they share are computed once, and
    /// where it is cheaper one function is made of others, such as τ = M q̈ + C q̇ + g.
    ///
    /// The output of a function that has one is named after the function. Of functions with several
    /// outputs each keeps its name; where two functions have the same, the function's name stands
    /// before it.
    #[must_use]
    pub fn bundle(&self, bundle: &Bundle) -> Function<'g> {
        let functions = bundle.functions.iter().flat_map(|kind| self.functions(*kind));
        let mut functions: Vec<Function<'g>> = functions.collect();
        sharing::share(self, &mut functions);
        let names: Vec<String> =
            functions.iter().map(|function| format!("`{}`", function.name)).collect();
        let mut doc = vec![format!(
            "In one call that shares their work: {}. Each is as the function of its name.",
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
}

/// The outputs of several functions under names of their own.
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

/// What the outputs of a function are called where there are those of others.
fn own_names(function: &Function<'_>) -> Vec<String> {
    match function.outputs.as_slice() {
        [_] => vec![function.name.clone()],
        several => several.iter().map(|output| output.name.clone()).collect(),
    }
}
