//! The functions of a module, and their kernels.

use super::{Printer, WORKGROUP, comment, function_name, kernel_name};
use crate::backend::common;
use crate::backend::flat::{Array, Body, Expression, Function, Statement, infix};
use crate::trigonometry::Trigonometry;

/// Prints a function, its parts, and its kernel.
pub(super) fn function(printer: &Printer<'_>, function: &Function<'_>) -> Vec<String> {
    let body = function.whole();
    let mut lines = parts(printer, &body);
    lines.extend(documentation(printer, function));
    let inputs =
        function.inputs.iter().map(|array| format!("{}: {}", array.name, of(array.length)));
    let (name, length) = (function_name(printer.tree, function), body.results.len());
    let inputs = inputs.collect::<Vec<_>>().join(", ");
    lines.push(format!("fn {name}({inputs}) -> {} {{", of(length)));
    lines.extend(statements(printer, &function.inputs, &body, &body.statements));
    let results = body.results.iter().map(|value| infix(value, printer));
    lines.push(format!("    return {}({});", of(length), results.collect::<Vec<_>>().join(", ")));
    lines.extend(["}", ""].map(str::to_owned));
    lines.extend(kernel(printer, function));
    lines
}

/// The type of an array of numbers.
fn of(length: usize) -> String {
    format!("array<f32, {length}>")
}

fn documentation(printer: &Printer<'_>, function: &Function<'_>) -> Vec<String> {
    let counts = printer.tree.module.counts(function.source);
    let names = function.inputs.iter().map(|array| array.name.as_str());
    let mut lines = common::function(function.source, names, &counts.call);
    let outputs = function.outputs.iter().map(|array| array.name.as_str());
    let heading = Some("Returns the entries of these, in this order:");
    common::add_results(&mut lines, heading, function.source, outputs);
    comment(&lines).collect()
}

fn statements(
    printer: &Printer<'_>,
    inputs: &[Array],
    body: &Body,
    statements: &[Statement],
) -> Vec<String> {
    let text = |value: &Expression| infix(value, printer);
    let lines = statements.iter().flat_map(|statement| match statement {
        Statement::Parameter { .. } => vec![],
        Statement::Entry { name, input, entry } => {
            vec![format!("let {name} = {}[{entry}];", inputs[*input].name)]
        }
        Statement::Let { name, value } => vec![format!("let {name} = {};", text(value))],
        Statement::Circular { sine, cosine, angle } => {
            circular(printer, sine, cosine, &text(angle))
        }
        Statement::Part(index) => {
            let part = &body.parts[*index];
            let given = format!("given{}_", index + 1);
            let entering = of(part.entering.len().max(1));
            let entries = match part.entering.is_empty() {
                true => "0.0f".to_owned(),
                false => part.entering.join(", "),
            };
            let name = printer.private(&part.name);
            let mut lines = vec![format!("let {given} = {name}({entering}({entries}));")];
            let leaving = part.leaving.iter().enumerate();
            lines.extend(leaving.map(|(index, name)| format!("let {name} = {given}[{index}];")));
            lines
        }
    });
    lines.map(|line| format!("    {line}")).collect()
}

fn circular(printer: &Printer<'_>, sine: &str, cosine: &str, angle: &str) -> Vec<String> {
    match printer.options.trigonometry {
        Trigonometry::Polynomial => {
            let both = format!("{sine}_and_cosine_");
            vec![
                format!("let {both} = {}({angle});", printer.private("sin_cos")),
                format!("let {sine} = {both}.x;"),
                format!("let {cosine} = {both}.y;"),
            ]
        }
        Trigonometry::Standard => {
            vec![format!("let {sine} = sin({angle});"), format!("let {cosine} = cos({angle});")]
        }
    }
}

/// Prints the functions of the parts of a very long body.
fn parts(printer: &Printer<'_>, body: &Body) -> Vec<String> {
    let mut lines = vec![];
    for part in &body.parts {
        let (entering, leaving) = (of(part.entering.len().max(1)), of(part.leaving.len().max(1)));
        let name = printer.private(&part.name);
        lines.push("// A part of the next function.".to_owned());
        lines.push(format!("fn {name}(entering_: {entering}) -> {leaving} {{"));
        for (index, name) in part.entering.iter().enumerate() {
            lines.push(format!("    let {name} = entering_[{index}];"));
        }
        lines.extend(statements(printer, &[], body, &part.statements));
        let values = match part.leaving.is_empty() {
            true => "0.0f".to_owned(),
            false => part.leaving.join(", "),
        };
        lines.push(format!("    return {leaving}({values});"));
        lines.extend(["}", ""].map(str::to_owned));
    }
    lines
}

/// Prints the kernel of a function, if the function has inputs.
fn kernel(printer: &Printer<'_>, function: &Function<'_>) -> Vec<String> {
    let Some(kernel) = kernel_name(printer.tree, function) else { return vec![] };
    let [inputs, outputs, size] = ["inputs", "outputs", "size"].map(|name| printer.private(name));
    let name = function_name(printer.tree, function);
    let text = format!(
        "// `{name}` of `n` states, by any number of workgroups in x.
@compute @workgroup_size({WORKGROUP})
fn {kernel}(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {{
    let n = {size}.n;
    let stride = {size}.stride;
    let step = groups.x * {WORKGROUP}u;
    for (var i = id.x; i < n; i += step) {{"
    );
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let mut row = 0..;
    let mut column = |_: usize| row.next().map_or(String::new(), |row| place(&inputs, row));
    let arguments = function.inputs.iter().map(|array| {
        let entries: Vec<String> = (0..array.length).map(&mut column).collect();
        format!("            {}({})", of(array.length), entries.join(", "))
    });
    let arguments: Vec<String> = arguments.collect();
    lines.push(format!("        let results_ = {name}("));
    lines.push(format!("{},", arguments.join(",\n")));
    lines.push("        );".to_owned());
    let count: usize = function.outputs.iter().map(|array| array.length).sum();
    for row in 0..count {
        lines.push(format!("        {} = results_[{row}];", place(&outputs, row)));
    }
    lines.extend(["    }", "}", ""].map(str::to_owned));
    lines
}

/// The place of an entry of the current state in a buffer.
fn place(buffer: &str, row: usize) -> String {
    match row {
        0 => format!("{buffer}[i]"),
        1 => format!("{buffer}[stride + i]"),
        _ => format!("{buffer}[{row}u * stride + i]"),
    }
}
