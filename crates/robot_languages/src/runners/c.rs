//! C, with several compilers.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::Scalar;
use robot_codegen::backend::c::{self, Names};
use robot_codegen::backend::flat::{FlatOptions, Function, Tree};

use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// A C compiler.
struct C {
    name: &'static str,
    compiler: &'static str,
    /// The options for the standard and the processor.
    options: &'static [&'static str],
    /// The ending of the program's source.
    source: &'static str,
}

/// Warnings that printed code must not cause.
pub(super) const WARNINGS: [&str; 5] =
    ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"];

/// Even with `-ffp-contract=off`, gcc 12 fuses products with pairs of a sum and a difference if it vectorizes
/// straight-line code.
const NO_PAIRS: &str = "-fno-tree-slp-vectorize";

/// All compilers.
pub(super) fn all() -> Vec<Box<dyn Runner>> {
    let c = |name, compiler, options| {
        Box::new(C { name, compiler, options, source: "main.c" }) as Box<dyn Runner>
    };
    vec![
        c("gcc", "gcc", &["-std=c99"]),
        c("gcc, this processor", "gcc", &["-std=c99", "-O3", "-march=native", NO_PAIRS]),
        c("clang", "clang", &["-std=c99"]),
        c("clang, this processor", "clang", &["-std=c99", "-O3", "-march=native"]),
        Box::new(C { name: "g++", compiler: "g++", options: &["-std=c++17"], source: "main.cpp" }),
    ]
}

impl Runner for C {
    fn name(&self) -> &'static str {
        self.name
    }

    fn missing(&self) -> Option<String> {
        let is_there = files::is_there(self.compiler, &["--version"]);
        (!is_there).then(|| format!("{} is not installed", self.compiler))
    }

    fn has(&self, _: Scalar) -> bool {
        true
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::C, folder)?;
        let options = FlatOptions { scalar: work.options.scalar, ..FlatOptions::default() };
        let tree = c::tree(&work.programs.module, &options);
        files::write(folder, self.source, program(work, &tree, &C_CALLS).as_bytes())?;
        let mut arguments = vec!["-O2", "-ffp-contract=off"];
        arguments.extend(self.options);
        arguments.extend(WARNINGS);
        arguments.extend([self.source, "-o", "main", "-lm"]);
        files::run(folder, self.compiler, &arguments)?;
        files::run(folder, "./main", &[])?;
        let has_batch = |index: usize| c::has_batch(&tree.functions[index]);
        Ok(vec![
            Found {
                way: "single",
                results: results(work, &read(folder, "single.bin")?, |_| true)?,
            },
            Found { way: "batch", results: results(work, &read(folder, "batch.bin")?, has_batch)? },
        ])
    }
}

