//! Rust, as a generated crate.

use std::path::Path;

use robot_build::languages::Language;
use robot_build::names;
use robot_codegen::Scalar;
use robot_codegen::backend::rust::output_names;

use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// The runner of a generated crate, compiled for any processor.
pub(super) struct Rust;

impl Runner for Rust {
    fn name(&self) -> &'static str {
        "rust"
    }

    fn missing(&self) -> Option<String> {
        (!files::is_there("cargo", &["--version"])).then(|| "cargo is not installed".to_owned())
    }

    fn has(&self, _: Scalar) -> bool {
        true
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::Rust, folder)?;
        files::write(folder, "examples/calls.rs", program(work).as_bytes())?;
        // The package is its own workspace, in any folder.
        let manifest = String::from_utf8_lossy(&read(folder, "Cargo.toml")?).into_owned();
        files::write(folder, "Cargo.toml", (manifest + "\n[workspace]\n").as_bytes())?;
        files::run(folder, "cargo", &["run", "--offline", "--quiet", "--example", "calls"])?;
        let results = results(work, &read(folder, "single.bin")?, |_| true)?;
        Ok(vec![Found { way: "single", results }])
    }
}

/// Prints a program that reads states, calls every function and writes the results.
fn program(work: &Work) -> String {
    let module = &work.programs.module;
    let names = names(&work.programs);
    let real = if work.options.scalar == Scalar::F64 { "f64" } else { "f32" };
    let mut text = format!(
        "use {}::*;\n\nfn main() {{\n    let bytes = std::fs::read(\"states.bin\").unwrap();\n    let mut values = \
         bytes.chunks_exact({}).map(|chunk| {real}::from_le_bytes(chunk.try_into().unwrap()));\n    let mut found: \
         Vec<{real}> = vec![];\n",
        names.module,
        work.options.scalar.size()
    );
    if module.parameters.is_empty() {
        text.push_str("    let model = Model;\n");
    } else {
        let fields = names.parameters.iter().zip(&work.parameters);
        let fields: Vec<String> =
            fields.map(|(name, value)| format!("{name}: {value:?}")).collect();
        text.push_str(&format!(
            "    let model = Model::new(&Parameters {{ {} }});\n",
            fields.join(", ")
        ));
    }
    let functions = module.functions.iter().zip(&names.functions).zip(&work.functions);
    for ((function, method), calls) in functions {
        let states = calls.expected.len() / calls.given;
        text.push_str(&format!("    for _ in 0..{states} {{\n"));
        let mut arguments = vec![];
        for (index, input) in function.inputs.iter().enumerate() {
            text.push_str(&format!(
                "        let input{index}: [{real}; {}] = std::array::from_fn(|_| values.next().unwrap());\n",
                input.symbols.len()
            ));
            arguments.push(format!("&input{index}"));
        }
        text.push_str(&format!("        let result = model.{method}({});\n", arguments.join(", ")));
        let fields = match function.outputs.len() {
            1 => vec![String::new()],
            _ => output_names(function).iter().map(|name| format!(".{name}")).collect(),
        };
        for (output, field) in function.outputs.iter().zip(fields) {
            text.push_str(&match output.shape.len() {
                0 => format!("        found.push(result{field});\n"),
                1 => format!("        found.extend(result{field});\n"),
                _ => format!("        found.extend(result{field}.as_flattened());\n"),
            });
        }
        text.push_str("    }\n");
    }
    text.push_str(
        "    let bytes: Vec<u8> = found.iter().flat_map(|value| value.to_le_bytes()).collect();\n    \
         std::fs::write(\"single.bin\", bytes).unwrap();\n}\n",
    );
    text
}
