//! The functions of a module: one that takes the state, and one that takes sines and cosines.

use std::collections::BTreeSet;

use super::batch;
use super::comment;
use super::cuda;
use super::spelling::{helper, library};
use super::{Dialect, Header, SC, vectors};
use crate::backend::common::{self, Scalar};
use crate::backend::flat::{Array, Body, Expression, Function, Part, Statement};
use crate::trigonometry::Trigonometry;

/// Prints all functions of C for one function of the module.
pub(super) fn function(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let scalar = header.options.scalar;
    let mut lines = parts(header, &function.angles, scalar);
    lines.extend(parts(header, &function.core, scalar));
    if function.sines.is_empty() {
        lines.extend(doc(header, function));
        lines.extend(arithmetic(header, function, &header.names.item(&function.name)));
    } else {
        let sc = header.names.item(function.form(SC));
        lines.extend(comment::of_paragraphs(&[format!(
            "`{}`, given the sines `s` and cosines `c` of its angles: {}.",
            header.names.item(&function.name),
            angles(header, function)
        )]));
        lines.extend(arithmetic(header, function, &sc));
        lines.extend(doc(header, function));
        lines.extend(whole(header, function, &sc));
    }
    lines.extend(match header.dialect {
        Dialect::C => batch::batch(header, function),
        Dialect::Cuda => cuda::kernel(header, function),
    });
    lines
}

fn doc(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let counts = header.tree.module.counts(function.source);
    let names = function.inputs.iter().map(|input| input.name.as_str());
    let mut lines = common::function(function.source, names, &counts.call);
    let outputs = function.outputs.iter().map(|array| array.name.as_str());
    common::add_results(&mut lines, None, function.source, outputs);
    comment::of_paragraphs(&lines)
}

/// The angles in the documentation, if they are plain expressions.
fn angles(header: &Header<'_>, function: &Function<'_>) -> String {
    let is_plain = |statement: &Statement| matches!(statement, Statement::Entry { .. });
    if !function.angles.statements.iter().all(is_plain) {
        return format!("those that `{}` computes", header.names.item(&function.name));
    }
    let expressions = header.expressions(header.options.scalar);
    let texts = function.angles.results.iter().map(|angle| expressions.text(angle));
    texts.collect::<Vec<_>>().join(", ")
}

/// The parameter `const ur5_model *model`, if the module has parameters.
pub(super) fn model_parameter(header: &Header<'_>) -> Vec<String> {
    let has = header.tree.has_parameters();
    has.then(|| format!("const {} *model", header.names.item("model"))).into_iter().collect()
}

fn input(header: &Header<'_>, array: &Array) -> String {
    format!("const {} {}[{}]", header.real(), array.name, array.length)
}

fn outputs(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let restrict = header.names.private_upper("restrict");
    let outputs = function.outputs.iter();
    outputs.map(|array| format!("{} *{restrict} {}", header.real(), array.name)).collect()
}

/// Prints the function that computes the outputs from sines, cosines and the other inputs that it reads; without
/// angles, from all inputs.
fn arithmetic(header: &Header<'_>, function: &Function<'_>, name: &str) -> Vec<String> {
    let mut parameters = model_parameter(header);
    let has_angles = !function.sines.is_empty();
    let used = used_by(function, &function.core);
    if has_angles {
        let length = function.sines.len();
        let arrays = ["s", "c"].map(|name| format!("const {} {name}[{length}]", header.real()));
        parameters.extend(arrays);
    }
    let taken = function.inputs.iter().zip(&used).filter(|(_, used)| !has_angles || **used);
    parameters.extend(taken.map(|(array, _)| input(header, array)));
    parameters.extend(outputs(header, function));
    let mut lines =
        vec![format!("{} void {name}({})", header.inline(), parameters.join(", ")), "{".to_owned()];
    let mut sink = ignored(header, &[&function.core]);
    for (array, used) in function.inputs.iter().zip(&used) {
        if !has_angles && !used {
            sink.push(format!("    (void){};", array.name));
        }
    }
    lines.extend(sink);
    let read = read_by(&function.core);
    let mut loads = vec![];
    for (names, array) in [(&function.sines, "s"), (&function.cosines, "c")] {
        let read_any = names.iter().any(|name| read.contains(name));
        if has_angles && !read_any {
            lines.push(format!("    (void){array};"));
        }
        for (index, name) in names.iter().enumerate().filter(|(_, name)| read.contains(*name)) {
            let line = format!("    const {} {name} = {array}[{index}];", header.real());
            loads.push((name.clone(), line));
        }
    }
    lines.extend(statements_of(header, function, &function.core, loads));
    lines.extend(stores(header, function));
    lines.extend(["}".to_owned(), String::new()]);
    lines
}

/// The variables that a body reads.
fn read_by(body: &Body) -> BTreeSet<String> {
    let mut read = BTreeSet::new();
    body.each_expression(&mut |value| {
        if let Expression::Variable(name) = value {
            read.insert(name.clone());
        }
    });
    read.extend(body.parts.iter().flat_map(|part| part.entering.iter().cloned()));
    read
}

