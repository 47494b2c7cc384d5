//! Whole documents.

use std::fmt::Write as _;

use super::equations::{Layout, equations};
use super::{formula, text};
use crate::breaking::broken;
use crate::document::{Block, Document, Inline, Table};
use crate::error::Error;
use crate::width::{text_width, width};

/// The layout of a document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Page {
    /// Columns on a page, 1 or 2.
    pub columns: u8,
    /// The width of a column, cm.
    pub width: f64,
}

/// Between two columns, cm.
const GAP: f64 = 0.6;
/// Rows of a table on one page.
const ROWS: usize = 40;
/// The struts that separate the first row from a rule above it, and the last row from one below.
const STRUTS: [&str; 2] = [r"\rule{0pt}{2.7ex}", r"\rule[-1.1ex]{0pt}{0pt}"];
/// Between the columns of a table, pt, in any size.
const COLUMN_GAP: f64 = 12.5;
/// Sizes of type with what they are of the normal size.
const SIZES: [(&str, f64); 4] =
    [("normalsize", 1.0), ("small", 0.92), ("footnotesize", 0.84), ("scriptsize", 0.74)];

impl Page {
    /// A page of A4 with one or two columns of the usual width.
    #[must_use]
    pub fn with_columns(columns: u8) -> Page {
        if columns > 1 { Page { columns: 2, width: 8.2 } } else { Page { columns: 1, width: 16.0 } }
    }

    fn text_width(self) -> f64 {
        f64::from(self.columns) * self.width + f64::from(self.columns.saturating_sub(1)) * GAP
    }
}

/// The document as the source of a LaTeX run: article, amsmath and geometry are all that it needs.
///
/// # Errors
///
/// A piece of an equation that does not fit a column.
pub fn document(document: &Document, page: Page) -> Result<String, Error> {
    let mut writer = Writer { page, latex: String::new(), tables: 0 };
    writer.head(document);
    for block in &document.blocks {
        writer.block(block)?;
    }
    writer.latex.push_str("\\end{document}\n");
    Ok(writer.latex)
}

struct Writer {
    page: Page,
    latex: String,
    tables: usize,
}

impl Writer {
    fn line(&mut self, line: &str) {
        self.latex.push_str(line);
        self.latex.push('\n');
    }

    fn head(&mut self, document: &Document) {
        let columns = if self.page.columns > 1 { ",twocolumn" } else { "" };
        let width = self.page.text_width();
        self.line(&format!("\\documentclass[10pt{columns}]{{article}}"));
        self.line(&format!(
            "\\usepackage[a4paper,textwidth={width:.3}cm,textheight=24cm,columnsep={GAP}cm]{{geometry}}"
        ));
        self.line("\\usepackage{amsmath}");
        self.line("\\allowdisplaybreaks");
        self.line("\\setlength{\\parindent}{0pt}");
        self.line("\\setlength{\\parskip}{4pt plus 2pt}");
        self.line("\\setcounter{secnumdepth}{0}");
        self.line("\\raggedbottom");
        self.line("\\begin{document}");
        self.line("\\raggedright");
        self.line(&format!("{{\\LARGE {}\\par}}\\medskip", text(&document.title)));
    }

    fn block(&mut self, block: &Block) -> Result<(), Error> {
        match block {
            Block::Heading(level, title) => {
                let command = if *level > 1 { "subsection" } else { "section" };
                self.line(&format!("\n\\{command}{{{}}}", text(title)));
            }
            Block::Paragraph(inlines) => {
                let line = self.inlines(inlines);
                self.line(&format!("\n{line}"));
            }
            Block::List(items) => {
                self.line(
                    "\\begin{list}{}{\\leftmargin1.2em\\itemindent-1.2em\\itemsep0pt\\parsep1pt}",
                );
                for item in items {
                    let line = self.inlines(item);
                    self.line(&format!("\\item {line}"));
                }
                self.line("\\end{list}");
            }
            Block::Table(table) => self.table(table),
            Block::Equations(list) => {
                let layout = Layout::of_centimeters(self.page.width);
                self.latex.push_str(&equations(list, layout)?);
            }
        }
        Ok(())
    }

