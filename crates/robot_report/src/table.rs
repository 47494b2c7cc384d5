//! Tables with headings that screen readers recognize. Columns in which all cells are empty are omitted.

use robot_document::markup::{Element, Node, element, holding};

/// A table with its caption, columns and rows. The first cell of each row is its heading.
pub(crate) struct Table {
    caption: String,
    columns: Vec<Node>,
    rows: Vec<Row>,
    /// Whether phones show each row as a block in which each value follows its column's name.
    is_stacked: bool,
}

/// A row of a table.
struct Row {
    /// The tokens of the row's subject.
    parts: String,
    /// The heading, then the cells of the other columns.
    cells: Vec<Node>,
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
        let cells = std::iter::once(heading.into()).chain(cells.into_iter().map(Into::into));
        self.rows.push(Row { parts: parts.to_owned(), cells: cells.collect() });
    }

    /// Whether a column has a cell that is not empty.
    fn is_used(&self, column: usize) -> bool {
        let is_empty = |cell: &Node| matches!(cell, Node::Text(text) if text.is_empty());
        self.rows.iter().any(|row| row.cells.get(column).is_some_and(|cell| !is_empty(cell)))
    }

    /// The element of a row, with its heading and the cells of the columns that are shown.
    fn row_of(&self, row: Row, shown: &[usize]) -> Element {
        let cells = row.cells.into_iter().zip(&self.columns).enumerate();
        let cells = cells.filter(|(column, _)| shown.contains(column));
        let cells = cells.map(|(column, (cell, name))| match name {
            _ if column == 0 => holding("th", cell).attribute("scope", "row"),
            Node::Text(name) if self.is_stacked => {
                cell_of(cell).attribute("data-name", name.as_str())
            }
            _ => cell_of(cell),
        });
        let shown = element("tr").with_all(cells);
        if row.parts.is_empty() { shown } else { shown.attribute("data-is", row.parts) }
    }

    /// Makes the element of the table, in a box that scrolls sideways if the table is too wide.
    pub(crate) fn build(mut self) -> Element {
        let shown: Vec<usize> = (0..self.columns.len())
            .filter(|column| *column == 0 || self.is_used(*column))
            .collect();
        let rows = std::mem::take(&mut self.rows).into_iter();
        let rows: Vec<Element> = rows.map(|row| self.row_of(row, &shown)).collect();
        let columns = self.columns.into_iter().enumerate();
        let columns = columns.filter(|(column, _)| shown.contains(column));
        let headings = columns.map(|(_, column)| holding("th", column).attribute("scope", "col"));
        let table = element("table");
        let table = if self.is_stacked { table.class("stacked") } else { table };
        let table = table
            .with(holding("caption", holding("span", self.caption.as_str())))
            .with(holding("thead", element("tr").with_all(headings)))
            .with(element("tbody").with_all(rows));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_columns_are_omitted() {
        let mut table = Table::stacked("c", ["name", "unit", "value"]);
        table.row("link-1", "a", ["", "1"]);
        table.row("", "b", ["", ""]);
        let shown = table.build().to_string();
        assert!(!shown.contains("unit") && shown.contains(">value</th>"), "{shown}");
        assert!(
            shown.contains(
                "<tr data-is=\"link-1\"><th scope=\"row\">a</th><td data-name=\"value\">1</td></tr>"
            ),
            "{shown}"
        );
        assert_eq!(shown.matches("<td").count(), 2, "{shown}");
    }
}