/// For each input, whether a body reads an entry of it.
pub(super) fn used_by(function: &Function<'_>, body: &Body) -> Vec<bool> {
    let reads = |index: usize| {
        let reads = |statement: &Statement| matches!(statement, Statement::Entry { input, .. } if *input == index);
        body.statements.iter().any(reads)
    };
    (0..function.inputs.len()).map(reads).collect()
}

/// Prints `(void)model;` if no body reads the model.
fn ignored(header: &Header<'_>, bodies: &[&Body]) -> Vec<String> {
    let unused = header.tree.has_parameters() && !bodies.iter().any(|body| body.reads_fields());
    unused.then(|| "    (void)model;".to_owned()).into_iter().collect()
}

/// Prints the function that takes the inputs and computes the angles, their sines and cosines, and the arithmetic.
fn whole(header: &Header<'_>, function: &Function<'_>, sc: &str) -> Vec<String> {
    let real = header.real();
    let mut parameters = model_parameter(header);
    parameters.extend(function.inputs.iter().map(|array| input(header, array)));
    parameters.extend(outputs(header, function));
    let name = header.names.item(&function.name);
    let mut lines =
        vec![format!("{} void {name}({})", header.inline(), parameters.join(", ")), "{".to_owned()];
    for array in function.inputs.iter().filter(|array| !array.is_used) {
        lines.push(format!("    (void){};", array.name));
    }
    lines.extend(statements_of(header, function, &function.angles, vec![]));
    let expressions = header.expressions(header.options.scalar);
    let angles = function.angles.results.iter().map(|angle| expressions.text(angle));
    let length = function.sines.len();
    lines.push(format!(
        "    const {real} angles[{length}] = {{{}}};",
        angles.collect::<Vec<_>>().join(", ")
    ));
    lines.push(format!("    {real} s[{length}], c[{length}];"));
    lines.extend(circular_of_array(header, length));
    let mut arguments: Vec<String> = model_argument(header);
    arguments.extend(["s", "c"].map(str::to_owned));
    let used = used_by(function, &function.core);
    let used = function.inputs.iter().zip(used).filter(|(_, used)| *used);
    arguments.extend(used.map(|(array, _)| array.name.clone()));
    arguments.extend(function.outputs.iter().map(|array| array.name.clone()));
    lines.push(format!("    {sc}({});", arguments.join(", ")));
    lines.extend(["}".to_owned(), String::new()]);
    lines
}

/// The argument `model`, if the module has parameters.
pub(super) fn model_argument(header: &Header<'_>) -> Vec<String> {
    header.tree.has_parameters().then(|| "model".to_owned()).into_iter().collect()
}

/// Prints the statements that store the sines and cosines of `length` angles in `s` and `c`.
fn circular_of_array(header: &Header<'_>, length: usize) -> Vec<String> {
    let is_polynomial = header.options.trigonometry == Trigonometry::Polynomial;
    if is_polynomial && header.dialect == Dialect::C && length > 1 {
        let several = header.names.private(&helper(&vectors::name(length), header.options.scalar));
        return vec![format!("    {several}(angles, s, c);")];
    }
    let mut lines = vec!["    int i;".to_owned(), format!("    for (i = 0; i < {length}; i++) {{")];
    lines.extend(circular(header, "angles[i]", "s[i]", "c[i]").map(|line| format!("    {line}")));
    lines.push("    }".to_owned());
    lines
}

/// Prints the statements that store the sine and cosine of an angle in two places.
pub(super) fn circular(
    header: &Header<'_>,
    angle: &str,
    sine: &str,
    cosine: &str,
) -> impl Iterator<Item = String> {
    let scalar = header.options.scalar;
    let lines = match header.options.trigonometry {
        Trigonometry::Polynomial => {
            let name = header.names.private(&helper("sin_cos", scalar));
            vec![format!("    {name}({angle}, &{sine}, &{cosine});")]
        }
        Trigonometry::Standard => vec![
            format!("    {sine} = {}({angle});", library("sin", scalar)),
            format!("    {cosine} = {}({angle});", library("cos", scalar)),
        ],
    };
    lines.into_iter()
}

/// Prints the statements that store the results as entries of the outputs.
fn stores(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let expressions = header.expressions(header.options.scalar);
    let mut results = function.core.results.iter();
    let mut lines = vec![];
    for output in &function.outputs {
        for (index, value) in results.by_ref().take(output.length).enumerate() {
            lines.push(format!("    {}[{index}] = {};", output.name, expressions.text(value)));
        }
    }
    lines
}

