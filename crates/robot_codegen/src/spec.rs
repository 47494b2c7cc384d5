//! The specification of code: named expressions over named inputs and parameters.
//!
//! Documentation is Markdown of the caller's own, printed as it is: text that the caller does not control, a
//! remark of a robot file, goes through [`markdown`](crate::backend::common::markdown) before it becomes part of
//! it. The documentation of parameters alone is text of such a file, and names and units are: they are made
//! harmless where they are printed.

use robot_symbolic::Expr;

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
    pub functions: Vec<FunctionSpec<'g>>,
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

/// A function: inputs, and outputs computed from them and the module's parameters.
#[derive(Clone, Debug)]
pub struct FunctionSpec<'g> {
    /// The name.
    pub name: String,
    /// Documentation in Markdown, a paragraph or line each.
    pub doc: Vec<String>,
    /// The inputs, arrays of symbols.
    pub inputs: Vec<InputSpec>,
    /// The outputs, arrays of expressions.
    pub outputs: Vec<OutputSpec<'g>>,
}

/// An input: an array of symbols, such as the joint positions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputSpec {
    /// The name of the array.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// Its unit; empty if it has none or the entries differ.
    pub unit: String,
    /// The symbols, one for each entry.
    pub symbols: Vec<String>,
}

/// An output: a scalar, a vector or a matrix of expressions.
#[derive(Clone, Debug)]
pub struct OutputSpec<'g> {
    /// The name.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// Its unit; empty if it has none or the entries differ.
    pub unit: String,
    /// `[]` for a scalar, `[n]` for a vector, `[rows, columns]` for a matrix.
    pub shape: Vec<usize>,
    /// The entries, row by row.
    pub values: Vec<Expr<'g>>,
}
