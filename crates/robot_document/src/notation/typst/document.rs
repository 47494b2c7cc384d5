//! Displayed equations and whole documents in Typst.

use super::formula::{Place, continued};
use super::text::quoted;
use super::{formula, text};
use crate::breaking::right_side;
use crate::document::{Cell, Document, Inline, NumberedEquation};
use crate::error::Error;
use crate::latex::{Layout, Page};
use crate::math::Line;
use crate::notation::front::{Below, Front};
use crate::notation::tabular::{Part, Placed, SIZES, tables};
use crate::width::width;

/// An upper bound for the error of estimated widths, in pt.
const MARGIN: f64 = 4.0;
/// The gap between the columns of a table, including the padding of the cells, in pt.
const CELL_GAP: f64 = 7.0;
/// The gap between two columns, in cm.
const GAP: f64 = 0.6;

/// The largest number of lines of an equation that is never broken across pages, and the number of the last lines of a
/// longer one, which stay together and have the number.
const LINES: usize = 4;
const LAST: usize = 2;

/// Writes displayed equations one below the other; those with a label are numbered.
///
/// # Errors
///
/// If a piece of an equation cannot be broken and does not fit on a line.
pub fn equations(list: &[NumberedEquation], layout: Layout) -> Result<String, Error> {
    let is_numbered = list.iter().any(|one| one.label.is_some());
    let numbering = if is_numbered { "\"(1)\"" } else { "none" };
    let mut typst = format!("#[\n#set math.equation(numbering: {numbering})\n");
    for one in list {
        typst.push_str(&equation(one, layout, is_numbered)?);
    }
    typst.push_str("]\n");
    Ok(typst)
}

/// An equation in one part or, if it is long, in two: the first can be broken across pages, and only the second has the
/// number, because Typst would repeat it on each page.
fn equation(
    numbered: &NumberedEquation,
    layout: Layout,
    is_numbered: bool,
) -> Result<String, Error> {
    let NumberedEquation { label, number: own, equation } = numbered;
    let available = layout.width - width(&equation.left) - MARGIN;
    let left = formula(&equation.left);
    let lines = right_side(equation, available, layout.number(numbered))?;
    let shown = |(place, line): (usize, &Line)| match place {
        0 if equation.is_name() => format!("{left} &"),
        0 => format!("{left} & = {}", formula(&line.math)),
        _ => format!("& quad {}", continued(line, Place::Free)),
    };
    let lines: Vec<String> = lines.iter().enumerate().map(shown).collect();
    let joined = |lines: &[String]| lines.join(" \\\n    ");
    let unnumbered = "#set math.equation(numbering: none)\n";
    let breakable = "#show math.equation: set block(breakable: true)\n";
    let before = match lines.len() {
        ..=LINES => 0,
        count => count - LAST,
    };
    let (first, last) = lines.split_at(before);
    let mut typst = match (first, is_numbered) {
        ([], _) => String::new(),
        (_, true) => format!("#[{unnumbered}{breakable}$ {} $]\n", joined(first)),
        (_, false) => format!("#[{breakable}$ {} $]\n", joined(first)),
    };
    let hidden = if first.is_empty() { String::new() } else { format!("#hide(${left}$) ") };
    let last = format!("$ {hidden}{} $", joined(last));
    typst.push_str(&match (label, own) {
        (Some(label), Some(own)) => {
            format!("#[#set math.equation(numbering: _ => [({own})])\n{last} <eq:{label}>]\n")
        }
        (Some(label), None) => format!("{last} <eq:{label}>\n"),
        (None, _) if is_numbered => format!("#[{unnumbered}{last}]\n"),
        (None, _) => format!("{last}\n"),
    });
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
    let all = Layout::of_centimeters(text_width(page)).width;
    let tables = tables(document, layout.width, all, CELL_GAP);
    let front = Front::new(document, &tables, page.columns, all);
    typst.push_str(&title(document, &front, page));
    for block in front.below(layout.width) {
        typst.push_str(&match block {
            Below::Heading(level, title) => format!("#heading(level: {level})[{}]\n", text(title)),
            Below::Paragraph(inlines, true) => {
                format!("#block(sticky: true, breakable: false)[{}]\n", line(inlines))
            }
            Below::Paragraph(inlines, false) => paragraph(inlines),
            Below::Table(table) => self::table(table),
            // Typst would place a float in the next column even if it is too high for it.
            Below::Figure(figure, scale, _) => super::figure::figure(figure, scale),
            Below::Equations(list) => equations(list, layout)?,
        });
    }
    Ok(typst)
}

fn paragraph(inlines: &[Inline]) -> String {
    format!("#par[{}]\n", line(inlines))
}

/// The title with the front of the document.
fn title(document: &Document, front: &Front<'_>, page: Page) -> String {
    let mut title = format!("#par[#text(size: 17pt)[{}]]\n", text(&document.title));
    if page.columns == 1 {
        return title;
    }
    title.extend(front.paragraphs.iter().map(|inlines| paragraph(inlines)));
    let tables = front.tables.iter().map(|one| table(one));
    let all = std::iter::once(title).chain(tables);
    all.map(|one| format!("#place(top + start, scope: \"parent\", float: true)[\n{one}]\n"))
        .collect()
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
    let title = quoted(&document.title);
    format!(
        "#set document(title: {title})
#set page(width: {paper:.3}cm, height: 29.7cm, margin: (x: {margin:.3}cm, y: 2.85cm), columns: {})
#set columns(gutter: {GAP}cm)
#set text(font: \"New Computer Modern\", size: 10pt, ligatures: false)
#set par(spacing: 0.8em)
#show math.equation: set text(font: \"New Computer Modern Math\")
#show math.equation.where(block: true): set align(start)
#show math.equation.where(block: true): set block(breakable: false, spacing: 0.65em)
#set math.equation(number-align: end + bottom)
",
        page.columns
    )
}

/// A table in parts. Only long ones are broken across pages; then the head is repeated.
fn table(table: &Placed) -> String {
    table.parts.iter().map(|part| self::part(part, table.number)).collect()
}

fn part(part: &Part, number: usize) -> String {
    let caption = match part.is_continued {
        true => format!("*Table {number}* (continued)"),
        false => format!("*Table {number}.* {}", text(&part.table.caption)),
    };
    let is_breakable = part.groups.len() > 1;
    let size = 10.0 * SIZES.get(part.size).map_or(1.0, |(_, scale)| *scale);
    let columns: Vec<String> = part.widths.iter().map(|width| column(*width)).collect();
    let cells = |cells: &[Cell]| -> String {
        let cells: Vec<String> = cells.iter().map(|cell| format!("[{}]", line(cell))).collect();
        cells.join(", ")
    };
    let mut typst = format!(
        "#[
#set block(spacing: 1.2em)
#block(breakable: {is_breakable})[
#set block(spacing: 0.8em)
{caption}
#v(2pt)
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
    typst.push_str("  table.hline(),\n)]\n]\n");
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
