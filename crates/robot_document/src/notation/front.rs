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
/// The number of lines of the title.
const TITLE: f64 = 3.0;
/// The number of lines of the heading above a figure and of the spaces around it.
const AROUND: f64 = 5.0;
/// The smallest scale of a figure in a column below the tables, relative to its usual one.
const SMALLEST: f64 = 0.55;

/// The blocks of a document that stand across all columns, and the other ones.
pub(super) struct Front<'d> {
    /// The paragraphs across the columns; none in a document of one column.
    pub(super) paragraphs: &'d [Block],
    /// The tables across the columns.
    pub(super) tables: Vec<&'d Placed>,
    /// The figure with its scale, if it is too high for the columns below the tables.
    pub(super) figure: Option<(&'d Figure, f64)>,
    /// The other blocks, with all tables and figures.
    pub(super) rest: &'d [Block],
    /// The height, in pt.
    height: f64,
    /// Whether the front has pages of its own, before the columns.
    pub(super) is_long: bool,
}

impl<'d> Front<'d> {
    /// The front of a document with these tables, with columns of `column` points, together `across` points wide.
    pub(super) fn new(
        document: &'d Document,
        tables: &'d [Placed],
        columns: u8,
        [column, across]: [f64; 2],
    ) -> Front<'d> {
        let is_paragraph = |block: &Block| matches!(block, Block::Paragraph(_));
        let other = document.blocks.iter().position(|block| !is_paragraph(block));
        let end = if columns > 1 { other.unwrap_or(document.blocks.len()) } else { 0 };
        let (paragraphs, rest) = document.blocks.split_at(end);
        let tables: Vec<&Placed> = tables.iter().filter(|table| table.spans).collect();
        let text = paragraphs.iter().map(|block| (wide(block) / across).ceil() + 0.5).sum::<f64>();
        let rows = tables.iter().map(|table| table.lines(across)).sum::<f64>();
        let height = (TITLE + text + rows) * LINE;
        let mut front =
            Front { paragraphs, tables, figure: None, rest, height, is_long: rows > MOST };
        let figure = rest.iter().find_map(|block| match block {
            Block::Figure(figure) => Some(figure),
            _ => None,
        });
        if let Some(figure) = figure
            && front.is_above()
            && front.room(figure, column) < SMALLEST * figure.scale(column)
        {
            let [usual, room] = [figure.scale(across), front.room(figure, across)];
            front.figure = (room > SMALLEST * usual).then_some((figure, usual.min(room)));
            front.is_long = true;
        }
        front
    }

    /// Whether tables stand above columns.
    fn is_above(&self) -> bool {
        !self.tables.is_empty() && !self.is_long
    }

    /// The largest scale of a figure that fits below the tables with a caption of this width.
    fn room(&self, figure: &Figure, width: f64) -> f64 {
        let caption = (text_width(&figure.caption) / width).ceil() + 1.0;
        (PAGE - self.height - (caption + AROUND) * LINE) / figure.size()[1].max(1.0)
    }

    /// The scale of a figure in a column of `column` points, which is reduced so that it fits below the tables.
    pub(super) fn scale(&self, figure: &Figure, column: f64) -> f64 {
        let usual = figure.scale(column);
        if self.is_above() { usual.min(self.room(figure, column)) } else { usual }
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
