//! Whole documents in LaTeX.

use std::ops::Range;

use super::equations::{Layout, equations};
use super::{formula, text};
use crate::breaking::broken;
use crate::document::{Block, Cell, Document, Inline};
use crate::error::Error;
use crate::math::Line;
use crate::notation::front::{Below, Front};
use crate::notation::tabular::{Part, Placed, SIZES, natural_width, tables};
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
/// The command for the rows of a long table after the first ones. Its penalty lets TeX break the page before
/// the rest of the page is measured.
const MORE_ROWS: &str = r"% The rows #3 of a table: if there is no room, on a new page with the caption #1 and the head #2.
\newsavebox{\rows}
\newcommand{\morerows}[3]{%
  \par\penalty0
  \sbox{\rows}{#3}%
  \ifdim\dimexpr\pagetotal+\pagedepth+\ht\rows+\dp\rows\relax>\pagegoal
    \nointerlineskip\kern2pt\hrule width\wd\rows\newpage
    #1\par\nobreak\smallskip{#2\par}\nointerlineskip\kern2pt
  \fi
  \nointerlineskip\box\rows}";
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
    let across = Layout::of_centimeters(page.text_width()).width;
    let tables = tables(document, layout.width, across, COLUMN_GAP);
    let front = Front::new(document, &tables, page.columns, across);
    let mut writer = Writer { page, layout, latex: String::new() };
    writer.head(document, &tables);
    writer.title(document, &front);
    for block in front.below(layout.width) {
        writer.block(&block)?;
    }
    writer.latex.push_str("\\end{document}\n");
    Ok(writer.latex)
}

struct Writer {
    page: Page,
    layout: Layout,
    latex: String,
}

impl Writer {
    fn line(&mut self, line: &str) {
        self.latex.push_str(line);
        self.latex.push('\n');
    }

    fn head(&mut self, document: &Document, tables: &[Placed]) {
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
        if tables.iter().any(Placed::is_breakable) {
            self.line(MORE_ROWS);
        }
        self.line(&pdf_title(&document.title));
        self.line("\\begin{document}");
    }

    /// The title with the front of the document.
    fn title(&mut self, document: &Document, front: &Front<'_>) {
        let [begin, end] = match self.page.columns {
            1 => ["", ""],
            _ if front.is_long => ["\\onecolumn\n", "\\twocolumn\n"],
            _ => ["\\twocolumn[{%\n\\setlength{\\parskip}{4pt plus 2pt}\n", "\\bigskip}]\n"],
        };
        self.latex.push_str(begin);
        self.line("\\raggedright");
        self.line(&format!("{{\\LARGE {}\\par}}\\medskip", text(&document.title)));
        for inlines in &front.paragraphs {
            let line = self.inlines(inlines);
            self.line(&format!("\n{line}"));
        }
        front.tables.iter().for_each(|table| self.table(table));
        self.latex.push_str(end);
        if self.page.columns > 1 && !front.is_long {
            self.line("\\raggedright");
        }
        // A display at the start of a paragraph already has an empty line above it.
        self.line("\\setlength{\\abovedisplayskip}{0pt}");
        self.line("\\setlength{\\belowdisplayskip}{4pt plus 2pt}");
    }

    fn block(&mut self, block: &Below<'_>) -> Result<(), Error> {
        match block {
            Below::Heading(level, title) => {
                let command = if *level > 1 { "subsection" } else { "section" };
                self.line(&format!("\n\\{command}{{{}}}", text(title)));
            }
            Below::Paragraph(inlines, is_kept) => {
                let line = self.inlines(inlines);
                self.line(&match is_kept {
                    true => format!("\n{{\\interlinepenalty=10000 {line}\\par}}\\nobreak"),
                    false => format!("\n{line}"),
                });
            }
            Below::Table(table) => self.table(table),
            Below::Figure(figure, scale, floats) => {
                self.latex.push_str(&super::figure::figure(figure, *scale, *floats));
            }
            Below::Equations(list) => self.latex.push_str(&equations(list, self.layout)?),
        }
        Ok(())
    }

    /// A line of a paragraph, in which formulas wider than a column are broken.
    fn inlines(&self, inlines: &[Inline]) -> String {
        wrapped(inlines, self.layout.width - 20.0)
    }

    /// A table in parts, of which only long ones are broken across pages.
    fn table(&mut self, table: &Placed) {
        for part in &table.parts {
            self.part(part, table.number);
        }
    }

