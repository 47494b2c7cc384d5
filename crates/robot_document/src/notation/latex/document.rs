//! Whole documents in LaTeX.

use super::equations::{Layout, equations};
use super::{formula, text};
use crate::breaking::broken;
use crate::document::{Block, Cell, Document, Inline, Table};
use crate::error::Error;
use crate::notation::tabular::{Part, SIZES, placed};
use crate::width::width;

/// The layout of a document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Page {
    /// The number of columns on a page, 1 or 2.
    pub columns: u8,
    /// The width of a column, in cm.
    pub width: f64,
}

/// The width of A4, and the least margin beside text that is wider than usual, in cm.
const A4: f64 = 21.0;
const MARGIN: f64 = 1.0;
/// The gap between two columns, in cm.
const GAP: f64 = 0.6;
/// The struts that separate the first row from a rule above it, and the last row from one below.
const STRUTS: [&str; 2] = [r"\rule{0pt}{2.7ex}", r"\rule[-1.1ex]{0pt}{0pt}"];
/// The gap between the columns of a table in all font sizes, in pt.
const COLUMN_GAP: f64 = 12.5;

impl Page {
    /// An A4 page with one or two columns of the usual width.
    #[must_use]
    pub fn with_columns(columns: u8) -> Page {
        if columns > 1 { Page { columns: 2, width: 8.2 } } else { Page { columns: 1, width: 16.0 } }
    }

    fn text_width(self) -> f64 {
        f64::from(self.columns) * self.width + f64::from(self.columns.saturating_sub(1)) * GAP
    }
}

/// Writes the document as LaTeX source. It only needs the class article, the packages amsmath and geometry and, for a
/// figure, TikZ.
///
/// # Errors
///
/// If a piece of an equation does not fit in a column.
pub fn document(document: &Document, page: Page) -> Result<String, Error> {
    let layout = Layout::of_centimeters(page.width).numbered(document.numbers());
    let mut writer = Writer { page, layout, latex: String::new(), tables: 0 };
    writer.head(document);
    for block in &document.blocks {
        writer.block(block)?;
    }
    writer.latex.push_str("\\end{document}\n");
    Ok(writer.latex)
}

