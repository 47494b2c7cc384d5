//! A package in Python: the module, a test, and a file for installers.

use robot_codegen::backend::SourceFile;
use robot_codegen::backend::flat::Tree;
use robot_codegen::backend::python;

use super::call::{arguments, checked, numbers};
use super::{Parts, description, file, of_sources};
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// Makes the files of the package.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = python::tree(parts.module, parts.flat);
    let mut files = vec![
        file("README.md", readme(parts, &tree)),
        file("pyproject.toml", project(&tree)),
        file("robot.json", description::json(parts, &tree)),
    ];
    files.extend(of_sources(sources));
    files.push(file("test.py", test(parts, &tree)));
    files
}

fn project(tree: &Tree<'_>) -> String {
    let name = &tree.name;
    format!(
        "# {}
[build-system]
requires = [\"setuptools>=61\"]
build-backend = \"setuptools.build_meta\"

[project]
name = \"{name}\"
version = \"0.1.0\"
description = \"Dynamics of a robot\"
readme = \"README.md\"
requires-python = \">=3.9\"

[tool.setuptools]
py-modules = [\"{name}\"]
",
        unnamed_header()
    )
}

/// Prints the lines that make `model`, if there are parameters.
fn model(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    if !tree.has_parameters() {
        return String::new();
    }
    let name = &tree.name;
    let given = parts.given_parameters(tree).into_iter();
    let given: Vec<String> = given.map(|(field, value)| format!("{field}={value:?}")).collect();
    format!("model = {name}.Model({name}.Parameters({}))\n", given.join(", "))
}

fn readme(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let mut usage = format!("```python\nimport {name}\n\n{}", model(parts, tree));
    if let Some((function, check)) = checked(parts, tree).next() {
        let arguments = arguments(tree, check, ["[", "]"], ", ");
        usage.push_str(&format!("{name}.{}({arguments})\n", function.name));
    }
    usage.push_str(&format!(
        "```\n\nThe module `{name}.py` needs only Python. With NumPy each input may be an array: of shape (n,) for one state, or of \
         shape (n, N), with a column for each state, for many; another length raises a `ValueError`. Install it with \
         `pip install .`, or copy the file; test it with `python test.py`.\n"
    ));
    parts.readme(tree, "Python", &usage, "Model")
}

fn test(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let mut text = format!(
        "# {}
\"\"\"The check values of the README.\"\"\"

import {name}


def flat(value):
    if isinstance(value, (list, tuple)):
        return [entry for part in value for entry in flat(part)]
    return [float(value)]


def check(what, found, stated):
    found = flat(list(found.values()) if isinstance(found, dict) else found)
    size = max(map(abs, stated), default=0.0)
    assert len(found) == len(stated), what
    for a, b in zip(found, stated):
        assert abs(a - b) <= 1e-12 * size, f\"{{what}} gives {{a}}, expected {{b}}\"


{}",
        unnamed_header(),
        model(parts, tree)
    );
    for (function, check) in checked(parts, tree) {
        let (name_of, arguments) = (&function.name, arguments(tree, check, ["[", "]"], ", "));
        let stated: Vec<f64> =
            check.outputs.iter().flat_map(|output| output.values.iter().copied()).collect();
        text.push_str(&format!(
            "check(\"{name_of}\", {name}.{name_of}({arguments}), [{}])\n",
            numbers(&stated, ", ")
        ));
    }
    text.push_str("print(\"all results match the check values\")\n");
    text
}