/// Prints the statements of a body, with each load directly before the first statement that reads it: compilers that
/// keep the order then hold fewer numbers at a time. All loads come before the stores. `loads` are the loads of sines
/// and cosines.
fn statements_of(
    header: &Header<'_>,
    function: &Function<'_>,
    body: &Body,
    mut loads: Vec<(String, String)>,
) -> Vec<String> {
    let scalar = header.options.scalar;
    let printed = |one| statement(header, &function.inputs, body, one, scalar);
    for one in &body.statements {
        if let Statement::Entry { name, .. } = one {
            loads.extend(printed(one).into_iter().map(|line| (name.clone(), line)));
        }
    }
    let mut lines = vec![];
    for one in &body.statements {
        if matches!(one, Statement::Entry { .. }) {
            continue;
        }
        let read = variables(one, body);
        lines.extend(loads.extract_if(.., |(name, _)| read.contains(name)).map(|(_, line)| line));
        lines.extend(printed(one));
    }
    // The loads that only the results read.
    lines.extend(loads.into_iter().map(|(_, line)| line));
    lines
}

/// The variables that a statement of a body reads.
fn variables(statement: &Statement, body: &Body) -> BTreeSet<String> {
    let mut read = BTreeSet::new();
    if let Statement::Part(index) = statement {
        read.extend(body.parts[*index].entering.iter().cloned());
    }
    if let Some(value) = statement.expression() {
        value.each(&mut |value| {
            if let Expression::Variable(name) = value {
                read.insert(name.clone());
            }
        });
    }
    read
}

/// Prints the statements of the constructor.
pub(super) fn statements(header: &Header<'_>, body: &Body, scalar: Scalar) -> Vec<String> {
    body.statements.iter().flat_map(|one| statement(header, &[], body, one, scalar)).collect()
}

fn statement(
    header: &Header<'_>,
    inputs: &[Array],
    body: &Body,
    statement: &Statement,
    scalar: Scalar,
) -> Vec<String> {
    let real = real(scalar);
    match statement {
        Statement::Parameter { name, parameter } => {
            let field = &header.tree.parameters[*parameter];
            vec![format!("    const {real} {name} = parameters->{field};")]
        }
        Statement::Entry { name, input, entry } => {
            vec![format!("    const {real} {name} = {}[{entry}];", inputs[*input].name)]
        }
        Statement::Let { name, value } => {
            vec![format!("    const {real} {name} = {};", header.expressions(scalar).text(value))]
        }
        Statement::Part(index) => call(header, &body.parts[*index], *index, scalar),
        Statement::Circular { .. } => vec![],
    }
}

pub(super) fn real(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::F64 => "double",
        Scalar::F32 => "float",
    }
}

/// Prints the call of a part, which takes and returns its values in arrays.
fn call(header: &Header<'_>, part: &Part, index: usize, scalar: Scalar) -> Vec<String> {
    let real = real(scalar);
    let (entering, leaving) = (format!("entering{}_", index + 1), format!("leaving{}_", index + 1));
    let mut arguments = vec![];
    if part.reads_fields {
        arguments.push("model".to_owned());
    }
    let mut lines = vec![];
    if !part.entering.is_empty() {
        let (length, values) = (part.entering.len(), part.entering.join(", "));
        lines.push(format!("    const {real} {entering}[{length}] = {{{values}}};"));
        arguments.push(entering);
    }
    lines.push(format!("    {real} {leaving}[{}];", part.leaving.len().max(1)));
    arguments.push(leaving.clone());
    lines.push(format!("    {}({});", header.names.private(&part.name), arguments.join(", ")));
    for (index, name) in part.leaving.iter().enumerate() {
        lines.push(format!("    const {real} {name} = {leaving}[{index}];"));
    }
    lines
}

/// Prints the functions of the parts of a very long body.
pub(super) fn parts(header: &Header<'_>, body: &Body, scalar: Scalar) -> Vec<String> {
    let real = real(scalar);
    let mut lines = vec![];
    for (index, part) in body.parts.iter().enumerate() {
        let mut parameters = vec![];
        if part.reads_fields {
            parameters.push(format!("const {} *model", header.names.item("model")));
        }
        if !part.entering.is_empty() {
            parameters.push(format!("const {real} entering_[{}]", part.entering.len()));
        }
        parameters.push(format!("{real} leaving_[{}]", part.leaving.len().max(1)));
        let attribute = header.names.private_upper("part");
        let (text, name) =
            (format!("Part {} of the next function.", index + 1), header.names.private(&part.name));
        lines.push(comment::of_line(&text));
        lines.push(format!("{attribute} void {name}({})", parameters.join(", ")));
        lines.push("{".to_owned());
        for (index, name) in part.entering.iter().enumerate() {
            lines.push(format!("    const {real} {name} = entering_[{index}];"));
        }
        let statements = part.statements.iter();
        lines.extend(statements.flat_map(|one| statement(header, &[], body, one, scalar)));
        for (index, name) in part.leaving.iter().enumerate() {
            lines.push(format!("    leaving_[{index}] = {name};"));
        }
        lines.extend(["}".to_owned(), String::new()]);
    }
    lines
}
