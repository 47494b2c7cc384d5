//! Functions over columns of states.

use super::comment;
use super::function::{circular, model_argument, model_parameter, used_by};
use super::{BATCH, Header, SC};
use crate::backend::flat::{Array, Function, Statement};

/// Whether a function has a form over columns: it must have inputs, and its bodies must not be cut into parts, which
/// compilers would not vectorize.
#[must_use]
pub fn has_batch(function: &Function<'_>) -> bool {
    let is_cut = !(function.angles.parts.is_empty() && function.core.parts.is_empty());
    !is_cut && !function.inputs.is_empty()
}

/// The parameters of a function over columns: the number of states, the distance between columns, and the arrays.
pub(super) fn column_parameters(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let (real, restrict) = (header.real(), header.names.private_upper("restrict"));
    let counts = ["size_t n", "size_t stride"].map(str::to_owned).into_iter();
    let inputs = function.inputs.iter();
    let inputs = inputs.map(|array| format!("const {real} *{restrict} {}", array.name));
    let outputs = function.outputs.iter();
    let outputs = outputs.map(|array| format!("{real} *{restrict} {}", array.name));
    counts.chain(inputs).chain(outputs).collect()
}

/// Prints a statement for each parameter of a function over columns that is not read, so that compilers do not warn:
/// for unused inputs, and for the distance between columns if every array has a single one.
pub(super) fn unread(function: &Function<'_>) -> Vec<String> {
    let (used, unused): (Vec<&Array>, Vec<&Array>) =
        function.inputs.iter().partition(|array| array.is_used);
    let mut names: Vec<&str> = unused.iter().map(|array| array.name.as_str()).collect();
    if !used.into_iter().chain(&function.outputs).any(|array| array.length > 1) {
        names.push("stride");
    }
    names.iter().map(|name| format!("    (void){name};")).collect()
}

/// Prints the function with a loop over states whose entries are in columns, which compilers vectorize.
pub(super) fn batch(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    if !has_batch(function) {
        return vec![];
    }
    let plain = header.names.item(&function.name);
    let mut lines = comment::of_paragraphs(&[
        format!("`{plain}` of `n` states."),
        String::new(),
        "Entry j of state i is at `[j * stride + i]`: a column for each entry, `stride` apart; `stride` is at \
         least `n`."
            .to_owned(),
    ]);
    let mut parameters = model_parameter(header);
    parameters.extend(column_parameters(header, function));
    lines.push(format!(
        "static inline void {}({})",
        header.names.item(function.form(BATCH)),
        parameters.join(", ")
    ));
    lines.extend(["{", "    size_t i;"].map(str::to_owned));
    lines.extend(unread(function));
    lines.push("    for (i = 0; i < n; i++) {".to_owned());
    lines.extend(iteration(header, function).into_iter().map(|line| format!("    {line}")));
    lines.extend(["    }", "}", ""].map(str::to_owned));
    lines
}

/// The name of the array that holds the entries of one state.
pub(super) fn one(array: &Array) -> String {
    format!("{}_", array.name)
}

pub(super) fn place(entry: usize) -> String {
    match entry {
        0 => "i".to_owned(),
        1 => "stride + i".to_owned(),
        _ => format!("{entry} * stride + i"),
    }
}

/// Prints the computation of one state.
pub(super) fn iteration(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let real = header.real();
    let has_angles = !function.sines.is_empty();
    let in_core = used_by(function, &function.core);
    // Without angles, the arithmetic takes every input.
    let handed = |index: usize| !has_angles || in_core[index];
    let mut lines = vec![];
    let inputs = function.inputs.iter().enumerate();
    for (_, array) in inputs.filter(|(index, _)| handed(*index)) {
        let entry = |entry: usize| match array.is_used {
            true => format!("{}[{}]", array.name, place(entry)),
            false => "0".to_owned(),
        };
        let entries: Vec<String> = (0..array.length).map(entry).collect();
        lines.push(format!(
            "    const {real} {}[{}] = {{{}}};",
            one(array),
            array.length,
            entries.join(", ")
        ));
    }
    for array in &function.outputs {
        lines.push(format!("    {real} {}[{}];", one(array), array.length));
    }
    let mut arguments = model_argument(header);
    if has_angles {
        lines.extend(angles(header, function));
        arguments.extend(["s", "c"].map(str::to_owned));
    }
    let handed = function.inputs.iter().enumerate().filter(|(index, _)| handed(*index));
    arguments.extend(handed.map(|(_, array)| one(array)));
    arguments.extend(function.outputs.iter().map(one));
    let called = if has_angles { function.form(SC) } else { &function.name };
    lines.push(format!("    {}({});", header.names.item(called), arguments.join(", ")));
    for array in &function.outputs {
        for entry in 0..array.length {
            lines.push(format!("    {}[{}] = {}[{entry}];", array.name, place(entry), one(array)));
        }
    }
    lines
}

/// Prints the computation of the sines and cosines of one state.
fn angles(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let (real, expressions) = (header.real(), header.expressions(header.options.scalar));
    let length = function.sines.len();
    let mut lines = vec![format!("    {real} s[{length}], c[{length}];")];
    for statement in &function.angles.statements {
        match statement {
            Statement::Entry { name, input, entry } => lines.push(format!(
                "    const {real} {name} = {}[{}];",
                function.inputs[*input].name,
                place(*entry)
            )),
            Statement::Let { name, value } => {
                lines.push(format!("    const {real} {name} = {};", expressions.text(value)));
            }
            _ => {}
        }
    }
    for (index, angle) in function.angles.results.iter().enumerate() {
        let (sine, cosine) = (format!("s[{index}]"), format!("c[{index}]"));
        lines.extend(circular(header, &expressions.text(angle), &sine, &cosine));
    }
    lines
}
