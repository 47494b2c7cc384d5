//! What stands across both columns at the top of the first page: the title, the paragraphs before the first heading and
//! the tables that need the width of the page. Floats could only stand on a later page, far from their text.

use super::tabular::Placed;
use crate::document::{Block, Document, Inline};
use crate::figure::Figure;
use crate::width::{text_width, width};

/// The height of a line of text, and of the text of a page, in pt.
const LINE: f64 = 12.0;
const PAGE: f64 = 683.0;
/// The largest number of lines of tables above the columns of the first page.
const MOST: f64 = 38.0;
/// The lines of the title, of the heading above a figure and of the spaces beside a figure.
const TITLE: f64 = 3.0;
const AROUND: f64 = 6.0;
/// The smallest scale to which a figure is reduced so that it fits below the front, relative to its usual one.
const SMALLEST: f64 = 0.55;

/// The blocks of a document that stand across all columns, and the other ones.
pub(super) struct Front<'d> {
    /// The paragraphs across the columns; none in a document of one column.
    pub(super) paragraphs: &'d [Block],
    /// The tables across the columns.
    pub(super) tables: Vec<&'d Placed>,
    /// The other blocks, with all tables.
    pub(super) rest: &'d [Block],
    /// The height, in pt.
    height: f64,
}

impl<'d> Front<'d> {
    /// The front of a document with these tables, whose columns together are `across` points wide.
    pub(super) fn new(
        document: &'d Document,
        tables: &'d [Placed],
        columns: u8,
        across: f64,
    ) -> Front<'d> {
        let is_paragraph = |block: &Block| matches!(block, Block::Paragraph(_));
        let other = document.blocks.iter().position(|block| !is_paragraph(block));
        let end = if columns > 1 { other.unwrap_or(document.blocks.len()) } else { 0 };
        let (paragraphs, rest) = document.blocks.split_at(end);
        let tables: Vec<&Placed> = tables.iter().filter(|table| table.spans).collect();
        let text = paragraphs.iter().map(|block| (wide(block) / across).ceil() + 1.0).sum::<f64>();
        let lines = TITLE + text + tables.iter().map(|table| table.lines()).sum::<f64>();
        Front { paragraphs, tables, rest, height: lines * LINE }
    }

    /// Whether the front is too high to stand above columns.
    pub(super) fn is_long(&self) -> bool {
        self.tables.iter().map(|table| table.lines()).sum::<f64>() > MOST
    }

    /// The scale of a figure, which is reduced if it then fits below the front in a column of `column` points.
    pub(super) fn scale(&self, figure: &Figure, column: f64) -> f64 {
        let usual = figure.scale(column);
        if self.tables.is_empty() || self.is_long() {
            return usual;
        }
        let caption = (text_width(&figure.caption) / column).ceil() + 1.0;
        let room = PAGE - self.height - (caption + AROUND) * LINE;
        let reduced = room / figure.size()[1].max(1.0);
        if reduced < SMALLEST * usual { usual } else { usual.min(reduced) }
    }
}

/// The width of a paragraph on one line, in pt.
fn wide(block: &Block) -> f64 {
    let Block::Paragraph(inlines) = block else { return 0.0 };
    let one = |inline: &Inline| match inline {
        Inline::Text(text) | Inline::Emphasis(text) => text_width(text),
        Inline::Math(math) => width(math),
        Inline::Reference(_) => 2.0 * LINE,
    };
    inlines.iter().map(one).sum()
}