struct Writer {
    page: Page,
    layout: Layout,
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
        let paper = match width + 2.0 * MARGIN > A4 {
            true => format!("paperwidth={:.3}cm,paperheight=29.7cm", width + 2.0 * MARGIN),
            false => "a4paper".to_owned(),
        };
        self.line(&format!("\\documentclass[10pt,fleqn{columns}]{{article}}"));
        self.line(&format!(
            "\\usepackage[{paper},textwidth={width:.3}cm,textheight=24cm,columnsep={GAP}cm]{{geometry}}"
        ));
        self.line("\\usepackage{amsmath}");
        if document.blocks.iter().any(|block| matches!(block, Block::Figure(_))) {
            // Without TikZ, the document is complete except for the figure.
            self.line("\\IfFileExists{tikz.sty}{\\usepackage{tikz}}{}");
        }
        self.line("\\setlength{\\mathindent}{0pt}");
        self.line("\\allowdisplaybreaks");
        self.line("\\setlength{\\parindent}{0pt}");
        self.line("\\setlength{\\parskip}{4pt plus 2pt}");
        self.line("\\setcounter{secnumdepth}{0}");
        self.line("\\raggedbottom");
        self.line("\\begin{document}");
        self.line("\\raggedright");
        // A display at the start of a paragraph already has an empty line above it.
        self.line("\\setlength{\\abovedisplayskip}{0pt}");
        self.line("\\setlength{\\belowdisplayskip}{4pt plus 2pt}");
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
            Block::Table(table) => self.table(table),
            Block::Figure(figure) => {
                self.latex.push_str(&super::figure::figure(figure, self.layout.width));
            }
            Block::Equations(list) => self.latex.push_str(&equations(list, self.layout)?),
        }
        Ok(())
    }

    /// A line of a paragraph, in which formulas wider than a column are broken.
    fn inlines(&self, inlines: &[Inline]) -> String {
        wrapped(inlines, self.layout.width - 20.0)
    }

    /// A table in parts that are never broken across pages. They only float if they span columns, to the top of a page.
    fn table(&mut self, table: &Table) {
        self.tables += 1;
        let page = Layout::of_centimeters(self.page.text_width()).width;
        let placed = placed(table, self.layout.width, page, COLUMN_GAP);
        for part in &placed.parts {
            let [begin, end] = match placed.spans {
                true => ["\n\\begin{table*}[tp!]\\raggedright", "\\end{table*}"],
                false => [
                    "\n\\medskip\n\\begin{minipage}{\\linewidth}\\raggedright",
                    "\\end{minipage}\\par\\medskip",
                ],
            };
            self.line(begin);
            self.part(part);
            self.line(end);
        }
    }

    fn part(&mut self, part: &Part) {
        let number = self.tables;
        let caption = match part.is_continued {
            true => format!("\\textbf{{Table {number}}} (continued)"),
            false => format!("\\textbf{{Table {number}.}} {}", text(&part.table.caption)),
        };
        let (size, scale) = SIZES.get(part.size).copied().unwrap_or(("small", 1.0));
        let columns: String = part.widths.iter().map(|width| column(*width)).collect();
        let cells = |cells: &[Cell]| {
            let cells = cells.iter().zip(&part.widths);
            cells.map(|(cell, width)| shown(cell, *width, scale)).collect::<Vec<_>>().join(" & ")
        };
        // In cells of several lines, `\\` would break a line within the cell.
        let end = match part.widths.iter().any(Option::is_some) {
            true => "\\tabularnewline",
            false => "\\\\",
        };
        let [below, above] = STRUTS;
        self.line(&format!("{caption}\\par\\smallskip"));
        self.line(&format!("\\{size}\n\\begin{{tabular}}{{@{{}}{columns}@{{}}}}\n\\hline"));
        self.line(&format!("{below}{}{above} {end}\n\\hline", cells(&part.table.head)));
        let last = part.table.rows.len().saturating_sub(1);
        for (place, row) in part.table.rows.iter().enumerate() {
            let start = if place == 0 { below } else { "" };
            let strut = if place == last { above } else { "" };
            self.line(&format!("{start}{}{strut} {end}", cells(row)));
        }
        self.line("\\hline\n\\end{tabular}");
    }
}

/// The specification of a column for `tabular`.
fn column(width: Option<f64>) -> String {
    width.map_or_else(|| "l".to_owned(), |width| format!("p{{{}pt}}", width.floor()))
}

/// A cell, in which formulas wider than its column are broken.
fn shown(cell: &[Inline], width: Option<f64>, scale: f64) -> String {
    match width {
        None => line(cell),
        Some(_) if cell.is_empty() => String::new(),
        Some(width) => format!("\\raggedright {}", wrapped(cell, width / scale)),
    }
}

/// A line of text in which formulas wider than `available` points are broken.
fn wrapped(inlines: &[Inline], available: f64) -> String {
    let one = |inline: &Inline| match inline {
        Inline::Math(math) if width(math) > available => {
            // A formula that cannot be broken is printed unbroken.
            let lines = broken(math, available, available).unwrap_or_else(|_| vec![math.clone()]);
            let lines: Vec<String> =
                lines.iter().map(|line| format!("\\({}\\)", formula(line))).collect();
            lines.join(" ")
        }
        other => line(std::slice::from_ref(other)),
    };
    inlines.iter().map(one).collect()
}

/// A line of text.
pub(super) fn line(inlines: &[Inline]) -> String {
    let one = |inline: &Inline| match inline {
        Inline::Text(content) => text(content),
        Inline::Emphasis(content) => format!("\\emph{{{}}}", text(content)),
        Inline::Math(math) => format!("\\({}\\)", formula(math)),
        Inline::Reference(label) => format!("(\\ref{{eq:{label}}})"),
    };
    inlines.iter().map(one).collect()
}
