//! Named expressions: functions of named inputs, as they are derived, compiled and printed.
//!
//! One set of types goes all the way: what derives a robot fills [`Function`]s, a compiler takes them, and what
//! it makes of them keeps their [`Input`]s and, without the expressions, their [`Output`]s.

use crate::expr::Expr;

/// A function: inputs, and outputs computed from them and from symbols that are given once.
#[derive(Clone, Debug)]
pub struct Function<'g> {
    /// Its name.
    pub name: String,
    /// What it computes, in Markdown, a paragraph each: conventions, frames, source.
    pub doc: Vec<String>,
    /// The inputs, in the order of the call.
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
    /// Its unit, in words if the entries differ; empty if it has none.
    pub unit: String,
    /// The symbol of each entry.
    pub symbols: Vec<String>,
}

/// An output: a scalar, a vector or a matrix; `V` is its entries, or nothing once they are part of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output<V = ()> {
    /// The name of the array.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// Its unit, in words if the entries differ; empty if it has none.
    pub unit: String,
    /// `[]` for a scalar, `[n]` for a vector, `[rows, columns]` for a matrix.
    pub shape: Vec<usize>,
    /// The entries, row by row.
    pub values: V,
}

impl<V> Output<V> {
    /// The output with these entries.
    #[must_use]
    pub fn new(name: &str, doc: &str, unit: &str, shape: Vec<usize>, values: V) -> Output<V> {
        Output { name: name.to_owned(), doc: doc.to_owned(), unit: unit.to_owned(), shape, values }
    }

    /// The output without its entries.
    #[must_use]
    pub fn described(&self) -> Output {
        Output::new(&self.name, &self.doc, &self.unit, self.shape.clone(), ())
    }

    /// The number of entries that the shape has.
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