/// The way in which a program calls functions through the C interface.
pub(super) struct Calls {
    /// The ending of the header.
    pub(super) ending: &'static str,
    /// Lines at the top of the program.
    pub(super) top: &'static str,
    /// The model as an argument of a batch.
    pub(super) model: &'static str,
    /// The text before the call of a batch.
    pub(super) before: &'static str,
    /// The text between the name of a batch and its arguments.
    pub(super) grid: &'static str,
    /// The text after the call of a batch.
    pub(super) after: &'static str,
    /// Declares columns, given their type, name and number of entries.
    pub(super) columns: fn([&str; 3]) -> String,
    /// Whether a function has a batch.
    pub(super) has_batch: fn(&Function<'_>) -> bool,
}

/// Calls in C itself.
pub(super) const C_CALLS: Calls = Calls {
    ending: "h",
    top: "",
    model: "&model, ",
    before: "",
    grid: "",
    after: "",
    columns: static_columns,
    has_batch: c::has_batch,
};

/// Declares columns as a static array.
pub(super) fn static_columns([real, name, count]: [&str; 3]) -> String {
    format!("static {real} {name}[{count}];")
}

/// Prints a program that reads states, calls every function in both ways and writes the results.
pub(super) fn program(work: &Work, tree: &Tree<'_>, way: &Calls) -> String {
    let names = Names::new(&tree.name);
    let real = if work.options.scalar == Scalar::F64 { "double" } else { "float" };
    let mut text = format!(
        "{}#include \"{}.{}\"\n#include <stdio.h>\n#include <stdlib.h>\n\nint main(void)\n{{\n    FILE *in = \
         fopen(\"states.bin\", \"rb\");\n    FILE *single = fopen(\"single.bin\", \"wb\");\n    FILE *batch = \
         fopen(\"batch.bin\", \"wb\");\n    if (!in || !single || !batch) {{\n        return 2;\n    }}\n",
        way.top, tree.name, way.ending
    );
    if tree.has_parameters() {
        text.push_str(&format!(
            "    {} parameters;\n    {} model;\n",
            names.item("parameters"),
            names.item("model")
        ));
        for (field, value) in tree.parameters.iter().zip(&work.parameters) {
            text.push_str(&format!("    parameters.{field} = {value:?};\n"));
        }
        text.push_str(&format!("    {}(&model, &parameters);\n", names.item("model_init")));
    }
    for (function, calls) in tree.functions.iter().zip(&work.functions) {
        let states = calls.expected.len() / calls.given;
        text.push_str(&block(tree, function, &names, way, [real, &states.to_string()]));
    }
    text.push_str("    return fclose(in) | fclose(single) | fclose(batch);\n}\n");
    text
}

/// Prints the calls of one function.
fn block(
    tree: &Tree<'_>,
    function: &Function<'_>,
    names: &Names,
    way: &Calls,
    [real, states]: [&str; 2],
) -> String {
    let has_batch = (way.has_batch)(function);
    let name = names.item(&function.name);
    let arrays: Vec<(&str, usize)> = function
        .inputs
        .iter()
        .chain(&function.outputs)
        .map(|array| (array.name.as_str(), array.length))
        .collect();
    let model = if tree.has_parameters() { "&model, " } else { "" };
    let listed: Vec<&str> = arrays.iter().map(|(name, _)| *name).collect();
    let mut text = "    {\n        size_t i, j;\n".to_owned();
    for (array, length) in &arrays {
        text.push_str(&format!("        static {real} {array}[{length}];\n"));
        if has_batch {
            let columns = [real, &format!("columns_{array}"), &format!("{length} * {states}")];
            text.push_str(&format!("        {}\n", (way.columns)(columns)));
        }
    }
    text.push_str(&format!("        (void)j;\n        for (i = 0; i < {states}; i++) {{\n"));
    for array in &function.inputs {
        let (array, length) = (&array.name, array.length);
        text.push_str(&format!(
            "            if (fread({array}, sizeof {array}[0], {length}, in) != {length}) {{\n                \
             return 3;\n            }}\n"
        ));
        if has_batch {
            text.push_str(&format!(
                "            for (j = 0; j < {length}; j++) {{\n                \
                 columns_{array}[j * {states} + i] = {array}[j];\n            }}\n"
            ));
        }
    }
    text.push_str(&format!("            {name}({model}{});\n", listed.join(", ")));
    for array in &function.outputs {
        let (array, length) = (&array.name, array.length);
        text.push_str(&format!(
            "            fwrite({array}, sizeof {array}[0], {length}, single);\n"
        ));
    }
    text.push_str("        }\n");
    if has_batch {
        text.push_str(&columns(tree, function, names, way, states));
    }
    text.push_str("    }\n");
    text
}

/// Prints the call of a batch, and the writing of its results.
fn columns(
    tree: &Tree<'_>,
    function: &Function<'_>,
    names: &Names,
    way: &Calls,
    states: &str,
) -> String {
    let model = if tree.has_parameters() { way.model } else { "" };
    let batch = names.item(function.form(c::BATCH));
    let arrays = function.inputs.iter().chain(&function.outputs);
    let listed: Vec<String> = arrays.map(|array| format!("columns_{}", array.name)).collect();
    let listed = listed.join(", ");
    let mut text = String::new();
    text.push_str(&format!(
        "        {}{batch}{}({model}{states}, {states}, {listed});{}\n        for (i = 0; i < {states}; i++) {{\n",
        way.before, way.grid, way.after
    ));
    for array in &function.outputs {
        let (array, length) = (&array.name, array.length);
        text.push_str(&format!(
            "            for (j = 0; j < {length}; j++) {{\n                \
             fwrite(&columns_{array}[j * {states} + i], sizeof {array}[0], 1, batch);\n            }}\n"
        ));
    }
    text.push_str("        }\n");
    text
}
