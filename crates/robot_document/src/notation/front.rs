//! What stands across both columns at the top of the first page: the title, the paragraphs before the first heading and
//! the tables that need the width of the page; floating tables could only stand on a later page, far from their text.
//! The other blocks follow in the columns.

use super::tabular::Placed;
use crate::document::{Block, Document, Inline, NumberedEquation};
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

/// The part of a document that stands across all columns, and the other blocks.
pub(super) struct Front<'d> {
    /// The paragraphs across the columns; none in a document of one column.
    pub(super) paragraphs: Vec<&'d [Inline]>,
    /// The tables across the columns.
    pub(super) tables: Vec<&'d Placed>,
    /// The other blocks, with all tables and figures.
    rest: &'d [Block],
    /// The tables of `rest`.
    all: &'d [Placed],
    /// The height, in pt.
    height: f64,
    /// Whether the front has pages of its own, before the columns.
    pub(super) is_long: bool,
}

/// A block below the front.
pub(super) enum Below<'d> {
    Heading(u8, &'d str),
    /// A paragraph, and whether it stays on the page of the table after it, as the heading before it does.
    Paragraph(&'d [Inline], bool),
    Table(&'d Placed),
    /// A figure with its scale, and whether it stands at the top of the next column that has room for it.
    Figure(&'d Figure, f64, bool),
    Equations(&'d [NumberedEquation]),
}

impl<'d> Front<'d> {
    /// The front of a document with these tables, for `columns` columns of a page that is `across` points wide.
    pub(super) fn new(
        document: &'d Document,
        tables: &'d [Placed],
        columns: u8,
        across: f64,
    ) -> Front<'d> {
        let paragraph = |block: &'d Block| match block {
            Block::Paragraph(inlines) => Some(inlines.as_slice()),
            _ => None,
        };
        let blocks = document.blocks.iter().take(if columns > 1 { usize::MAX } else { 0 });
        let paragraphs: Vec<&[Inline]> = blocks.map_while(paragraph).collect();
        let rest = document.blocks.get(paragraphs.len()..).unwrap_or_default();
        let spanning: Vec<&Placed> = tables.iter().filter(|table| table.spans).collect();
        let text = paragraphs.iter().map(|one| (wide(one) / across).ceil() + 0.5).sum::<f64>();
        let rows = spanning.iter().map(|table| table.lines(across)).sum::<f64>();
        let height = (TITLE + text + rows) * LINE;
        Front { paragraphs, tables: spanning, rest, all: tables, height, is_long: rows > MOST }
    }

    /// The blocks below the front, in columns of `column` points.
    pub(super) fn below(&self, column: f64) -> impl Iterator<Item = Below<'d>> {
        let mut tables = self.all.iter();
        let one = move |(place, block): (usize, &'d Block)| match block {
            Block::Heading(level, title) => Some(Below::Heading(*level, title)),
            Block::Paragraph(inlines) => Some(Below::Paragraph(inlines, self.is_kept(place))),
            Block::Table(_) => tables.next().filter(|table| !table.spans).map(Below::Table),
            Block::Figure(figure) => {
                let (scale, floats) = self.scale(figure, column);
                Some(Below::Figure(figure, scale, floats))
            }
            Block::Equations(list) => Some(Below::Equations(list)),
        };
        self.rest.iter().enumerate().filter_map(one)
    }

    /// Whether the paragraph at this place belongs to a heading above it and a table below it, with nothing else
    /// between them.
    fn is_kept(&self, place: usize) -> bool {
        let is_other = |block: &&Block| !matches!(block, Block::Paragraph(_));
        let (above, below) = self.rest.split_at_checked(place).unwrap_or_default();
        matches!(above.iter().rev().find(is_other), Some(Block::Heading(..)))
            && matches!(below.iter().find(is_other), Some(Block::Table(_)))
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

    /// The scale of a figure in a column of `column` points, which is reduced so that it fits below the tables, and
    /// whether it floats, because it would become too small.
    fn scale(&self, figure: &Figure, column: f64) -> (f64, bool) {
        let usual = figure.scale(column);
        let room = self.room(figure, column);
        let floats = self.is_above() && room < SMALLEST * usual;
        (if self.is_above() && !floats { usual.min(room) } else { usual }, floats)
    }
}

/// The width of a paragraph on one line, in pt.
fn wide(inlines: &[Inline]) -> f64 {
    let one = |inline: &Inline| match inline {
        Inline::Text(text) | Inline::Emphasis(text) => text_width(text),
        Inline::Math(math) => width(math),
        Inline::Reference(_) => 2.0 * LINE,
    };
    inlines.iter().map(one).sum()
}
