//! The choice of the equations that a command prints, and of their form.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::{RobotFile, shown};
use robot_check::errata;
use robot_document::{
    DIGITS, Differences, Equations, Error, Form, Letters, TermOrder, Trigonometry,
};
use robot_dynamics::quantity::Kind;
use robot_model::robot::Robot;
use robot_symbolic::AngleSums;

use crate::Terminal;
use crate::failure::Failure;
use crate::friction::has_friction;
use crate::function::check_once;
use crate::robot::RobotArgument;
use crate::suggested::QUANTITY;
use crate::text;
use crate::values::whole;

/// How equations are written.
#[derive(Args)]
pub(crate) struct EquationArguments {
    /// Quantities: a_c, F, M_c, F_l, M_l, Q, or all; the forms grouped, recursive and regrouped have only Q
    #[arg(long = "quantity", value_name = "NAMES", value_delimiter = ',', default_value = "Q",
          value_parser = QUANTITY, hide_possible_values = true)]
    quantities: Vec<String>,
    /// Sines and cosines in LaTeX, Typst and MathML [default: named]
    #[arg(long, value_enum)]
    trig: Option<TrigonometryStyle>,
    /// Sines and cosines of sums of angles of parallel joints, in all forms except recursive [default: expand in
    /// the form expanded, else keep]
    #[arg(long, value_enum)]
    angle_sums: Option<AngleSumStyle>,
    /// In the forms collected, grouped and regrouped, write sin(2q) for 2 sin q cos q, and cos(2q) for 1 - 2 sin(q)^2 and
    /// 2 cos(q)^2 - 1
    #[arg(long, conflicts_with = "expand")]
    double_angles: bool,
    /// In the forms grouped and regrouped, multiply the coefficients out instead of factoring them
    #[arg(long)]
    expand: bool,
    /// In the grouped form, write every coefficient out instead of expressing some by earlier ones
    #[arg(long)]
    no_references: bool,
    /// In the grouped form, print Christoffel symbols instead of Coriolis and centrifugal coefficients
    #[arg(long)]
    christoffel: bool,
    /// Vectors as columns and coefficients as matrices, or an equation for each entry [default: vectors in the forms
    /// grouped and recursive in LaTeX, Typst, Markdown and MathML, else scalars]
    #[arg(long, value_enum)]
    layout: Option<LayoutStyle>,
    /// Print equations in the order, form and symbols of the paper on TRTTR1: all quantities multiplied out, terms as
    /// the paper's relations yield them, vectors as columns, those in the joints from the last link to the first,
    /// sines and cosines as sq_2 and cq_2
    #[arg(long, value_enum, conflicts_with_all = ["quantities", "form", "trig", "layout", "expand", "christoffel", "double_angles",
          "no_references", "letters"])]
    style: Option<StyleName>,
    /// Print equations like the published ones in this file, in the format that `compare` reads: in the paper's
    /// style, with terms and factors in the order of the file, and with its numbers
    #[arg(long, value_name = "PRINTED", conflicts_with_all = ["quantities", "form", "trig", "layout", "expand", "christoffel", "double_angles",
          "no_references", "letters"])]
    like: Option<PathBuf>,
    /// Letters for joint torques, mass matrix, Coriolis and centrifugal terms, and gravity terms, such as tau,M,C,g;
    /// `field` for these four, `paper` for Q and letters that no symbol of the robot uses, but always g [default: paper];
    /// the letter C stands for the matrix in C(q, q̇) q̇, as with --christoffel
    #[arg(long, value_name = "LETTERS", value_parser = Letters::parse)]
    letters: Option<Letters>,
    /// Significant digits of decimals in equations; 17 prints all [default: 10]
    #[arg(long, value_name = "N", value_parser = whole(1..=ALL_DIGITS), allow_negative_numbers = true)]
    digits: Option<u8>,
    /// Include friction in the joint torques
    #[arg(long)]
    friction: bool,
}