    fn part(&mut self, part: &Part, number: usize) {
        let continued = format!("\\textbf{{Table {number}}} (continued)");
        let caption = match part.is_continued {
            true => continued.clone(),
            false => format!("\\textbf{{Table {number}.}} {}", text(&part.table.caption)),
        };
        let rows = Rows::new(part);
        let Some((first, more)) = part.groups.split_first() else { return };
        let (mut start, mut end) = (0, *first);
        self.line("\n\\medskip\n\\begin{minipage}{\\linewidth}\\raggedright");
        self.line(&format!("{caption}\\par\\smallskip"));
        self.line(&rows.tabular(&format!("{}{}", rows.head(), rows.lines(start..end))));
        self.line("\\end{minipage}\\par");
        for count in more {
            (start, end) = (end, end + count);
            let [head, lines] =
                [rows.head(), rows.lines(start..end)].map(|rows_| rows.tabular(&rows_));
            self.line(&format!("\\morerows{{{continued}}}{{{head}}}{{%\n{lines}}}"));
        }
        self.line("\\medskip");
    }
}

/// The LaTeX of the rows of a table.
struct Rows<'p> {
    part: &'p Part,
    scale: f64,
    /// The end of a row.
    end: &'static str,
}

impl Rows<'_> {
    fn new(part: &Part) -> Rows<'_> {
        // In cells of several lines, `\\` would break a line within the cell.
        let end = match part.widths.iter().any(Option::is_some) {
            true => "\\tabularnewline",
            false => "\\\\",
        };
        Rows { part, scale: SIZES.get(part.size).map_or(1.0, |(_, scale)| *scale), end }
    }

    /// A `tabular` with these lines.
    fn tabular(&self, lines: &str) -> String {
        let size = SIZES.get(self.part.size).map_or("small", |(name, _)| name);
        let columns: String = self.part.widths.iter().map(|width| column(*width)).collect();
        format!("\\{size}\n\\begin{{tabular}}{{@{{}}{columns}@{{}}}}\n{lines}\\end{{tabular}}")
    }

    fn cells(&self, cells: &[Cell]) -> String {
        let cells = cells.iter().zip(&self.part.widths);
        cells.map(|(cell, width)| shown(cell, *width, self.scale)).collect::<Vec<_>>().join(" & ")
    }

    /// The head between its rules.
    fn head(&self) -> String {
        let [below, above] = STRUTS;
        let cells = self.cells(&self.part.table.head);
        format!("\\hline\n{below}{cells}{above} {}\n\\hline\n", self.end)
    }

    /// The rows at these places, with the rule below the last one of the table.
    fn lines(&self, places: Range<usize>) -> String {
        let [below, above] = STRUTS;
        let rows = &self.part.table.rows;
        let last = rows.len().saturating_sub(1);
        let mut latex = String::new();
        for (place, row) in rows.iter().enumerate().take(places.end).skip(places.start) {
            let start = if place == 0 { below } else { "" };
            let [strut, rule] = if place == last { [above, "\\hline\n"] } else { ["", ""] };
            latex.push_str(&format!("{start}{}{strut} {}\n{rule}", self.cells(row), self.end));
        }
        latex
    }
}

/// The title of the PDF file.
fn pdf_title(title: &str) -> String {
    let is_plain =
        |one: char| matches!(one, ' ' | '-' | ',' | '.' | ':' | '+') || one.is_ascii_alphanumeric();
    let string = match title.chars().all(is_plain) {
        true => format!("({title})"),
        false => {
            let units: String = title.encode_utf16().map(|unit| format!("{unit:04X}")).collect();
            format!("<FEFF{units}>")
        }
    };
    format!("\\ifdefined\\pdfinfo\\pdfinfo{{/Title {string}}}\\fi")
}

/// The specification of a column for `tabular`.
fn column(width: Option<f64>) -> String {
    width.map_or_else(|| "l".to_owned(), |width| format!("p{{{}pt}}", width.floor()))
}

/// A cell, in which formulas wider than its column are broken.
fn shown(cell: &[Inline], width: Option<f64>, scale: f64) -> String {
    match width {
        None => line(cell),
        Some(width) if natural_width(cell) * scale <= width => line(cell),
        Some(width) => format!("\\raggedright {}", wrapped(cell, width / scale)),
    }
}

/// A line of text in which formulas wider than `available` points are broken.
fn wrapped(inlines: &[Inline], available: f64) -> String {
    let one = |inline: &Inline| match inline {
        Inline::Math(math) if width(math) > available => {
            // A formula that cannot be broken is printed unbroken.
            let Ok(lines) = broken(math, available, available) else {
                return format!("\\({}\\)", formula(math));
            };
            let line = |line: &Line| format!("\\({}\\)", formula(&line.math));
            lines.iter().map(line).collect::<Vec<_>>().join(" ")
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
