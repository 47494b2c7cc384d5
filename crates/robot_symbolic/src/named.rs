//! Named expressions: functions of named inputs, as they are derived, compiled and printed.
//!
//! All stages share these types: the derivation of a robot creates [`Function`]s, the compiler takes them, and the
//! compiled program keeps their [`Input`]s and, without the expressions, their [`Output`]s.

use crate::expr::Expr;

/// A function: its outputs are computed from its inputs and from symbols that are set only once.
#[derive(Clone, Debug)]
pub struct Function<'g> {
    /// The function's name.
    pub name: String,
    /// What the function computes, with its conventions, frames and source, in Markdown; one string per paragraph.
    pub doc: Vec<String>,
    /// The inputs, in the order of the arguments.
    pub inputs: Vec<Input>,
    /// The outputs.
    pub outputs: Vec<Output<Vec<Expr<'g>>>>,
}

/// An input: an array of symbols, such as the joint positions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// The name of the array.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// The unit, described in words if the entries have different units; empty if there is none.
    pub unit: String,
    /// The symbol of each entry.
    pub symbols: Vec<String>,
}

/// An output: a scalar, a vector or a matrix. `V` is the type of its entries, or `()` once they are part of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output<V = ()> {
    /// The name of the array.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// The unit, described in words if the entries have different units; empty if there is none.
    pub unit: String,
    /// `[]` for a scalar, `[n]` for a vector, `[rows, columns]` for a matrix.
    pub shape: Vec<usize>,
    /// The entries, row by row.
    pub values: V,
}

impl<V> Output<V> {
    /// Creates an output with these entries.
    #[must_use]
    pub fn new(name: &str, doc: &str, unit: &str, shape: Vec<usize>, values: V) -> Output<V> {
        Output { name: name.to_owned(), doc: doc.to_owned(), unit: unit.to_owned(), shape, values }
    }

    /// Returns the output without its entries.
    #[must_use]
    pub fn described(&self) -> Output {
        Output::new(&self.name, &self.doc, &self.unit, self.shape.clone(), ())
    }

    /// The number of entries according to the shape.
    #[must_use]
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Whether the shape has no entries.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
