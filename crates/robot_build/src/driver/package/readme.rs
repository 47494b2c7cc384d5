//! The README of a generated crate, which is its documentation too.

use std::fmt::Write as _;

use robot_codegen::backend::common;
use robot_model::robot::JointKind;

use super::Parts;
use super::call::{call, model_expression};
use crate::driver::check::CheckValue;
use crate::driver::conventions::CONVENTIONS;
use crate::driver::generate::{counts, file_name, unnamed_header};

pub(super) fn readme(parts: &Parts<'_>) -> String {
    let robot = &parts.programs.robot;
    let mut text = format!(
        "<!-- {} -->\n\n# {}\n\nThe dynamics of the robot {} in plain Rust: straight-line code \
         without branches, allocation or panics, generated from `{}`. It has no dependencies.\n",
        unnamed_header(),
        robot.name,
        robot.name,
        plain(file_name(parts.source))
    );
    if let Some(description) = &robot.description {
        paragraph(&mut text, &plain(description));
    }
    if let Some(check) = parts.checks.first() {
        usage(&mut text, parts, check);
    }
    joints(&mut text, parts);
    parameters(&mut text, parts);
    functions(&mut text, parts);
    section(&mut text, "Conventions");
    for line in CONVENTIONS.into_iter().chain([parts.options.trigonometry.range_of_angles()]) {
        line_of(&mut text, format_args!("- {}", plain(line)));
    }
    check_values(&mut text, parts);
    text
}

/// Text of the robot file on one line, as Markdown that means nothing but the text.
fn plain(text: &str) -> String {
    common::markdown(text).join(" ")
}

fn line_of(text: &mut String, line: std::fmt::Arguments<'_>) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

fn paragraph(text: &mut String, line: &str) {
    line_of(text, format_args!("\n{line}"));
}

fn section(text: &mut String, title: &str) {
    line_of(text, format_args!("\n## {title}\n"));
}

fn usage(text: &mut String, parts: &Parts<'_>, check: &CheckValue) {
    section(text, "Use");
    let (name, model) = (parts.name(), model_expression(parts));
    line_of(text, format_args!("```rust\nuse {name}::*;\n\nlet model = {model};"));
    line_of(text, format_args!("let result = {};\n```", call(parts, "model", check)));
}

fn joints(text: &mut String, parts: &Parts<'_>) {
    section(text, "Joints");
    line_of(text, format_args!("| coordinate | joint | type | unit |\n|---|---|---|---|"));
    for (index, coordinate) in parts.programs.robot.coordinates.iter().enumerate() {
        let (motion, unit) = match coordinate.kind {
            JointKind::Revolute => ("revolute", "rad"),
            JointKind::Prismatic => ("prismatic", "m"),
        };
        let (number, joint) = (index + 1, plain(&coordinate.joint));
        line_of(text, format_args!("| q{number} | {joint} | {motion} | {unit} |"));
    }
}

fn parameters(text: &mut String, parts: &Parts<'_>) {
    if parts.programs.module.parameters.is_empty() {
        return;
    }
    section(text, "Parameters");
    line_of(text, format_args!("| field | meaning | unit | nominal |\n|---|---|---|---|"));
    let fields = parts.programs.module.parameters.iter().zip(&parts.names.parameters);
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

fn functions(text: &mut String, parts: &Parts<'_>) {
    section(text, "Functions");
    paragraph_of_counts(text);
    for (name, counts) in counts(&parts.programs.module) {
        let (call, once) = (&counts.call, &counts.constructor);
        let columns = [
            call.mul, call.add, call.div, call.sqrt, call.other, call.sin, call.cos, once.mul,
            once.add, once.div,
        ];
        let columns = columns.map(|count| format!(" {count} |")).concat();
        line_of(text, format_args!("| `{}` |{columns}", parts.method(&name)));
    }
}

fn paragraph_of_counts(text: &mut String) {
    line_of(
        text,
        format_args!(
            "Operations per call. Subtractions count as additions, sign changes are not counted; \
             the last columns are the operations of `Model::new`, once per set of \
             parameters.\n\n| function | mul | add | div | sqrt | abs, sign, tanh | sin | cos | \
             once: mul | add | div |\n|---|---|---|---|---|---|---|---|---|---|---|"
        ),
    );
}

fn check_values(text: &mut String, parts: &Parts<'_>) {
    if parts.checks.is_empty() {
        return;
    }
    section(text, "Check values");
    let parameters = parts.checks.first().map(|check| check.parameters.as_slice());
    match parameters {
        Some([]) | None => line_of(text, format_args!("At the nominal parameters:\n")),
        Some(parameters) => {
            let stated: Vec<String> =
                parameters.iter().map(|(name, value)| format!("{name} = {value:?}")).collect();
            line_of(
                text,
                format_args!(
                    "At the nominal parameters, and {} for parameters without a nominal value:\n",
                    plain(&stated.join(", "))
                ),
            );
        }
    }
    for check in parts.checks {
        line_of(text, format_args!("```text\n{}", check.function));
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
