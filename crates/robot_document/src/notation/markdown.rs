//! Markdown: displayed equations between `$$` and formulas in text between `$`, as GitHub and other sites render them.

use std::collections::BTreeMap;

use crate::breaking::right_side;
use crate::document::{Block, Cell, Document, Inline, NumberedEquation, Table};
use crate::error::Error;
use crate::latex::{Layout, continued, formula};
use crate::math::Math;
use crate::width::width;

/// Writes equations one below the other, broken into lines and without their labels.
///
/// # Errors
///
/// If a piece of an equation cannot be broken and does not fit on a line.
pub fn equations(list: &[NumberedEquation], layout: Layout) -> Result<String, Error> {
    let mut shown = String::new();
    for equation in list {
        shown.push_str(&display(equation, layout, None)?);
    }
    Ok(shown)
}

/// An equation, with its number if it has one.
fn display(
    NumberedEquation { equation, .. }: &NumberedEquation,
    layout: Layout,
    number: Option<&str>,
) -> Result<String, Error> {
    let lines = right_side(equation, layout.width - width(&equation.left), 0.0)?;
    let lines = lines.iter().enumerate();
    let lines: Vec<String> = lines
        .map(|(place, line)| if place == 0 { formula(&line.math) } else { continued(line) })
        .collect();
    let left = formula(&equation.left);
    let display = match lines.as_slice() {
        _ if equation.is_name() => left,
        [single] => format!("{left} = {single}"),
        lines => {
            let lines = lines.join(" \\\\\n&\\quad ");
            format!("\\begin{{aligned}}\n{left} &= {lines}\n\\end{{aligned}}")
        }
    };
    let tag = number.map(|number| format!(" \\tag{{{number}}}")).unwrap_or_default();
    // GitHub does not support \operatorname, and other sites do not support `@{}` for columns.
    let display = display.replace(r"\operatorname{", r"\mathrm{");
    let display = display.replace("[b]{@{}l@{}}", "{l}").replace("{@{}l@{}}", "{l}");
    Ok(format!("\n$$\n{display}{tag}\n$$\n"))
}