/// A form of the equations.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum FormName {
    /// Sums of products, with like terms merged
    Expanded,
    /// Common factors in front of parentheses, sums of angles
    Collected,
    /// Mass matrix, Coriolis and centrifugal terms, gravity terms
    Grouped,
    /// Link by link, each quantity from the previous ones
    Recursive,
    /// Names for repeated expressions
    Compact,
    /// Linear in the base parameters
    Regrouped,
}

impl From<FormName> for Form {
    fn from(name: FormName) -> Form {
        match name {
            FormName::Expanded => Form::Expanded,
            FormName::Collected => Form::Collected,
            FormName::Grouped => Form::Grouped,
            FormName::Recursive => Form::Recursive,
            FormName::Compact => Form::Compact,
            FormName::Regrouped => Form::Regrouped,
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum TrigonometryStyle {
    /// \sin q_2
    Named,
    /// s_2
    Short,
    /// sq_2
    Paper,
}

#[derive(Clone, Copy, ValueEnum)]
enum AngleSumStyle {
    /// \sin q_2 \cos q_3 + \cos q_2 \sin q_3
    Expand,
    /// \sin(q_2 + q_3)
    Keep,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LayoutStyle {
    /// Columns and matrices where they fit
    Vectors,
    /// An equation for each entry
    Scalars,
}

#[derive(Clone, Copy, ValueEnum)]
enum StyleName {
    /// That of "The dynamic model of TRTTR1 modular serial robot"
    Paper,
}

impl EquationArguments {
    /// Whether the equations have the style of the paper.
    fn has_style(&self) -> bool {
        self.style.is_some() || self.like.is_some()
    }

    /// The files from which the equations are made, in addition to the robot file.
    pub(crate) fn inputs(&self) -> Option<PathBuf> {
        self.like.clone()
    }

    /// The order of terms in the published equations.
    pub(crate) fn order(&self, file: &RobotArgument, robot: &Robot) -> Result<TermOrder, Failure> {
        let Some(path) = &self.like else { return Ok(TermOrder::default()) };
        let printed = RobotFile::read(path)?.source;
        let options = errata::Options { notation: None, snap: file.snap() };
        let found = errata::term_order(robot, &printed, &options);
        found.map_err(|errors| Failure::Robot(errors.into()))
    }

    /// The forms that a style prints, or those that are chosen.
    pub(crate) fn forms(&self, asked: &[FormName]) -> Vec<Form> {
        if self.has_style() {
            return vec![Form::Expanded];
        }
        asked.iter().map(|form| Form::from(*form)).collect()
    }

    /// Whether vectors are columns and coefficients matrices. By default they are if formulas are typeset in a form
    /// that consists of them.
    pub(crate) fn has_arrays(&self, forms: &[Form], typeset: bool) -> bool {
        let consists = forms.iter().any(|form| matches!(form, Form::Grouped | Form::Recursive));
        let usual = typeset && consists || self.has_style();
        self.layout.map_or(usual, |layout| layout == LayoutStyle::Vectors)
    }

    /// Returns an error if vectors are asked for and the equations have no matrices or columns.
    pub(crate) fn check_layout(&self, equations: &Equations) -> Result<(), Failure> {
        if self.layout != Some(LayoutStyle::Vectors) || equations.arrays().next().is_some() {
            return Ok(());
        }
        Err(Failure::Usage(vec![
            "--layout vectors has no effect on these equations, which have neither vectors nor matrices; choose the form \
             grouped or recursive, or vectors with --quantity, or leave it out"
                .to_owned(),
        ]))
    }

    /// Returns an error for options that would have no effect in these forms, or because nothing is typeset.
    pub(crate) fn check(&self, forms: &[Form], typeset: bool) -> Result<(), Failure> {
        let mut wrong = vec![];
        if self.christoffel && !forms.contains(&Form::Grouped) {
            wrong.push(
                "--christoffel has no effect in this form; add --form grouped, or leave it out"
                    .to_owned(),
            );
        }
        if self.angle_sums.is_some() && forms.iter().all(|form| *form == Form::Recursive) {
            wrong.push(
                "--angle-sums has no effect in the recursive form; choose another form, or leave it out"
                    .to_owned(),
            );
        }
        let is_factored =
            |form: &Form| matches!(form, Form::Collected | Form::Grouped | Form::Regrouped);
        if self.double_angles && !forms.iter().any(is_factored) {
            wrong.push(
                "--double-angles has no effect in this form; add --form collected, grouped or regrouped, or leave it out"
                    .to_owned(),
            );
        }
        if self.no_references && !forms.contains(&Form::Grouped) {
            wrong.push(
                "--no-references has no effect in this form; add --form grouped, or leave it out"
                    .to_owned(),
            );
        }
        let has_coefficients = |form: &Form| matches!(form, Form::Grouped | Form::Regrouped);
        if self.expand && !forms.iter().any(has_coefficients) {
            wrong.push(
                "--expand has no effect in this form; add --form grouped or regrouped, or leave it out"
                    .to_owned(),
            );
        }
        let only_torques =
            |form: &Form| matches!(form, Form::Grouped | Form::Regrouped | Form::Recursive);
        let torque = Kind::JointTorque.name();
        let has_torques = self.quantities.iter().any(|name| name == torque || name == "all");
        if self.quantities.iter().any(|name| name != torque) && forms.iter().all(only_torques) {
            let names = self.quantities.join(",");
            wrong.push(format!(
                "--quantity {names} has no effect in this form, which has only {torque}; choose another form, or leave it \
                 out"
            ));
        }
        if self.letters.is_some() && !has_torques && !forms.iter().any(only_torques) {
            wrong.push(format!(
                "--letters has no effect on these quantities; add {torque}, or leave it out"
            ));
        }
        if self.trig.is_some() && !typeset {
            wrong.push(no_effect("--trig"));
        }
        if wrong.is_empty() { Ok(()) } else { Err(Failure::Usage(wrong)) }
    }

    /// The number of significant digits of decimals, if it is given.
    pub(crate) fn digits(&self) -> Option<usize> {
        self.digits.map(usize::from)
    }

    /// Prints a note on a terminal that decimals are rounded, unless an option sets the digits.
    pub(crate) fn note_rounding(
        &self,
        equations: &Equations,
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        note_rounding(equations.rounded && self.digits.is_none(), terminal)
    }

    /// Prints how many equations of the file given by `--like` differ from the derived ones.
    pub(crate) fn note_differences(
        &self,
        Differences { without_common_terms, compared }: Differences,
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        if let Some(path) = self.like.as_ref().filter(|_| without_common_terms > 0) {
            let file = shown(path);
            let message = format!(
                "{without_common_terms} of the {compared} equations in {file} have no term in common with those of \
                 this robot, which are printed in an order of their own; is this the right file for the robot?"
            );
            writeln!(terminal.errors, "warning: {message}")?;
        }
        Ok(())
    }

    /// Converts an error in the equations of a robot file. Messages of the library mention at most the values of the
    /// options that help.
    pub(crate) fn failed(&self, robot: &RobotArgument, error: &Error) -> Failure {
        let remedy = match error {
            Error::TooLong { .. } | Error::TooMany { .. } | Error::TooManyExpressions { .. } => {
                "--form"
            }
            Error::LikeSine { .. } => "--trig named",
            Error::TakenLetter { .. } => "--letters",
            Error::TakenArray { .. } => "--layout scalars",
            Error::Narrow { .. } => "--width, or --form compact, which has the shortest parts",
            _ => return failed(robot, error),
        };
        // A style determines the form, the sines and the letters.
        let condition = match (&self.like, self.has_style()) {
            (Some(_), _) => ", without --like",
            (None, true) => ", without --style",
            (None, false) => "",
        };
        Failure::input(format!("{}: {error} ({remedy}{condition})", shown(robot.path())))
    }

    /// Returns an error if friction is chosen but the robot does not have any.
    pub(crate) fn check_friction(
        &self,
        file: &RobotArgument,
        robot: &Robot,
    ) -> Result<(), Failure> {
        if self.friction { has_friction(&shown(file.path()), robot) } else { Ok(()) }
    }

    /// The options for equations in the chosen form.
    pub(crate) fn options(
        &self,
        robot: &RobotArgument,
        form: Form,
    ) -> Result<robot_document::EquationOptions, Failure> {
        Ok(robot_document::EquationOptions {
            form,
            kinds: match self.has_style() {
                true => Kind::ALL.to_vec(),
                false => kinds(&self.quantities)?,
            },
            friction: self.friction,
            snap: robot.snap(),
            trigonometry: match self.trig.unwrap_or(match self.has_style() {
                true => TrigonometryStyle::Paper,
                false => TrigonometryStyle::Named,
            }) {
                TrigonometryStyle::Named => Trigonometry::Named,
                TrigonometryStyle::Short => Trigonometry::Short,
                TrigonometryStyle::Paper => Trigonometry::Paper,
            },
            angle_sums: self.angle_sums.map(|style| match style {
                AngleSumStyle::Expand => AngleSums::Expand,
                AngleSumStyle::Keep => AngleSums::Keep,
            }),
            double_angles: self.double_angles,
            expand: self.expand,
            references: !self.no_references,
            christoffel: self.christoffel,
            paper: self.has_style(),
            order: TermOrder::default(),
            letters: self.letters.clone().unwrap_or_default(),
            digits: Some(self.digits().unwrap_or(DIGITS)),
            rounds_roots: self.digits.is_none_or(|digits| digits < ALL_DIGITS),
        })
    }
}

/// The number of significant digits with which a double is printed exactly.
const ALL_DIGITS: u8 = 17;

/// The message that JSON does not have rounded digits.
pub(crate) const NO_DIGITS: &str =
    "--digits has no effect on JSON, whose equations are exact; leave it out";

/// Prints a note that decimals are rounded, if they are and standard error is a terminal. The errors of rounding are far
/// below the accuracy of any parameter, so programs that run this one do not need the note.
pub(crate) fn note_rounding(is_rounded: bool, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    if is_rounded && terminal.progress {
        let message = "significant digits; --digits 17 prints all";
        writeln!(terminal.errors, "note: decimals are rounded to {DIGITS} {message}")?;
    }
    Ok(())
}

/// The message about an option of typeset formulas if nothing is typeset.
pub(crate) fn no_effect(option: &str) -> String {
    format!(
        "{option} has no effect on text and JSON; add --format latex, typst, markdown or mathml, or leave it out"
    )
}

/// Converts an error in equations that have one form, such as those of the base parameters.
pub(crate) fn failed(robot: &RobotArgument, error: &Error) -> Failure {
    let remedy = if let Error::Narrow { .. } = error { " (--width)" } else { "" };
    Failure::input(format!("{}: {error}{remedy}", shown(robot.path())))
}

/// Finds the quantities with these names.
fn kinds(names: &[String]) -> Result<Vec<Kind>, Failure> {
    check_once("--quantity", names)?;
    let (mut kinds, mut wrong): (Vec<Kind>, _) = (vec![], vec![]);
    let mut known: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    known.push("all");
    for name in names {
        match (name.as_str(), Kind::from_name(name)) {
            ("all", _) if names.len() == 1 => return Ok(Kind::ALL.to_vec()),
            ("all", _) => {
                wrong.push(
                    "--quantity: `all` selects all quantities; leave the others out".to_owned(),
                );
            }
            (_, Some(kind)) => kinds.push(kind),
            _ => wrong.push(text::unknown("quantity", name, &known)),
        }
    }
    if wrong.is_empty() { Ok(kinds) } else { Err(Failure::Usage(wrong)) }
}
