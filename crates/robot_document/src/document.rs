//! Documents that do not depend on a notation.

use crate::figure::Figure;
use crate::forms::Equation;
use crate::math::Math;

/// A document.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// The title.
    pub title: String,
    /// The blocks, in their order in the document.
    pub blocks: Vec<Block>,
}

impl Document {
    /// The number of equations with a label, which is the largest number of an equation.
    #[must_use]
    pub fn numbers(&self) -> usize {
        let lists = self.blocks.iter().filter_map(|block| match block {
            Block::Equations(list) => Some(list),
            _ => None,
        });
        lists.flatten().filter(|equation| equation.label.is_some()).count()
    }
}

/// A part of a document.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A heading: of a section (level 1) or of a part of a section (level 2).
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
    /// The caption.
    pub caption: String,
    /// The headings of the columns.
    pub head: Vec<Cell>,
    /// The rows, with one cell for each column.
    pub rows: Vec<Vec<Cell>>,
    /// The number of leading columns that identify a row.
    pub keys: usize,
}

/// A cell of a table, a line of text.
pub type Cell = Vec<Inline>;

/// A displayed equation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NumberedEquation {
    /// The label that text uses to refer to the equation: letters, digits, `-` and `:`. `None` for an equation without
    /// a number.
    pub label: Option<String>,
    /// The number of an equation with a label: the one in the published text, or the next one.
    pub number: Option<String>,
    /// The equation.
    pub equation: Equation,
}

/// A piece of a line of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Inline {
    /// Plain text, not markup.
    Text(String),
    /// Emphasized text.
    Emphasis(String),
    /// A formula within the line.
    Math(Math),
    /// The number of the equation with this label.
    Reference(String),
}

impl Inline {
    /// Creates a piece of plain text.
    #[must_use]
    pub fn text(text: impl Into<String>) -> Inline {
        Inline::Text(text.into())
    }
}
