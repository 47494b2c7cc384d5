//! The specification of code: named expressions over named inputs and parameters.
//!
//! Documentation is Markdown of the caller's own, printed as it is: text that the caller does not control, a
//! remark of a robot file, goes through [`markdown`](crate::backend::common::markdown) before it becomes part of
//! it. The documentation of parameters alone is text of such a file, and names and units are: they are made
//! harmless where they are printed.

pub use robot_symbolic::named::{Function, Input, Output};

/// A module: parameters and the functions of them, all over one [`robot_symbolic::Graph`].
///
/// One graph for all functions means that what depends on parameters alone is computed once for
/// the whole module.
#[derive(Clone, Debug)]
pub struct ModuleSpec<'g> {
    /// The name; a backend makes an identifier of it.
    pub name: String,
    /// Documentation in Markdown, a paragraph or line each.
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
    /// Its meaning; text, not Markdown.
    pub doc: String,
    /// Its unit; empty if it has none.
    pub unit: String,
    /// The value if none other is given.
    pub nominal: Option<f64>,
}