/// Writes the document as Markdown, without its figure, because GitHub only shows images that are files.
///
/// # Errors
///
/// If a piece of an equation cannot be broken and does not fit on a line.
pub fn document(document: &Document, layout: Layout) -> Result<String, Error> {
    let lists = document.blocks.iter().filter_map(|block| match block {
        Block::Equations(list) => Some(list),
        _ => None,
    });
    let labeled = lists.flatten().filter_map(|one| Some((one.label.as_deref()?, &one.number)));
    let numbered = |(place, (label, own)): (usize, (&'_ str, &Option<String>))| {
        (label.to_owned(), own.clone().unwrap_or_else(|| (place + 1).to_string()))
    };
    let labels: Labels = labeled.enumerate().map(numbered).collect();
    let mut markdown = format!("# {}\n", text(&document.title));
    let mut tables = 0;
    for block in &document.blocks {
        match block {
            Block::Heading(level, title) => {
                let signs = "#".repeat(usize::from(*level) + 1);
                markdown.push_str(&format!("\n{signs} {}\n", text(title)));
            }
            Block::Paragraph(inlines) => {
                markdown.push_str(&format!("\n{}\n", opened(&line(inlines, &labels))));
            }
            Block::Table(table) => {
                tables += 1;
                markdown.push_str(&self::table(table, tables, &labels));
            }
            Block::Figure(_) => {}
            Block::Equations(list) => {
                for equation in list {
                    let number = equation.label.as_ref().and_then(|label| labels.get(label));
                    markdown.push_str(&display(equation, layout, number.map(String::as_str))?);
                }
            }
        }
    }
    Ok(markdown)
}

/// The numbers of equations by their labels.
type Labels = BTreeMap<String, String>;

fn table(table: &Table, number: usize, labels: &Labels) -> String {
    let row = |cells: &Vec<Cell>| {
        let cells: Vec<String> = cells.iter().map(|cell| line(cell, labels)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let mut markdown = format!("\n**Table {number}.** {}\n\n", text(&table.caption));
    markdown.push_str(&row(&table.head));
    markdown.push_str(&format!("|{}\n", " --- |".repeat(table.head.len())));
    table.rows.iter().for_each(|cells| markdown.push_str(&row(cells)));
    markdown
}

/// A line of text.
fn line(inlines: &[Inline], labels: &Labels) -> String {
    let one = |inline: &Inline| match inline {
        Inline::Text(content) => text(content),
        Inline::Emphasis(content) => format!("*{}*", text(content)),
        Inline::Math(math) => inline_math(math),
        Inline::Reference(label) => match labels.get(label) {
            Some(number) => format!("({number})"),
            None => text(label),
        },
    };
    inlines.iter().map(one).collect()
}

/// A formula within a line. A bar would end a table cell and an asterisk would be markup, so commands replace them.
fn inline_math(math: &Math) -> String {
    let latex = formula(math).replace(r"\operatorname{", r"\mathrm{").replace('*', r"\ast ");
    format!("${}$", latex.replace('|', r"\vert "))
}

/// Text for paragraphs and cells. Every character that could be markup is escaped, and characters that are not
/// printable, such as those that change the direction of writing, are written as their code.
fn text(text: &str) -> String {
    let mut markdown = String::new();
    for character in text.chars() {
        match character {
            '\n' | '\t' => markdown.push(' '),
            '&' => markdown.push_str("&amp;"),
            '<' => markdown.push_str("&lt;"),
            '\\' | '`' | '*' | '_' | '[' | ']' | '>' | '#' | '|' | '$' | '~' | '!' => {
                markdown.extend(['\\', character]);
            }
            ' '..='~' | '–' | '—' | '‘' | '’' | '“' | '”' | '…' | '§' | '°' | '·' | '±' | '×' =>
            {
                markdown.push(character);
            }
            // Arrows, mathematical signs and pictographs.
            '\u{2190}'..='\u{22ff}' | '\u{1f300}'..='\u{1faff}' => markdown.push(character),
            other if other.is_alphanumeric() => markdown.push(other),
            other => markdown.push_str(&format!("\\[U+{:04X}\\]", u32::from(other))),
        }
    }
    markdown
}

/// Escapes the beginning of a line that Markdown would take for a list or a rule.
fn opened(line: &str) -> String {
    let rest = line.trim_start_matches(|character: char| character.is_ascii_digit());
    let is_number = rest.len() < line.len() && rest.starts_with(['.', ')']);
    match is_number || line.starts_with(['+', '-', '=']) {
        true => format!("{}\\{rest}", &line[..line.len() - rest.len()]),
        false => line.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_never_markup() {
        for (given, expected) in [
            ("<b> & *a* _b_ `c` $d$ |", r"&lt;b\> &amp; \*a\* \_b\_ \`c\` \$d\$ \|"),
            ("# [a](b) ![c] ~", r"\# \[a\](b) \!\[c\] \~"),
            ("é 中\u{202e}\n", r"é 中\[U+202E\] "),
        ] {
            assert_eq!(text(given), expected);
        }
    }

    #[test]
    fn paragraphs_are_not_lists() {
        for (given, expected) in [
            ("- a - b", r"\- a - b"),
            ("1. a", r"1\. a"),
            ("12) a", r"12\) a"),
            ("1.5 m", r"1\.5 m"),
            ("a", "a"),
        ] {
            assert_eq!(opened(given), expected);
        }
    }

    #[test]
    fn the_sign_at_the_start_of_a_line_is_one_between_terms() {
        let [left, right] =
            ["Q_1", "a_1 + b_2 - c_3"].map(|latex| crate::latex::read(latex).unwrap());
        let equation =
            crate::forms::Equation { name: "Q1".to_owned(), text: String::new(), left, right };
        let one = NumberedEquation { label: None, number: None, equation };
        let shown = display(&one, Layout { width: 75.0, numbers: 9 }, None).unwrap();
        assert!(shown.contains("\\quad {}- c_3"), "{shown}");
    }

    #[test]
    fn formulas_in_lines_end_no_cell() {
        let bars = Math::Fenced(crate::math::Fence::Bars, Box::new(Math::Letter('F')));
        let shown = inline_math(&bars);
        assert!(!shown.contains('|') && shown.matches(r"\vert").count() == 2, "{shown}");
    }

    #[test]
    fn references_are_numbers_of_equations() {
        let inlines = [Inline::text("see "), Inline::Reference("Q2".to_owned())];
        let numbers = [("Q1", "1"), ("Q2", "54")];
        let numbers = numbers.map(|(label, number)| (label.to_owned(), number.to_owned()));
        assert_eq!(line(&inlines, &Labels::from(numbers)), "see (54)");
    }
}
