//! A package in JavaScript: the module, its declarations, a test, and `package.json`.

use robot_codegen::backend::SourceFile;
use robot_codegen::backend::flat::Tree;
use robot_codegen::backend::javascript;

use super::call::{arguments, checked, numbers};
use super::{Parts, description, file, of_sources};
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// Makes the files of the package.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = javascript::tree(parts.module, parts.flat);
    let mut files = vec![
        file("README.md", readme(parts, &tree)),
        file("package.json", manifest(&tree)),
        file("robot.json", description::json(parts, &tree)),
    ];
    files.extend(of_sources(sources));
    files.push(file("test.mjs", test(parts, &tree)));
    files
}

pub(super) fn manifest(tree: &Tree<'_>) -> String {
    let name = &tree.name;
    // Names of packages must be in lower case.
    let package = name.to_lowercase();
    format!(
        "{{
  \"//\": \"{}\",
  \"name\": \"{package}\",
  \"version\": \"0.1.0\",
  \"description\": \"Dynamics of a robot\",
  \"private\": true,
  \"type\": \"module\",
  \"exports\": {{ \".\": {{ \"types\": \"./{name}.d.mts\", \"default\": \"./{name}.mjs\" }} }},
  \"scripts\": {{ \"test\": \"node test.mjs\" }}
}}
",
        unnamed_header()
    )
}

/// Prints the statement that makes `model`, if there are parameters.
fn model(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    if !tree.has_parameters() {
        return String::new();
    }
    let given = parts.given_parameters(tree).into_iter();
    let given: Vec<String> = given.map(|(field, value)| format!(", {field}: {value:?}")).collect();
    format!("const model = robot.create_model({{ ...robot.nominal(){} }});\n", given.join(""))
}

fn readme(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let mut usage =
        format!("```js\nimport * as robot from \"./{name}.mjs\";\n\n{}", model(parts, tree));
    if let Some((function, check)) = checked(parts, tree).next() {
        let arguments = arguments(tree, check, ["[", "]"], ", ");
        usage.push_str(&format!("robot.{}({arguments});\n", function.name));
    }
    usage.push_str(
        "```\n\nInputs are arrays of any kind; a call with an array of the wrong length throws a `RangeError`. \
         Outputs are new `Float64Array`s, or the arrays that are passed after the inputs, so a loop need not allocate; single numbers are returned as such; a matrix is an array, row by row. Test it with `node test.mjs`.\n",
    );
    parts.readme(tree, "JavaScript", &usage, "create_model")
}

fn test(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let mut text = format!(
        "// {}
// The check values of the README.

import * as robot from \"./{}.mjs\";

const flat = (value) =>
    typeof value === \"number\" ? [value] : value instanceof Float64Array ? [...value] : Object.values(value).flatMap(flat);

function check(what, found, stated) {{
    found = flat(found);
    const size = Math.max(0, ...stated.map(Math.abs));
    const meets = found.length === stated.length && found.every((value, i) => Math.abs(value - stated[i]) <= 1e-12 * size);
    if (!meets) {{
        throw new Error(`${{what}} gives ${{found}}, expected ${{stated}}`);
    }}
}}

{}",
        unnamed_header(),
        tree.name,
        model(parts, tree)
    );
    for (function, check) in checked(parts, tree) {
        let (name, arguments) = (&function.name, arguments(tree, check, ["[", "]"], ", "));
        let stated: Vec<f64> =
            check.outputs.iter().flat_map(|output| output.values.iter().copied()).collect();
        text.push_str(&format!(
            "check(\"{name}\", robot.{name}({arguments}), [{}]);\n",
            numbers(&stated, ", ")
        ));
    }
    text.push_str("console.log(\"all results match the check values\");\n");
    text
}
