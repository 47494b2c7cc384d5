//! The TypeScript declarations of the ES module.

use super::Printer;
use crate::backend::flat::Function;
use crate::backend::javascript::{self, documentation};

/// Prints the declarations.
pub(super) fn text(printer: &Printer<'_>) -> String {
    let (tree, options) = (printer.tree, printer.options);
    let of_javascript = javascript::Printer { tree, options };
    let mut lines = of_javascript.header();
    lines.extend(javascript::declarations::constants(&of_javascript));
    if tree.has_parameters() {
        lines.extend([
            "/** The address of a model in the module's memory. */".to_owned(),
            "export type Model = number;".to_owned(),
            String::new(),
        ]);
        lines.extend(javascript::declarations::parameters(&of_javascript));
    }
    let array = printer.array();
    lines.extend(LOAD.replace("NUMBERS", array).lines().map(str::to_owned));
    if tree.has_parameters() {
        lines.extend(MODEL.lines().map(str::to_owned));
    }
    for (function, batch) in printer.functions() {
        lines.extend(declaration(printer, function, batch));
    }
    lines.extend(["}", ""].map(str::to_owned));
    lines.join("\n")
}

const LOAD: &str = "/**
 * Loads the module from its bytes, a compiled module, a response or a URL; by default from the file beside this one.
 */
export declare function load(
    source?: WebAssembly.Module | ArrayBuffer | ArrayBufferView | Response | URL | string,
): Promise<Robot>;

/** The functions of the module, and its memory for calls that copy nothing. */
export interface Robot {
    /** The module's exports: functions that take addresses. */
    readonly exports: WebAssembly.Exports;
    readonly memory: WebAssembly.Memory;
    /** Allocates memory for `count` numbers, which is never freed, and returns its address. */
    allocate(count: number): number;
    /** The numbers at an address, until the memory grows. */
    numbers(address: number, count: number): NUMBERS;";

const MODEL: &str = "    /** Computes everything that depends only on the parameters, once. */
    create_model(parameters: Parameters): Model;
    /** Computes the same in the memory of an existing model, which is overwritten. */
    update_model(model: Model, parameters: Parameters): void;";

fn declaration(printer: &Printer<'_>, function: &Function<'_>, batch: Option<&str>) -> Vec<String> {
    let array = printer.array();
    let model = printer.tree.has_parameters().then_some("model: Model".to_owned());
    let inputs = function.inputs.iter().map(|array| format!("{}: Entries", array.name));
    let outputs = || function.source.outputs.iter().zip(&function.outputs);
    let arguments = |given: &[&str], is_batch: bool| {
        let given = given.iter().map(|text| (*text).to_owned());
        let outputs = outputs().filter(|(output, _)| is_batch || !output.shape.is_empty());
        let outputs = outputs.map(|(_, output)| format!("{}?: {array}", output.name));
        let all = model.iter().cloned().chain(given).chain(inputs.clone()).chain(outputs);
        all.collect::<Vec<_>>().join(", ")
    };
    let result = |is_batch: bool| {
        let types = outputs().map(|(output, one)| {
            let ty = if output.shape.is_empty() && !is_batch { "number" } else { array };
            (one.name.as_str(), ty)
        });
        let types: Vec<(&str, &str)> = types.collect();
        match types.as_slice() {
            [(_, ty)] => (*ty).to_owned(),
            types => {
                let fields = types.iter().map(|(name, ty)| format!("{name}: {ty}"));
                format!("{{ {} }}", fields.collect::<Vec<_>>().join("; "))
            }
        }
    };
    let of_javascript = javascript::Printer { tree: printer.tree, options: printer.options };
    let mut lines = documentation(&of_javascript.function_doc(function), "    ");
    lines.push(format!("    {}({}): {};", function.name, arguments(&[], false), result(false)));
    if let Some(name) = batch {
        let doc = format!(
            "`{}` of `n` states: entry j of state i is number `j * n + i` of an array.",
            function.name
        );
        lines.extend(documentation(&[doc], "    "));
        lines.push(format!("    {name}({}): {};", arguments(&["n: number"], true), result(true)));
    }
    lines
}
