//! `document`: a robot and its equations as a document.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{ArgAction, Args, ValueEnum};
use robot_build::{MARKER, Ownership};
use robot_document::document::{Block, Document};
use robot_document::robot::{Extras, document};
use robot_document::{EquationOptions, Form, equations};
use robot_document::{latex, latex::Page, markdown, typst};

use crate::Terminal;
use crate::delivery::{Delivery, ForceArgument, file_of, is_of_other_kind};
use crate::displayed::centimeters;
use crate::failure::Failure;
use crate::format::contradicts_name;
use crate::forms::{EquationArguments, FormName};
use crate::function::check_values_once;
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::values::whole;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic document robots/trttr1.toml -o trttr1.tex && pdflatex trttr1.tex
  robot-symbolic document robots/trttr1.toml --form grouped,recursive --columns 2 -o trttr1.tex
  robot-symbolic document robots/trttr1.toml -o trttr1.typ

The document contains a figure of the robot, tables of links and masses, the frames, the numbered equations in
the chosen forms, the symbols that occur with their values, and the joint torques at one state, with which an
implementation can be checked. A file NAME.typ, or --format typst, is for Typst and needs no packages; NAME.md
is Markdown without the figure, for sites such as GitHub. LaTeX needs the packages amsmath and geometry, TikZ
for the figure, and two runs for references.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    equations: EquationArguments,
    /// Forms of the equations, separated by commas
    #[arg(long, value_enum, value_delimiter = ',', action = ArgAction::Append,
          default_value = "grouped")]
    form: Vec<FormName>,
    /// Title [default: Equations of motion of NAME]
    #[arg(long, value_parser = NonEmptyStringValueParser::new())]
    title: Option<String>,
    /// Notation [default: typst for a file NAME.typ, markdown for NAME.md, else latex]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Number of columns on a page
    #[arg(long, default_value_t = 1, value_parser = whole(1..=2_u8), allow_negative_numbers = true)]
    columns: u8,
    /// Width of a column, such as 8.5cm [default: as wide as fits on A4]
    #[arg(long, value_name = "WIDTH", value_parser = centimeters, allow_hyphen_values = true)]
    width: Option<f64>,
    /// The file to write; `-` is standard output [default: -]
    #[arg(short, long, value_name = "FILE", value_parser = source_path)]
    output: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgument,
}

/// Parses the path of a document source.
fn source_path(text: &str) -> Result<PathBuf, String> {
    if text.is_empty() {
        return Err("the name is empty; name a file".to_owned());
    }
    let path = PathBuf::from(text);
    let is_typeset = path.extension().is_some_and(|extension| extension == "pdf");
    let refusal = "only sources are written: name the file NAME.tex, NAME.typ or NAME.md, and make a PDF of it with `pdflatex` or `typst compile`";
    if is_typeset { Err(refusal.to_owned()) } else { Ok(path) }
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    #[value(alias = "tex")]
    Latex,
    Typst,
    /// Markdown with formulas between $ and $$, without the figure
    Markdown,
}

