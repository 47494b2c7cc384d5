//! A package in WebAssembly: the module, an ES module that loads it, its declarations, a test, and `package.json`.

use robot_codegen::backend::SourceFile;
use robot_codegen::backend::flat::{Function, Tree};
use robot_codegen::backend::wasm;
use robot_codegen::{Scalar, Trigonometry};

use super::call::{checked, numbers};
use super::javascript::manifest;
use super::{Parts, description, file, of_sources};
use crate::driver::check::CheckValue;
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// The number of states in the test of functions over columns: enough for lanes of any type, and a remainder.
const STATES: usize = 7;

/// Makes the files of the package.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = wasm::tree(parts.module, parts.flat);
    let mut files = vec![
        file("README.md", readme(parts, &tree)),
        file("package.json", manifest(&tree)),
        file("robot.json", description::json(parts, &tree)),
    ];
    files.extend(of_sources(sources));
    files.push(file("test.mjs", test(parts, &tree)));
    files
}

/// Prints the statement that makes `model`, if there are parameters.
fn model(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    if !tree.has_parameters() {
        return String::new();
    }
    let given = parts.given_parameters(tree).into_iter();
    let given: Vec<String> = given.map(|(field, value)| format!(", {field}: {value:?}")).collect();
    format!("const model = robot.create_model({{ ...nominal(){} }});\n", given.join(""))
}

/// The names that the test imports.
fn imports(tree: &Tree<'_>) -> &'static str {
    if tree.has_parameters() { "load, nominal" } else { "load" }
}

/// Prints the call of a function at its check state, or over columns of `states` equal states.
fn call(tree: &Tree<'_>, name: &str, check: &CheckValue, states: Option<usize>) -> String {
    let model = tree.has_parameters().then(|| "model".to_owned());
    let inputs = check.inputs.iter().map(|(_, values)| match states {
        Some(_) => format!("columns([{}])", numbers(values, ", ")),
        None => format!("[{}]", numbers(values, ", ")),
    });
    let count = states.map(|states| states.to_string());
    let arguments: Vec<String> = model.into_iter().chain(count).chain(inputs).collect();
    format!("robot.{name}({})", arguments.join(", "))
}

fn readme(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let (real, lanes) = match parts.options.scalar {
        Scalar::F64 => ("Float64Array", 2),
        Scalar::F32 => ("Float32Array", 4),
    };
    let mut usage = format!(
        "```js\nimport {{ {} }} from \"./{name}.mjs\";\n\nconst robot = await load();\n{}",
        imports(tree),
        model(parts, tree)
    );
    let first = checked(parts, tree).next();
    if let Some((function, check)) = first {
        usage.push_str(&format!("{};\n", call(tree, &function.name, check, None)));
    }
    usage.push_str(&format!(
        "```\n\n`{name}.mjs` loads `{name}.wasm` from its own folder, in a browser or in Node.js; `load` also accepts the module's \
         bytes, its URL, a response or a compiled module. Inputs are arrays of any kind. Outputs are new `{real}`s, or \
         the arrays that are passed after the inputs; single numbers are returned as such; a matrix is an array, row by row. Test it with `node test.mjs`.\n\n\
         Functions whose names end in `_batch` take many states: {} is the number `n` of states, and each array has \
         entry `j` of state `i` at `j * n + i`. They compute {lanes} states at a time in 128-bit vectors.\n\n\
         The wrapped functions copy arrays into and out of the module's memory. To avoid copies, keep arrays there and call \
         `robot.exports`, whose functions take addresses:\n\n",
        if tree.has_parameters() { "after the model, the next argument" } else { "the first argument" }
    ));
    if let Some((function, _)) = first {
        usage.push_str(&uncopied(tree, function));
    }
    usage.push_str(&format!(
        "\nOf these, the functions over columns take {}the number of states and the distance from one column to \
         the next, counted in numbers, before the inputs. When memory grows, earlier views of it become empty.\n",
        if tree.has_parameters() { "the model, " } else { "" }
    ));
    parts.readme(tree, "WebAssembly", &usage, "create_model")
}

/// Prints an example of a call by addresses, for the README.
fn uncopied(tree: &Tree<'_>, function: &Function<'_>) -> String {
    let mut text = "```js\n".to_owned();
    let mut arguments = vec![];
    if tree.has_parameters() {
        arguments.push("model".to_owned());
    }
    for array in function.inputs.iter().chain(&function.outputs) {
        text.push_str(&format!("const {} = robot.allocate({});\n", array.name, array.length));
        arguments.push(array.name.clone());
    }
    if let Some(array) = function.inputs.first() {
        text.push_str(&format!("robot.numbers({}, {}).fill(0.5);\n", array.name, array.length));
    }
    text.push_str(&format!("robot.exports.{}({});\n", function.name, arguments.join(", ")));
    if let Some(array) = function.outputs.first() {
        text.push_str(&format!("robot.numbers({}, {});\n", array.name, array.length));
    }
    text + "```\n"
}

/// Whether the check values have the bits of the interpreter, which requires double precision.
fn has_bits(parts: &Parts<'_>) -> bool {
    parts.options.scalar == Scalar::F64
        && parts.options.trigonometry == Trigonometry::Polynomial
        && !parts.options.fused
}

fn test(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let scalar = parts.options.scalar;
    let tolerance = if scalar == Scalar::F64 { "1e-12" } else { "1e-4" };
    let bits = if has_bits(parts) {
        "\n    if (!found.every((value, i) => value === stated[i])) {\n        throw new Error(`${what}: last bits differ from the \
         stated values`);\n    }"
    } else {
        ""
    };
    let mut text = format!(
        "// {}
// The check values of the README.

import {{ {} }} from \"./{}.mjs\";

const robot = await load();
const STATES = {STATES};
const arrays = (value) => (typeof value === \"number\" ? [[value]] : ArrayBuffer.isView(value) ? [value] : Object.values(value).flatMap(arrays));
const columns = (values) => values.flatMap((value) => Array(STATES).fill(value));

function check(what, found, stated) {{
    const size = Math.max(0, ...stated.map(Math.abs));
    const meets = found.length === stated.length && found.every((value, i) => Math.abs(value - stated[i]) <= {tolerance} * size);
    if (!meets) {{
        throw new Error(`${{what}} gives ${{found}}, expected ${{stated}}`);
    }}{bits}
}}

function one(what, found, stated) {{
    check(what, arrays(found).flatMap((array) => [...array]), stated);
}}

function batch(what, found, stated) {{
    for (let i = 0; i < STATES; i++) {{
        check(what, arrays(found).flatMap((array) => [...array].filter((_, place) => place % STATES === i)), stated);
    }}
}}

{}",
        unnamed_header(),
        imports(tree),
        tree.name,
        model(parts, tree)
    );
    let batch_names = wasm::batch_names(tree);
    for (function, check) in checked(parts, tree) {
        let name = &function.name;
        let stated: Vec<f64> =
            check.outputs.iter().flat_map(|output| output.values.iter().copied()).collect();
        let stated = numbers(&stated, ", ");
        let place = tree.functions.iter().position(|one| one.name == *name);
        let over_columns = place.and_then(|place| batch_names.get(place)).and_then(Option::as_ref);
        text.push_str(&format!(
            "one(\"{name}\", {}, [{stated}]);\n",
            call(tree, name, check, None)
        ));
        if let Some(over_columns) = over_columns {
            let called = call(tree, over_columns, check, Some(STATES));
            text.push_str(&format!("batch(\"{over_columns}\", {called}, [{stated}]);\n"));
        }
    }
    text.push_str("console.log(\"all results match the check values\");\n");
    text
}