    /// A line of a paragraph: formulas wider than a column are broken.
    fn inlines(&self, inlines: &[Inline]) -> String {
        let available = Layout::of_centimeters(self.page.width).width - 20.0;
        let one = |inline: &Inline| match inline {
            Inline::Math(math) if width(math) > available => {
                // A formula that cannot be broken is printed unbroken.
                let lines =
                    broken(math, available, available).unwrap_or_else(|_| vec![math.clone()]);
                let lines: Vec<String> =
                    lines.iter().map(|line| format!("\\({}\\)", formula(line))).collect();
                lines.join(" ")
            }
            other => line(std::slice::from_ref(other)),
        };
        inlines.iter().map(one).collect()
    }

    /// A table as wide as it must be, in a smaller size if that helps; one that fits no page
    /// becomes a list.
    fn table(&mut self, table: &Table) {
        self.tables += 1;
        let caption = format!("\\textbf{{Table {}.}} {}", self.tables, text(&table.caption));
        let natural = natural_width(table);
        let gaps = COLUMN_GAP * table.head.len() as f64;
        let fits = |available: f64| {
            let points = Layout::of_centimeters(available).width;
            SIZES.iter().find(|(_, scale)| natural * scale + gaps <= points).map(|(size, _)| *size)
        };
        match (fits(self.page.width), fits(self.page.text_width())) {
            (Some(size), _) => self.tabular(table, &caption, size, ["{\\centering", "\\par}"]),
            (None, Some(size)) => {
                let around = ["\\begin{table*}[tp]\\centering", "\\end{table*}"];
                self.tabular(table, &caption, size, around);
            }
            (None, None) => self.as_list(table, &caption),
        }
    }

    fn tabular(&mut self, table: &Table, caption: &str, size: &str, [begin, end]: [&str; 2]) {
        let columns = "l".repeat(table.head.len());
        let cells = |cells: &[Vec<Inline>]| {
            cells.iter().map(|cell| line(cell)).collect::<Vec<_>>().join(" & ")
        };
        let [below, above] = STRUTS;
        for (place, rows) in table.rows.chunks(ROWS).enumerate() {
            let more = if place == 0 { "" } else { " (continued)" };
            self.line(&format!("\n{begin}\n{caption}{more}\\par\\smallskip"));
            self.line(&format!("\\{size}\n\\begin{{tabular}}{{{columns}}}\n\\hline"));
            self.line(&format!("{below}{}{above} \\\\\n\\hline", cells(&table.head)));
            let last = rows.len().saturating_sub(1);
            for (place, row) in rows.iter().enumerate() {
                let start = if place == 0 { below } else { "" };
                let end = if place == last { above } else { "" };
                self.line(&format!("{start}{}{end} \\\\", cells(row)));
            }
            self.line(&format!("\\hline\n\\end{{tabular}}{end}\\medskip"));
        }
    }

    fn as_list(&mut self, table: &Table, caption: &str) {
        self.line(&format!("\n{caption}"));
        self.line("\\begin{list}{}{\\leftmargin1.2em\\itemindent-1.2em\\itemsep0pt\\parsep1pt}");
        for row in &table.rows {
            let mut item = String::new();
            for (place, (head, cell)) in table.head.iter().zip(row).enumerate() {
                // Writing to a string does not fail.
                let gap = if place == 0 { "" } else { "; " };
                let _ = write!(item, "{gap}{}: {}", line(head), self.inlines(cell));
            }
            self.line(&format!("\\item {item}"));
        }
        self.line("\\end{list}");
    }
}

/// The width of the cells of a table in the normal size, pt.
pub(crate) fn natural_width(table: &Table) -> f64 {
    let cell = |row: &Vec<Vec<Inline>>, column: usize| {
        row.get(column).map_or(0.0, |inlines| inlines.iter().map(inline_width).sum())
    };
    let column = |column: usize| {
        let rows = std::iter::once(&table.head).chain(&table.rows);
        rows.map(|row| cell(row, column)).fold(0.0, f64::max)
    };
    (0..table.head.len()).map(column).sum()
}

fn inline_width(inline: &Inline) -> f64 {
    match inline {
        Inline::Text(text) => text_width(text),
        Inline::Emphasis(text) => 1.2 * text_width(text),
        Inline::Math(math) => width(math),
        Inline::Reference(_) => 25.0,
    }
}

/// A line of text.
fn line(inlines: &[Inline]) -> String {
    let one = |inline: &Inline| match inline {
        Inline::Text(content) => text(content),
        Inline::Emphasis(content) => format!("\\emph{{{}}}", text(content)),
        Inline::Math(math) => format!("\\({}\\)", formula(math)),
        Inline::Reference(label) => format!("(\\ref{{eq:{label}}})"),
    };
    inlines.iter().map(one).collect()
}
