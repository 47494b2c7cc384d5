//! Constants, the structures of parameters and of the model, and the functions that fill them.

use super::Header;
use super::comment;
use super::function;
use super::spelling::number;
use crate::backend::common::{self, ConstantValue, Scalar, Setter, SetterArgument};
use crate::counts::Counts;

/// Prints the caller's constants as macros; the macro of an array is its initializer.
pub(super) fn constants(header: &Header<'_>) -> Vec<String> {
    let mut lines = vec![];
    for item in &header.options.constants {
        let value = match &item.value {
            ConstantValue::Size(size) => size.to_string(),
            ConstantValue::Number(value) => number(*value, Scalar::F64),
            ConstantValue::Text(text) => string(text),
            ConstantValue::Texts(texts) => array(texts.iter().map(|text| string(text))),
            ConstantValue::Places(places) => {
                array(places.iter().map(|[row, column]| format!("{{{row}, {column}}}")))
            }
            ConstantValue::Numbers(numbers) => {
                array(numbers.iter().map(|value| number(*value, Scalar::F64)))
            }
        };
        let doc = common::paragraphs(std::slice::from_ref(&item.doc), &item.name);
        lines.extend(comment::of_paragraphs(&doc));
        lines.push(format!("#define {} {value}", header.names.upper(&item.printed_name())));
    }
    lines.push(String::new());
    lines
}

/// Prints an initializer.
fn array(values: impl Iterator<Item = String>) -> String {
    format!("{{{}}}", values.collect::<Vec<_>>().join(", "))
}

/// Prints a string literal for any text; bytes that are not plain characters are octal escapes.
fn string(text: &str) -> String {
    let mut literal = String::from("\"");
    for byte in text.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b' ' | b'_' | b'-' | b'.' | b',' => {
                literal.push(char::from(byte));
            }
            _ => literal.push_str(&format!("\\{byte:03o}")),
        }
    }
    literal.push('"');
    literal
}

/// Prints the structure of the parameters, and the nominal values.
pub(super) fn parameters(header: &Header<'_>) -> Vec<String> {
    let (tree, names) = (header.tree, &header.names);
    let title = common::markdown_line(&tree.module.name);
    let mut lines = comment::of_paragraphs(&[format!("The parameters of {title}.")]);
    lines.push("typedef struct {".to_owned());
    for (spec, field) in tree.module.parameters.iter().zip(&tree.parameters) {
        let doc = comment::of_line(&common::parameter(spec));
        lines.extend([format!("    {doc}"), format!("    double {field};")]);
    }
    let ty = names.item("parameters");
    lines.extend([format!("}} {ty};"), String::new()]);
    let nominal: Option<Vec<f64>> =
        tree.module.parameters.iter().map(|spec| spec.nominal).collect();
    if let Some(values) = nominal {
        lines.push(comment::of_line("The nominal values of the parameters."));
        lines.push(format!("{} {ty} {}(void)", header.inline(), names.item("nominal")));
        lines.extend(["{".to_owned(), format!("    {ty} parameters;")]);
        for (field, value) in tree.parameters.iter().zip(values) {
            lines.push(format!("    parameters.{field} = {};", number(value, Scalar::F64)));
        }
        lines.extend(["    return parameters;".to_owned(), "}".to_owned(), String::new()]);
    }
    lines
}

/// Prints the functions that set several parameters.
pub(super) fn setters(header: &Header<'_>) -> Vec<String> {
    let setters = header.options.setters.iter().zip(&header.tree.setters);
    setters.flat_map(|(setter, name)| set(header, setter, name)).collect()
}

fn set(header: &Header<'_>, setter: &Setter, name: &str) -> Vec<String> {
    let names = &header.names;
    let mut doc = common::paragraphs(&setter.doc, &setter.name);
    doc.push(String::new());
    for SetterArgument { name, doc: meaning, unit, .. } in &setter.arguments {
        doc.push(format!("- `{name}`: {}", common::quantity(meaning, name, unit, &[])));
    }
    let mut lines = comment::of_paragraphs(&doc);
    let arguments = setter.arguments.iter().map(|argument| match argument.parameters.len() {
        1 => format!("double {}", argument.name),
        length => format!("const double {}[{length}]", argument.name),
    });
    let arguments: Vec<String> = arguments.collect();
    let ty = names.item("parameters");
    lines.push(format!(
        "{} void {}({ty} *parameters, {})",
        header.inline(),
        names.item(name),
        arguments.join(", ")
    ));
    lines.push("{".to_owned());
    for argument in &setter.arguments {
        for (index, parameter) in argument.parameters.iter().enumerate() {
            let known = &header.tree.module.parameters;
            let Some(place) = known.iter().position(|known| known.name == *parameter) else {
                continue;
            };
            let value = match argument.parameters.len() {
                1 => argument.name.clone(),
                _ => format!("{}[{index}]", argument.name),
            };
            lines.push(format!("    parameters->{} = {value};", header.tree.parameters[place]));
        }
    }
    lines.extend(["}".to_owned(), String::new()]);
    lines
}

/// Prints the structure of the model, whose values depend only on the parameters, and its constructor.
pub(super) fn model(header: &Header<'_>) -> Vec<String> {
    let (tree, names) = (header.tree, &header.names);
    let title = common::markdown_line(&tree.module.name);
    let (model, parameters) = (names.item("model"), names.item("parameters"));
    let mut lines = comment::of_paragraphs(&[format!(
        "The model {title}: everything that depends only on its parameters, computed once by {}.",
        names.item("model_init")
    )]);
    lines.push("typedef struct {".to_owned());
    lines.extend(tree.fields.iter().map(|field| format!("    {} {field};", header.real())));
    if tree.fields.is_empty() {
        // C has no empty structures.
        lines.push(format!("    {} unused;", header.real()));
    }
    lines.extend([format!("}} {model};"), String::new()]);
    let body = &tree.constructor;
    let expressions = header.expressions(Scalar::F64);
    lines.extend(function::parts(header, body, Scalar::F64));
    let counts = Counts::of(&tree.module.constructor);
    lines.extend(comment::of_paragraphs(&[
        "Computes everything that depends only on the parameters.".to_owned(),
        String::new(),
        format!("{}.", common::operations(&counts)),
    ]));
    let init = names.item("model_init");
    lines.push(format!(
        "{} void {init}({model} *model, const {parameters} *parameters)",
        header.inline()
    ));
    lines.push("{".to_owned());
    lines.extend(function::statements(header, body, Scalar::F64));
    if body.statements.is_empty() {
        lines.push("    (void)parameters;".to_owned());
    }
    for (field, value) in tree.fields.iter().zip(&body.results) {
        let text = expressions.text(value);
        let text = match header.options.scalar {
            Scalar::F64 => text,
            Scalar::F32 => format!("(float)({text})"),
        };
        lines.push(format!("    model->{field} = {text};"));
    }
    if tree.fields.is_empty() {
        lines.push(format!("    model->unused = {};", number(0.0, header.options.scalar)));
    }
    lines.extend(["}".to_owned(), String::new()]);
    lines
}
