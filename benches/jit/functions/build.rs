//! Generates all functions of the robots, and the list of them.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use robot_build::programs;

#[path = "src/options.rs"]
mod options;

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::var("OUT_DIR")?;
    let mut modules = String::new();
    let mut list = String::from(
        "/// All functions that take inputs.\npub static FUNCTIONS: &[Function] = &[\n",
    );
    for name in options::ROBOTS {
        let (file, options) = options::robot(name)?;
        println!("cargo::rerun-if-changed={}", file.path.display());
        let generated = robot_build::generate(&file.source, &options)?;
        std::fs::write(Path::new(&out).join(format!("{name}.rs")), generated.code)?;
        writeln!(modules, "include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));")?;
        let module = programs(&file.source, &options)?.module;
        for function in module.functions.iter().filter(|function| !function.inputs.is_empty()) {
            let called = |call: &str| -> String {
                let names = (0..function.inputs.len()).map(|index| format!("i{index}"));
                names.map(|name| format!("let {name} = {call}(&mut i); ")).collect()
            };
            let inputs: Vec<String> = (0..function.inputs.len()).map(|i| format!("i{i}")).collect();
            let inputs = inputs.join(", ");
            // Several outputs are the fields of a struct.
            let results: String = match function.outputs.as_slice() {
                [_] => "write(&r, o);".to_owned(),
                several => {
                    let each = several
                        .iter()
                        .map(|output| format!("let o = write(&r.{}, o); ", output.name));
                    each.collect::<String>() + "let _ = o;"
                }
            };
            let (mut written, mut outputs) = (String::new(), vec![]);
            for (index, output) in function.outputs.iter().enumerate() {
                let number = "&mut **o.next().unwrap()".to_owned();
                let array = |inner, length| format!("from_fn::<_, {length}, _>(|_| {inner})");
                write!(
                    written,
                    "let o{index} = {}; ",
                    output.shape.iter().rev().fold(number, array)
                )?;
                outputs.push(format!("o{index}"));
            }
            let outputs = outputs.join(", ");
            writeln!(
                list,
                "Function {{ robot: {name:?}, name: {function:?}, \
                 single: |mut i, o| {{ {rows} let r = {name}::Model::NOMINAL.{function}({inputs}); {results} }}, \
                 columns: |mut i, o| {{ {columns} let mut o = o.iter_mut(); {written} {name}::Model::NOMINAL.{function}_columns({inputs}, {outputs}); }} }},",
                function = function.name,
                rows = called("row"),
                columns = called("columns"),
            )?;
        }
    }
    list.push_str("];\n");
    Ok(std::fs::write(Path::new(&out).join("list.rs"), modules + &list)?)
}