impl Arguments {
    /// The notation that is chosen, or else the one given by the ending of the file's name.
    fn format(&self) -> Result<Format, Failure> {
        let extension = self.output.as_ref().and_then(|path| path.extension());
        let extension = extension.map(|extension| extension.to_string_lossy());
        let named = match extension.as_deref() {
            Some("tex" | "ltx" | "latex") => Some(Format::Latex),
            Some("typ") => Some(Format::Typst),
            Some("md") => Some(Format::Markdown),
            _ => None,
        };
        if let (Some(format), Some(named), Some(path)) = (self.format, named, &self.output)
            && format != named
        {
            return Err(contradicts_name(path));
        }
        let is_other = self.output.as_ref().is_some_and(|path| is_of_other_kind(path, ""));
        match (named.or(self.format.filter(|_| !is_other)), extension.as_deref()) {
            (Some(format), _) => Ok(format),
            (None, None) => Ok(Format::Latex),
            (None, Some(other)) => {
                let choice = if is_other { "" } else { ", or choose its notation with --format" };
                Err(Failure::Usage(vec![format!(
                    "a document is not written as .{}; name the file NAME.tex, NAME.typ or NAME.md{choice}",
                    robot_build::shown(std::path::Path::new(other))
                )]))
            }
        }
    }

    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let inputs = self.robot.inputs().into_iter().chain(self.equations.inputs());
        let writer = self.force.writer(inputs, file_of(self.output.as_deref()).is_some())?;
        // The error about an output that is an input has priority over one about its name, and this one over that about a
        // file of others.
        if let Some(path) = file_of(self.output.as_deref()) {
            writer.check(&[(path, Ownership::Edited)])?;
        }
        let format = self.format()?;
        let output = Delivery::open(self.output.as_deref(), writer)?;
        check_values_once("--form", &self.form)?;
        let forms = self.equations.forms(&self.form);
        self.equations.check(&forms, true)?;
        let mut options = self.equations.options(&self.robot, Form::default())?;
        let (robot, snaps) = self.robot.printed_with_snaps(terminal)?;
        options.order = self.equations.order(&self.robot, &robot)?;
        self.robot.check_base_frames(&forms, terminal)?;
        self.equations.check_friction(&self.robot, &robot)?;
        let failed = |error| self.equations.failed(&self.robot, &error);
        let check = robot_check::check_value(&robot, options.friction);
        let usual = Page::with_columns(self.columns);
        let page = Page { width: self.width.unwrap_or(usual.width), ..usual };
        let width = latex::Layout::of_centimeters(page.width).width;
        let extras = Extras {
            arrays: self.equations.has_arrays(&forms, true).then_some(width),
            title: self.title.as_deref(),
            figure: Some(robot_report::scheme::figure(&robot)),
            check: check.as_ref(),
            snaps: &snaps,
        };
        let derived = || document(&robot, &options, &forms, extras);
        let document = watched("deriving", terminal, derived).map_err(failed)?;
        note_length(&document, &forms, terminal)?;
        if self.equations.inputs().is_some() {
            let options = EquationOptions { form: Form::Expanded, ..options };
            let again = equations(&robot, &options).map_err(failed)?;
            self.equations.note_differences(again.differences, terminal)?;
        }
        let shown = match format {
            Format::Latex => commented("% ", "", latex::document(&document, page)),
            Format::Typst => commented("// ", "", typst::document(&document, page)),
            Format::Markdown => {
                self.without_figure(terminal)?;
                let layout = latex::Layout::of_centimeters(page.width);
                commented("<!-- ", " -->", markdown::document(&document, layout))
            }
        };
        output.deliver(&shown.map_err(failed)?, terminal)
    }

    /// Returns an error for columns in Markdown, and prints how to make the figure.
    fn without_figure(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        if self.columns > 1 {
            let message = "--columns has no effect on Markdown; leave it out";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let file = robot_build::shown(self.robot.path());
        let message = "note: a document in Markdown has no figure; `robot-symbolic scheme";
        writeln!(terminal.errors, "{message} {file} -o NAME.svg` draws it")?;
        Ok(())
    }
}

/// The largest number of equations of a document that can be read from the first page to the last.
const LONG: usize = 300;

/// Prints a note that other forms are shorter, if the document is long.
fn note_length(
    document: &Document,
    forms: &[Form],
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    let equations = document.blocks.iter().map(|block| match block {
        Block::Equations(list) => list.len(),
        _ => 0,
    });
    let count: usize = equations.sum();
    if count > LONG && forms.contains(&Form::Grouped) {
        let message = "equations; --form compact or recursive has fewer";
        writeln!(terminal.errors, "note: the document has {count} {message}")?;
    }
    Ok(())
}

/// Adds a comment before the document that states which program wrote it.
fn commented(
    start: &str,
    end: &str,
    document: Result<String, robot_document::Error>,
) -> Result<String, robot_document::Error> {
    Ok(format!("{start}{MARKER}{end}\n{}", document?))
}

#[cfg(test)]
mod tests {
    use robot_document::document::NumberedEquation;
    use robot_document::forms::Equation;
    use robot_document::math::Math;

    use super::*;

    /// The messages about a document that has lists of so many equations.
    fn note(lengths: &[usize], forms: &[Form]) -> String {
        let [left, right] = [Math::Letter('a'), Math::Letter('b')];
        let equation = Equation { name: "a".to_owned(), text: "b".to_owned(), left, right };
        let one = NumberedEquation { label: None, number: None, equation };
        let lists = lengths.iter().map(|length| Block::Equations(vec![one.clone(); *length]));
        let document = Document { title: String::new(), blocks: lists.collect() };
        let mut errors = vec![];
        let mut terminal = Terminal {
            input: &mut std::io::empty(),
            output: &mut std::io::sink(),
            errors: &mut errors,
            colors: false,
            progress: false,
            screen: None,
        };
        assert!(note_length(&document, forms, &mut terminal).is_ok());
        String::from_utf8(errors).unwrap()
    }

    #[test]
    fn shorter_forms_are_named_above_the_longest_document_and_not_at_it() {
        let grouped = [Form::Expanded, Form::Grouped];
        for lengths in [&[LONG][..], &[LONG - 1, 1], &[]] {
            assert_eq!(note(lengths, &grouped), "", "{lengths:?}");
        }
        for lengths in [&[LONG + 1][..], &[1, LONG]] {
            let start = format!("note: the document has {} equations; ", LONG + 1);
            assert!(note(lengths, &grouped).starts_with(&start), "{lengths:?}");
        }
        assert_eq!(note(&[LONG + 1], &[Form::Expanded]), "");
    }
}
