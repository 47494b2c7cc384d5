//! A document in no notation.

use crate::figure::Figure;
use crate::forms::Equation;
use crate::math::Math;

/// A document.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// The title.
    pub title: String,
    /// Its blocks, in order.
    pub blocks: Vec<Block>,
}

/// A part of a document.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A heading of a section (level 1) or of a part of one (level 2).
    Heading(u8, String),
    /// A paragraph.
    Paragraph(Vec<Inline>),
    /// A table with a caption.
    Table(Table),
    /// A drawing with a caption.
    Figure(Figure),
    /// Displayed equations, one below the other.
    Equations(Vec<NumberedEquation>),
}

/// A table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Its content.
    pub caption: String,
    /// The heads of the columns.
    pub head: Vec<Cell>,
    /// The rows, a cell for each column.
    pub rows: Vec<Vec<Cell>>,
    /// How many of the first columns say what a row is about.
    pub keys: usize,
}

/// A cell of a table, a line of text.
pub type Cell = Vec<Inline>;

/// A displayed equation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NumberedEquation {
    /// The label by which text can refer to it: letters, digits, `-`, `:`; `None` for an equation
    /// without a number.
    pub label: Option<String>,
    /// The number of an equation with a label: that of a published text, or the next one.
    pub number: Option<String>,
    /// The equation.
    pub equation: Equation,
}

/// A piece of a line of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Inline {
    /// Text, as it is to be read.
    Text(String),
    /// Emphasized text.
    Emphasis(String),
    /// A formula within the line.
    Math(Math),
    /// The number of an equation, by its label.
    Reference(String),
}

impl Inline {
    /// Text.
    #[must_use]
    pub fn text(text: impl Into<String>) -> Inline {
        Inline::Text(text.into())
    }
}
