//! The TypeScript declarations of a module.

use super::{Printer, documentation};
use crate::backend::common::{self, ConstantValue, comment_line};
use crate::backend::flat::Function;

/// Prints the declarations.
pub(super) fn text(printer: &Printer<'_>) -> String {
    let mut lines = printer.header();
    lines.extend(constants(printer));
    if printer.tree.has_parameters() {
        lines.extend(model(printer));
        lines.extend(parameters(printer));
    }
    for function in &printer.tree.functions {
        lines.extend(declaration(printer, function));
    }
    lines.join("\n")
}

/// Prints the type of inputs, and the constants.
pub(in crate::backend) fn constants(printer: &Printer<'_>) -> Vec<String> {
    let mut lines = vec![];
    lines.extend([
        "/** Numbers, in an array of any kind. */".to_owned(),
        "export type Entries = ArrayLike<number>;".to_owned(),
        String::new(),
    ]);
    for item in &printer.options.constants {
        let ty = match item.value {
            ConstantValue::Size(_) | ConstantValue::Number(_) => "number",
            ConstantValue::Text(_) => "string",
            ConstantValue::Texts(_) => "string[]",
            ConstantValue::Places(_) => "[number, number][]",
            ConstantValue::Numbers(_) => "number[]",
        };
        lines.push(format!("// {}", comment_line(&item.doc)));
        lines.push(format!("export declare const {}: {ty};", item.printed_name()));
    }
    lines.push(String::new());
    lines
}

fn interface(name: &str, fields: &[String]) -> Vec<String> {
    let mut lines = vec![format!("export interface {name} {{")];
    lines.extend(fields.iter().map(|field| format!("    {field}: number;")));
    lines.extend(["}", ""].map(str::to_owned));
    lines
}

fn model(printer: &Printer<'_>) -> Vec<String> {
    let mut lines = interface("Model", &printer.tree.fields);
    lines.push("export declare function create_model(parameters: Parameters): Model;".to_owned());
    lines
}

/// Prints the parameters, and the functions that set several of them together.
pub(in crate::backend) fn parameters(printer: &Printer<'_>) -> Vec<String> {
    let tree = printer.tree;
    let mut lines = vec!["export interface Parameters {".to_owned()];
    for (spec, field) in tree.module.parameters.iter().zip(&tree.parameters) {
        lines.extend(documentation(&[common::parameter(spec)], "    "));
        lines.push(format!("    {field}: number;"));
    }
    lines.extend(["}", ""].map(str::to_owned));
    lines.push("export declare function nominal(): Parameters;".to_owned());
    for (setter, name) in printer.options.setters.iter().zip(&tree.setters) {
        let arguments = setter.arguments.iter().map(|argument| {
            let ty = if argument.parameters.len() == 1 { "number" } else { "Entries" };
            format!("{}: {ty}", argument.name)
        });
        let arguments: Vec<String> = arguments.collect();
        lines.push(format!(
            "export declare function {name}(parameters: Parameters, {}): Parameters;",
            arguments.join(", ")
        ));
    }
    lines.push(String::new());
    lines
}

fn declaration(printer: &Printer<'_>, function: &Function<'_>) -> Vec<String> {
    let mut arguments: Vec<String> = vec![];
    if printer.tree.has_parameters() {
        arguments.push("model: Model".to_owned());
    }
    arguments.extend(function.inputs.iter().map(|array| format!("{}: Entries", array.name)));
    let mut results = vec![];
    for (output, array) in function.source.outputs.iter().zip(&function.outputs) {
        let ty = if output.shape.is_empty() { "number" } else { "Float64Array" };
        if !output.shape.is_empty() {
            arguments.push(format!("{}?: Float64Array", array.name));
        }
        results.push((array.name.clone(), ty));
    }
    let result = match results.as_slice() {
        [(_, ty)] => (*ty).to_owned(),
        results => {
            let fields = results.iter().map(|(name, ty)| format!("{name}: {ty}"));
            format!("{{ {} }}", fields.collect::<Vec<_>>().join("; "))
        }
    };
    let mut lines = documentation(&printer.function_doc(function), "");
    lines.push(format!(
        "export declare function {}({}): {result};",
        function.name,
        arguments.join(", ")
    ));
    lines.push(String::new());
    lines
}
