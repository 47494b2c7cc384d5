//! The README of a generated crate, which is also its documentation.

use super::Parts;
use super::call::{call, model_expression};
use crate::driver::check::CheckValue;
use crate::driver::generate::{file_name, unnamed_header};
use crate::driver::readme::{Sections, line_of, paragraph, plain, section};

pub(super) fn readme(parts: &Parts<'_>) -> String {
    let robot = &parts.programs.robot;
    let mut text = format!(
        "<!-- {} -->\n\n# {}\n\nThe dynamics of the robot {} in plain Rust: straight-line code \
         without branches, allocation or panics, generated from `{}`. It has no dependencies.\n",
        unnamed_header(),
        robot.name,
        robot.name,
        plain(&file_name(parts.source))
    );
    if let Some(description) = &robot.description {
        paragraph(&mut text, &plain(description));
    }
    if let Some(check) = parts.checks.first() {
        usage(&mut text, parts, check);
    }
    let sections = Sections {
        robot,
        module: &parts.programs.module,
        parameters: &parts.names.parameters,
        functions: &parts.names.functions,
        constructor: "Model::new",
        trigonometry: parts.options.trigonometry,
        checks: parts.checks,
    };
    sections.add(&mut text);
    text
}

fn usage(text: &mut String, parts: &Parts<'_>, check: &CheckValue) {
    section(text, "Use");
    let (name, model) = (parts.name(), model_expression(parts));
    line_of(text, format_args!("```rust\nuse {name}::*;\n\nlet model = {model};"));
    line_of(text, format_args!("let result = {};\n```", call(parts, "model", check)));
}
