//! Tables with headings that screen readers find.

use robot_document::markup::{Element, Node, element, holding};

/// A table: what it shows, its columns, its rows. The first cell of a row is its heading.
pub(crate) struct Table {
    caption: String,
    columns: Vec<Node>,
    rows: Vec<Element>,
}

impl Table {
    /// A table without rows.
    pub(crate) fn new<C: Into<Node>>(caption: &str, columns: impl IntoIterator<Item = C>) -> Table {
        let columns = columns.into_iter().map(Into::into).collect();
        Table { caption: caption.to_owned(), columns, rows: vec![] }
    }

    /// One more row; `parts` are what of the robot it is about, see [`crate::parts`].
    pub(crate) fn row<C: Into<Node>>(
        &mut self,
        parts: &str,
        heading: impl Into<Node>,
        cells: impl IntoIterator<Item = C>,
    ) {
        let heading = holding("th", heading).attribute("scope", "row");
        let cells = cells.into_iter().map(|cell| cell_of(cell.into()));
        let row = element("tr").with(heading).with_all(cells);
        self.rows.push(if parts.is_empty() { row } else { row.attribute("data-is", parts) });
    }

    /// The table, in a box that scrolls sideways if it is too wide.
    pub(crate) fn build(self) -> Element {
        let headings =
            self.columns.into_iter().map(|column| holding("th", column).attribute("scope", "col"));
        let table = element("table")
            .with(holding("caption", holding("span", self.caption.as_str())))
            .with(holding("thead", element("tr").with_all(headings)))
            .with(element("tbody").with_all(self.rows));
        // The keyboard scrolls what has the focus.
        element("div")
            .class("wide")
            .attribute("tabindex", "0")
            .attribute("role", "region")
            .attribute("aria-label", self.caption)
            .with(table)
    }
}

/// Cells of more characters than this are sentences: on narrow screens they keep a width in which they read well.
const WORDS: usize = 24;

fn cell_of(cell: Node) -> Element {
    let is_long = matches!(&cell, Node::Text(text) if text.chars().count() > WORDS);
    let cell = holding("td", cell);
    if is_long { cell.class("words") } else { cell }
}
