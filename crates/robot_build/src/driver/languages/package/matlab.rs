//! A package in MATLAB: a folder of functions, and a test.

use robot_codegen::backend::SourceFile;
use robot_codegen::backend::flat::Tree;
use robot_codegen::backend::matlab;

use super::call::{arguments, checked, numbers};
use super::{Parts, description, file, of_sources};
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// Makes the files of the package.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = matlab::tree(parts.module, parts.flat);
    let mut files = vec![
        file("README.md", readme(parts, &tree)),
        file("robot.json", description::json(parts, &tree)),
    ];
    let folder = format!("+{}", tree.name);
    files.extend(
        of_sources(sources).map(|file| File { path: format!("{folder}/{}", file.path), ..file }),
    );
    files.push(file("test_functions.m", test(parts, &tree)));
    files
}

/// Prints the statements that make `model`, if there are parameters.
fn model(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    if !tree.has_parameters() {
        return String::new();
    }
    let name = &tree.name;
    let mut text = format!("parameters = {name}.nominal();\n");
    for (field, value) in parts.given_parameters(tree) {
        text.push_str(&format!("parameters.{field} = {value:?};\n"));
    }
    text.push_str(&format!("model = {name}.create_model(parameters);\n"));
    text
}

fn readme(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let mut usage = format!("```matlab\n{}", model(parts, tree));
    if let Some((function, check)) = checked(parts, tree).next() {
        let arguments = arguments(tree, check, ["[", "]"], "; ");
        usage.push_str(&format!("{name}.{}({arguments})\n", function.name));
    }
    usage.push_str(&format!(
        "```\n\nPut this folder on the path: the functions are in the package folder `+{name}`. Inputs may have a column for each of \
         several states; another number of rows is an error. Each file is self-contained and has `%#codegen`, so it can be \
         pasted into a MATLAB Function block of Simulink; it also runs in Octave. Test it with `test_functions`.\n"
    ));
    parts.readme(tree, "MATLAB", &usage, "create_model")
}

fn test(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let mut text = format!(
        "function test_functions()\n%TEST_FUNCTIONS The check values of the README.\n% {}\n{}",
        unnamed_header(),
        model(parts, tree)
    );
    for (function, check) in checked(parts, tree) {
        let arguments = arguments(tree, check, ["[", "]"], "; ");
        let outputs: Vec<String> =
            (1..=check.outputs.len()).map(|index| format!("found{index}_")).collect();
        text.push_str(&format!(
            "[{}] = {name}.{}({arguments});\n",
            outputs.join(", "),
            function.name
        ));
        for (found, output) in outputs.iter().zip(&check.outputs) {
            let stated = match output.shape.as_slice() {
                [rows, columns] => {
                    let rows_of: Vec<String> = output
                        .values
                        .chunks((*columns).max(1))
                        .map(|row| numbers(row, ", "))
                        .collect();
                    format!("reshape([{}], {rows}, {columns})", rows_of.join("; "))
                }
                _ => format!("[{}]", numbers(&output.values, "; ")),
            };
            text.push_str(&format!("check('{}', {found}, {stated});\n", function.name));
        }
    }
    text.push_str(
        "disp('all results match the check values');
end

function check(what, found, stated)
size_ = max(abs(stated(:)));
if any(abs(found(:) - stated(:)) > 1e-12 * size_)
    error('%s does not give its check value', what);
end
end
",
    );
    text
}
