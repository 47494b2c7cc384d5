//! The specification of code: named expressions over named inputs and parameters.
//!
//! Documentation is Markdown from the caller and is not escaped. The caller must pass text that it does not
//! control, such as a remark in a robot file, through [`markdown`](crate::backend::common::markdown) before adding it
//! to the documentation. Names, units and the documentation of parameters can be text from a robot file; they are
//! escaped when they are printed.

pub use robot_symbolic::named::{Function, Input, Output};

/// A module: parameters and functions, whose expressions all belong to one [`robot_symbolic::Graph`].
///
/// All functions share a graph, so that values that depend only on parameters are computed once for
/// the whole module.
#[derive(Clone, Debug)]
pub struct ModuleSpec<'g> {
    /// The name, which a backend turns into an identifier.
    pub name: String,
    /// The documentation in Markdown; each entry is a paragraph or a line.
    pub doc: Vec<String>,
    /// The parameters, in the order in which the code lists them.
    pub parameters: Vec<ParameterSpec>,
    /// The functions, in the order in which the code lists them.
    pub functions: Vec<Function<'g>>,
}

/// A parameter: a symbol that is given once, before any call.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterSpec {
    /// The symbol.
    pub name: String,
    /// The meaning of the parameter; plain text, not Markdown.
    pub doc: String,
    /// Its unit; empty if it has none.
    pub unit: String,
    /// The value that is used if no other is given.
    pub nominal: Option<f64>,
}
