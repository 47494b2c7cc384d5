//! Tables with headings that screen readers recognize.

use robot_document::markup::{Element, Node, element, holding};

/// A table with its caption, columns and rows. The first cell of each row is its heading.
pub(crate) struct Table {
    caption: String,
    columns: Vec<Node>,
    rows: Vec<Element>,
    /// Whether phones show each row as a block in which each value follows its column's name.
    is_stacked: bool,
}

impl Table {
    /// Creates a table without rows.
    pub(crate) fn new<C: Into<Node>>(caption: &str, columns: impl IntoIterator<Item = C>) -> Table {
        let columns = columns.into_iter().map(Into::into).collect();
        Table { caption: caption.to_owned(), columns, rows: vec![], is_stacked: false }
    }

    /// Creates a table without rows whose rows are blocks on phones, because it is too wide for them.
    pub(crate) fn stacked<C: Into<Node>>(
        caption: &str,
        columns: impl IntoIterator<Item = C>,
    ) -> Table {
        Table { is_stacked: true, ..Table::new(caption, columns) }
    }

    /// Adds a row; `parts` are the tokens of its subject, see [`crate::parts`].
    pub(crate) fn row<C: Into<Node>>(
        &mut self,
        parts: &str,
        heading: impl Into<Node>,
        cells: impl IntoIterator<Item = C>,
    ) {
        let heading = holding("th", heading).attribute("scope", "row");
        let names = self.columns.iter().skip(1);
        let cells = cells.into_iter().zip(names).map(|(cell, name)| match name {
            Node::Text(name) if self.is_stacked => {
                cell_of(cell.into()).attribute("data-name", name.as_str())
            }
            _ => cell_of(cell.into()),
        });
        let row = element("tr").with(heading).with_all(cells);
        self.rows.push(if parts.is_empty() { row } else { row.attribute("data-is", parts) });
    }

    /// Makes the element of the table, in a box that scrolls sideways if the table is too wide.
    pub(crate) fn build(self) -> Element {
        let headings =
            self.columns.into_iter().map(|column| holding("th", column).attribute("scope", "col"));
        let table = element("table");
        let table = if self.is_stacked { table.class("stacked") } else { table };
        let table = table
            .with(holding("caption", holding("span", self.caption.as_str())))
            .with(holding("thead", element("tr").with_all(headings)))
            .with(element("tbody").with_all(self.rows));
        // The box can get the focus, so that the keyboard can scroll it.
        element("div")
            .class("wide")
            .attribute("tabindex", "0")
            .attribute("role", "region")
            .attribute("aria-label", self.caption)
            .with(table)
    }
}

/// The largest number of characters of a short cell. Longer ones are sentences, which keep a readable width on narrow
/// screens.
const WORDS: usize = 24;

fn cell_of(cell: Node) -> Element {
    let is_long = matches!(&cell, Node::Text(text) if text.chars().count() > WORDS);
    let cell = holding("td", cell);
    if is_long { cell.class("words") } else { cell }
}
