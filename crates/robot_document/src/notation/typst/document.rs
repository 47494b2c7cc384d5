//! Displayed equations and whole documents in Typst.

use super::formula::{Place, continued};
use super::{formula, text};
use crate::breaking::right_side;
use crate::document::{Block, Cell, Document, Inline, NumberedEquation, Table};
use crate::error::Error;
use crate::latex::{Layout, Page};
use crate::notation::tabular::{Part, SIZES, placed};
use crate::width::width;

/// An upper bound for the error of estimated widths, in pt.
const MARGIN: f64 = 4.0;
/// The gap between the columns of a table, including the padding of the cells, in pt.
const CELL_GAP: f64 = 7.0;
/// The gap between two columns, in cm.
const GAP: f64 = 0.6;

/// The number of lines that are kept together on a page. The last part of a longer equation has the number.
const LINES: usize = 8;

/// Writes displayed equations one below the other; those with a label are numbered.
///
/// # Errors
///
/// If a piece of an equation cannot be broken and does not fit on a line.
pub fn equations(list: &[NumberedEquation], layout: Layout) -> Result<String, Error> {
    let is_numbered = list.iter().any(|one| one.label.is_some());
    let numbering = if is_numbered { "\"(1)\"" } else { "none" };
    let mut typst = format!("#[\n#set math.equation(numbering: {numbering})\n");
    for numbered in list {
        let NumberedEquation { label, number: own, equation } = numbered;
        let available = layout.width - width(&equation.left) - MARGIN;
        let left = formula(&equation.left);
        let lines = right_side(equation, available, layout.number(numbered))?;
        let last = lines.len().saturating_sub(1) / LINES;
        for (part, lines) in lines.chunks(LINES).enumerate() {
            let mut shown = vec![];
            for (place, line) in lines.iter().enumerate() {
                shown.push(match (part, place) {
                    (0, 0) if equation.is_name() => format!("{left} &"),
                    (0, 0) => format!("{left} & = {}", formula(line)),
                    (_, 0) => format!("#hide(${left}$) & quad {}", continued(line, Place::Free)),
                    _ => format!("& quad {}", continued(line, Place::Free)),
                });
            }
            let shown = shown.join(" \\\n    ");
            typst.push_str(&match label {
                Some(label) if part == last => match own {
                    Some(own) => format!(
                        "#[#set math.equation(numbering: _ => [({own})])\n$ {shown} $ <eq:{label}>]\n"
                    ),
                    None => format!("$ {shown} $ <eq:{label}>\n"),
                },
                Some(_) => format!("#[#set math.equation(numbering: none)\n$ {shown} $]\n"),
                None if is_numbered => {
                    format!("#[#set math.equation(numbering: none)\n$ {shown} $]\n")
                }
                None => format!("$ {shown} $\n"),
            });
        }
    }
    typst.push_str("]\n");
    Ok(typst)
}

/// Writes the document as Typst source, which needs no packages and only the fonts that Typst contains.
///
/// # Errors
///
/// If a piece of an equation does not fit in a column.
pub fn document(document: &Document, page: Page) -> Result<String, Error> {
    let mut typst = head(document, page);
    let layout = Layout::of_centimeters(page.width).numbered(document.numbers());
    let mut tables = 0;
    for block in &document.blocks {
        match block {
            Block::Heading(level, title) => {
                typst.push_str(&format!("#heading(level: {level})[{}]\n", text(title)));
            }
            Block::Paragraph(inlines) => {
                typst.push_str(&format!("#par[{}]\n", line(inlines)));
            }
            Block::Table(table) => {
                tables += 1;
                typst.push_str(&self::table(table, tables, page));
            }
            Block::Figure(figure) => {
                typst.push_str(&super::figure::figure(figure, layout.width));
            }
            Block::Equations(list) => typst.push_str(&equations(list, layout)?),
        }
    }
    Ok(typst)
}

/// The width of all columns of a page with their gaps, in cm.
fn text_width(page: Page) -> f64 {
    let columns = f64::from(page.columns);
    columns * page.width + (columns - 1.0) * GAP
}

fn head(document: &Document, page: Page) -> String {
    let width = text_width(page);
    let paper = (width + 2.0).max(21.0);
    let margin = (paper - width) / 2.0;
    let title = text(&document.title);
    format!(
        "#set page(width: {paper:.3}cm, height: 29.7cm, margin: (x: {margin:.3}cm, y: 2.85cm), columns: {})
#set columns(gutter: {GAP}cm)
#set text(font: \"New Computer Modern\", size: 10pt, ligatures: false)
#set par(spacing: 0.8em)
#show math.equation: set text(font: \"New Computer Modern Math\")
#show math.equation.where(block: true): set align(start)
#show math.equation.where(block: true): set block(breakable: false, spacing: 0.65em)
#set math.equation(number-align: end + bottom)
#par[#text(size: 17pt)[{title}]]
",
        page.columns
    )
}

/// A table in parts that are never broken across pages. They only float if they span columns, to the bottom of a page:
/// at the top of the first one is the title.
fn table(table: &Table, number: usize, page: Page) -> String {
    let [column, all] =
        [page.width, text_width(page)].map(|width| Layout::of_centimeters(width).width);
    let placed = placed(table, column, all, CELL_GAP);
    let part = |part: &Part| match placed.spans {
        true => {
            format!(
                "#place(bottom, scope: \"parent\", float: true)[\n{}]\n",
                self::part(part, number)
            )
        }
        false => self::part(part, number),
    };
    placed.parts.iter().map(part).collect()
}

fn part(part: &Part, number: usize) -> String {
    let caption = match part.is_continued {
        true => format!("*Table {number}* (continued)"),
        false => format!("*Table {number}.* {}", text(&part.table.caption)),
    };
    let size = 10.0 * SIZES.get(part.size).map_or(1.0, |(_, scale)| *scale);
    let columns: Vec<String> = part.widths.iter().map(|width| column(*width)).collect();
    let cells = |cells: &[Cell]| -> String {
        let cells: Vec<String> = cells.iter().map(|cell| format!("[{}]", line(cell))).collect();
        cells.join(", ")
    };
    let mut typst = format!(
        "#block(breakable: false)[
{caption}
#set text(size: {size:.1}pt)
#table(
  columns: ({}),
  stroke: none,
  inset: (x: 3pt, top: 3pt, bottom: 4pt),
  table.hline(),
  table.header({}),
  table.hline(),
",
        columns.join(", "),
        cells(&part.table.head)
    );
    for row in &part.table.rows {
        typst.push_str(&format!("  {},\n", cells(row)));
    }
    typst.push_str("  table.hline(),\n)]\n");
    typst
}

/// The width of a column in Typst.
fn column(width: Option<f64>) -> String {
    // The width includes the padding of the cells.
    width.map_or_else(|| "auto".to_owned(), |width| format!("{}pt", (width + 6.0).floor()))
}

/// A line of text.
pub(super) fn line(inlines: &[Inline]) -> String {
    let one = |inline: &Inline| match inline {
        Inline::Text(content) => text(content),
        Inline::Emphasis(content) => format!("#emph[{}]", text(content)),
        Inline::Math(math) => format!("${}$", formula(math)),
        Inline::Reference(label) => format!("#ref(<eq:{label}>, supplement: none)"),
    };
    inlines.iter().map(one).collect()
}
