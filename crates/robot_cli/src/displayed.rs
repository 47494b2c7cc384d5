//! Displayed equations, which several commands print.

use clap::Args;
use robot_document::document::NumberedEquation;
use robot_document::html::{self, PageOptions};
use robot_document::latex::{self, Layout};
use robot_document::{Equation, Error, Group, markdown, typst};

use crate::Terminal;
use crate::failure::Failure;
use crate::forms::no_effect;

/// The range of valid widths of lines, in cm.
const WIDTHS: std::ops::RangeInclusive<f64> = 3.0..=100.0;

/// The default width of lines, in cm.
const WIDTH: f64 = 16.0;

/// The width of the number of an equation, with its distance from the equation, in pt.
const NUMBER: f64 = 44.0;

/// How displayed equations are laid out.
#[derive(Args)]
pub(crate) struct LayoutArguments {
    /// The line width of LaTeX, Typst and MathML, such as 8.5cm [default: 16cm]
    #[arg(long, value_name = "WIDTH", value_parser = centimeters, allow_hyphen_values = true)]
    width: Option<f64>,
    /// Number the equations; in LaTeX and Typst they get labels such as eq:Q1
    #[arg(long)]
    numbers: bool,
}

/// A notation of displayed equations.
#[derive(Clone, Copy)]
pub(crate) enum Notation {
    Latex,
    Typst,
    Markdown,
    /// An HTML page with MathML.
    Mathml {
        /// Whether the page contains the font of its equations.
        has_font: bool,
    },
}

impl Notation {
    /// An HTML page. On a terminal it does not contain its font, which would be a very long line; a note says so.
    pub(crate) fn page(terminal: &mut Terminal<'_>) -> Result<Notation, Failure> {
        let has_font = terminal.screen.is_none();
        if !has_font {
            writeln!(
                terminal.errors,
                "note: on a terminal the page is printed without its font; write it to a file, as with `> page.html`"
            )?;
        }
        Ok(Notation::Mathml { has_font })
    }
}

impl LayoutArguments {
    /// Returns an error for options that would have no effect because nothing is typeset.
    pub(crate) fn check(&self, typeset: bool) -> Result<(), Failure> {
        let given = [("--width", self.width.is_some()), ("--numbers", self.numbers)];
        let wrong: Vec<String> = given
            .into_iter()
            .filter(|(_, given)| *given && !typeset)
            .map(|(option, _)| no_effect(option))
            .collect();
        if wrong.is_empty() { Ok(()) } else { Err(Failure::Usage(wrong)) }
    }

    /// The width for an equation without its number, in pt.
    pub(crate) fn line(&self) -> f64 {
        let layout = Layout::of_centimeters(self.width.unwrap_or(WIDTH));
        layout.width - if self.numbers { NUMBER } else { 0.0 }
    }

    /// Returns an error for numbers in Markdown, whose equations do not have any.
    pub(crate) fn check_markdown(&self) -> Result<(), Failure> {
        let message = "--numbers has no effect on Markdown; leave it out";
        if self.numbers { Err(Failure::Usage(vec![message.to_owned()])) } else { Ok(()) }
    }

    /// Prints displayed equations, with a comment before each group if there are several; a page has the title.
    pub(crate) fn displayed(
        &self,
        title: &str,
        groups: &[Group],
        notation: Notation,
    ) -> Result<String, Error> {
        let layout = Layout::of_centimeters(self.width.unwrap_or(WIDTH));
        let (comment, print): (_, Print) = match notation {
            Notation::Latex => ("%", latex::equations),
            Notation::Typst => ("//", typst::equations),
            Notation::Markdown => ("##", markdown::equations),
            Notation::Mathml { has_font } => {
                let options = PageOptions { layout, numbered: self.numbers, has_font };
                return html::page(title, groups, options);
            }
        };
        let mut shown = String::new();
        for group in groups {
            if groups.len() > 1 {
                let gap = match notation {
                    Notation::Markdown if !shown.is_empty() => "\n",
                    _ => "",
                };
                shown.push_str(&format!("{gap}{comment} {}\n", group.title));
            }
            let numbered = |equation: &Equation| {
                group.numbered(equation, self.numbers.then(|| equation.label()))
            };
            let list: Vec<NumberedEquation> = group.equations.iter().map(numbered).collect();
            shown.push_str(&print(&list, layout)?);
        }
        Ok(shown)
    }
}

/// A printer of displayed equations.
type Print = fn(&[NumberedEquation], Layout) -> Result<String, Error>;

/// Parses a length in cm: `8.5cm` or `8.5`.
pub(crate) fn centimeters(text: &str) -> Result<f64, String> {
    let digits = text.strip_suffix("cm").unwrap_or(text).trim();
    let width: Option<f64> = digits.parse().ok();
    let width = width.filter(|width| WIDTHS.contains(width));
    width
        .ok_or_else(|| "a width is a number of centimeters from 3 to 100, such as 8.5cm".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_centimeters_and_numbers_take_room() {
        assert_eq!(centimeters("8.5cm"), Ok(8.5));
        assert_eq!([centimeters("3"), centimeters(" 100 cm")], [Ok(3.0), Ok(100.0)]);
        for text in ["2.9", "100.1cm", "-8", "nan", "cm", "8mm", ""] {
            assert!(
                centimeters(text).is_err_and(|error| error.contains("from 3 to 100")),
                "{text}"
            );
        }
        let line = |width, numbers| LayoutArguments { width, numbers }.line();
        assert_eq!(line(Some(2.54), false), 72.27);
        assert_eq!(line(Some(2.54), true), 72.27 - NUMBER);
        assert_eq!(line(None, false), line(Some(16.0), false));
    }

    #[test]
    fn numbers_are_refused_if_there_are_none() {
        let refused =
            |width, numbers, typeset| match (LayoutArguments { width, numbers }).check(typeset) {
                Ok(()) => vec![],
                Err(Failure::Usage(wrong)) => wrong,
                Err(other) => panic!("{other:?}"),
            };
        assert_eq!(refused(Some(8.0), true, true).len() + refused(None, false, false).len(), 0);
        let both = refused(Some(8.0), true, false);
        assert!(
            both.len() == 2 && both[0].starts_with("--width ") && both[1].starts_with("--numbers ")
        );
        assert_eq!(refused(None, true, false), [no_effect("--numbers")]);
        let markdown = |numbers| LayoutArguments { width: None, numbers }.check_markdown();
        assert!(markdown(false).is_ok() && markdown(true).is_err());
    }
}
