//! The sections that the READMEs of generated packages share.

use std::fmt::Write as _;

use robot_codegen::backend::common;
use robot_codegen::{Module, Trigonometry};
use robot_model::robot::{JointKind, Robot};

use crate::driver::check::CheckValue;
use crate::driver::conventions::CONVENTIONS;
use crate::driver::generate::counts;

/// The contents of the sections.
pub(crate) struct Sections<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) module: &'a Module,
    /// The names of the parameters in the code.
    pub(crate) parameters: &'a [String],
    /// The names of the functions in the code.
    pub(crate) functions: &'a [String],
    /// The code that computes all values that depend only on the parameters.
    pub(crate) constructor: &'a str,
    pub(crate) trigonometry: Trigonometry,
    pub(crate) checks: &'a [CheckValue],
}

impl Sections<'_> {
    /// Adds the sections from the joints to the check values, which follow those about the language.
    pub(crate) fn add(&self, text: &mut String) {
        joints(text, self);
        parameters(text, self);
        functions(text, self);
        section(text, "Conventions");
        for line in CONVENTIONS.into_iter().chain([self.trigonometry.range_of_angles()]) {
            line_of(text, format_args!("- {}", plain(line)));
        }
        check_values(text, self);
    }
}

/// The name of a function in the code.
fn name_of<'s>(sections: &'s Sections<'_>, function: &'s str) -> &'s str {
    let index = sections.module.functions.iter().position(|known| known.name == function);
    index.and_then(|index| sections.functions.get(index)).map_or(function, String::as_str)
}

/// Escapes text of the robot file as plain Markdown on one line.
pub(crate) fn plain(text: &str) -> String {
    common::markdown(text).join(" ")
}

/// Adds a line.
pub(crate) fn line_of(text: &mut String, line: std::fmt::Arguments<'_>) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

/// Adds a paragraph.
pub(crate) fn paragraph(text: &mut String, line: &str) {
    line_of(text, format_args!("\n{line}"));
}

/// Starts a section.
pub(crate) fn section(text: &mut String, title: &str) {
    line_of(text, format_args!("\n## {title}\n"));
}

fn joints(text: &mut String, sections: &Sections<'_>) {
    section(text, "Joints");
    line_of(text, format_args!("| coordinate | joint | type | unit |\n|---|---|---|---|"));
    for (index, coordinate) in sections.robot.coordinates.iter().enumerate() {
        let (motion, unit) = match coordinate.kind {
            JointKind::Revolute => ("revolute", "rad"),
            JointKind::Prismatic => ("prismatic", "m"),
        };
        let (number, joint) = (index + 1, plain(&coordinate.joint));
        line_of(text, format_args!("| q{number} | {joint} | {motion} | {unit} |"));
    }
}

fn parameters(text: &mut String, sections: &Sections<'_>) {
    if sections.module.parameters.is_empty() {
        return;
    }
    section(text, "Parameters");
    line_of(text, format_args!("| field | meaning | unit | nominal |\n|---|---|---|---|"));
    let fields = sections.module.parameters.iter().zip(sections.parameters);
    for (parameter, field) in fields {
        let nominal = parameter.nominal.map(|value| format!("{value:?}")).unwrap_or_default();
        line_of(
            text,
            format_args!(
                "| {} | {} | {} | {nominal} |",
                plain(field),
                plain(&parameter.doc),
                plain(&parameter.unit),
            ),
        );
    }
}

fn functions(text: &mut String, sections: &Sections<'_>) {
    section(text, "Functions");
    // Without parameters, there is no constructor to describe.
    let has_parameters = !sections.module.parameters.is_empty();
    paragraph_of_counts(text, has_parameters.then_some(sections.constructor));
    for (name, counts) in counts(sections.module) {
        let (call, once) = (&counts.call, &counts.constructor);
        let mut columns =
            vec![call.mul, call.add, call.div, call.sqrt, call.other, call.sin, call.cos];
        if has_parameters {
            columns.extend([once.mul, once.add, once.div]);
        }
        let columns: String = columns.iter().map(|count| format!(" {count} |")).collect();
        line_of(text, format_args!("| `{}` |{columns}", name_of(sections, &name)));
    }
}

fn paragraph_of_counts(text: &mut String, constructor: Option<&str>) {
    let once = constructor.map(|constructor| {
        format!(
            "; the last three columns are the operations of `{constructor}`, once per set of parameters"
        )
    });
    let (heads, lines) = match constructor {
        Some(_) => (" once: mul | add | div |", "---|---|---|"),
        None => ("", ""),
    };
    line_of(
        text,
        format_args!(
            "Operations per call. Subtractions count as additions; sign changes are not counted{}.\n\n\
             | function | mul | add | div | sqrt | abs, sign, tanh | sin | cos |{heads}\n\
             |---|---|---|---|---|---|---|---|{lines}",
            once.unwrap_or_default()
        ),
    );
}

fn check_values(text: &mut String, sections: &Sections<'_>) {
    if sections.checks.is_empty() {
        return;
    }
    section(text, "Check values");
    let parameters = sections.checks.first().map(|check| check.parameters.as_slice());
    match parameters {
        _ if sections.module.parameters.is_empty() => {}
        Some([]) | None => line_of(text, format_args!("At the nominal parameters:\n")),
        Some(parameters) => {
            let stated: Vec<String> =
                parameters.iter().map(|(name, value)| format!("{name} = {value:?}")).collect();
            line_of(
                text,
                format_args!(
                    "At the nominal parameters; those without a nominal value are {}:\n",
                    plain(&stated.join(", "))
                ),
            );
        }
    }
    for check in sections.checks {
        line_of(text, format_args!("```text\n{}", name_of(sections, &check.function)));
        for (name, entries) in &check.inputs {
            line_of(text, format_args!("  {name} = {entries:?}"));
        }
        for output in &check.outputs {
            let values = match output.shape.as_slice() {
                [_, columns] if *columns > 0 => {
                    let rows: Vec<&[f64]> = output.values.chunks(*columns).collect();
                    format!("{rows:?}")
                }
                _ => format!("{:?}", output.values),
            };
            line_of(text, format_args!("  -> {} = {values}", output.name));
        }
        line_of(text, format_args!("```\n"));
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
}
