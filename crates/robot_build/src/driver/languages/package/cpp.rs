//! A package in C++: both headers, a test, and a file for CMake.

use robot_codegen::Scalar;
use robot_codegen::backend::SourceFile;
use robot_codegen::backend::c;
use robot_codegen::backend::flat::{Function, Tree};

use super::c::{FLAGS, has_bits, options};
use super::call::{checked, numbers};
use super::{Parts, description, file, of_sources};
use crate::driver::check::CheckValue;
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// Makes the files of the package.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = c::tree(parts.module, parts.flat);
    let mut files = vec![
        file("README.md", readme(parts, &tree)),
        file("CMakeLists.txt", cmake(&tree)),
        file("robot.json", description::json(parts, &tree)),
    ];
    files.extend(of_sources(sources));
    files.push(file("test.cpp", test(parts, &tree)));
    files
}

fn real(parts: &Parts<'_>) -> &'static str {
    if parts.options.scalar == Scalar::F64 { "double" } else { "float" }
}

fn cmake(tree: &Tree<'_>) -> String {
    let name = &tree.name;
    format!(
        "# {}
cmake_minimum_required(VERSION 3.13)
project({name} LANGUAGES CXX)

add_library({name} INTERFACE)
target_include_directories({name} INTERFACE ${{CMAKE_CURRENT_SOURCE_DIR}})
target_compile_features({name} INTERFACE cxx_std_17)
# Products and sums are not fused, so that results have the same bits on every machine.
target_compile_options({name} INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>)
# Some versions of gcc still fuse products and sums when they vectorize straight-line code.
target_compile_options({name} INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

enable_testing()
add_executable({name}_test test.cpp)
target_link_libraries({name}_test PRIVATE {name})
add_test(NAME {name} COMMAND {name}_test)
",
        unnamed_header()
    )
}

/// Prints the statements that make `model`, if there are parameters.
fn model(parts: &Parts<'_>, tree: &Tree<'_>) -> Vec<String> {
    if !tree.has_parameters() {
        return vec![];
    }
    let name = &tree.name;
    let mut lines = vec![format!("{name}::Parameters parameters;")];
    let fields = tree.parameters.iter().zip(parts.stated_parameters());
    lines.extend(fields.map(|(field, value)| format!("parameters.{field} = {value:?};")));
    lines.push(format!("const {name}::Model model(parameters);"));
    lines
}

/// The entries of each input at a check state.
fn inputs(parts: &Parts<'_>, check: &CheckValue) -> impl Iterator<Item = String> {
    let suffix = if parts.options.scalar == Scalar::F32 { "F" } else { "" };
    check.inputs.iter().map(move |(_, values)| {
        let entries = values.iter().map(|value| format!("{value:?}{suffix}"));
        entries.collect::<Vec<_>>().join(", ")
    })
}

/// Prints the arguments of the call at a check state.
fn arguments(parts: &Parts<'_>, tree: &Tree<'_>, check: &CheckValue) -> String {
    let model = tree.has_parameters().then(|| "model".to_owned());
    let inputs = inputs(parts, check).map(|entries| format!("{{{{{entries}}}}}"));
    model.into_iter().chain(inputs).collect::<Vec<_>>().join(", ")
}

fn readme(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let name = &tree.name;
    let mut usage = format!("```cpp\n#include \"{name}.hpp\"\n\n");
    for line in model(parts, tree) {
        usage.push_str(&format!("{line}\n"));
    }
    if let Some((function, check)) = checked(parts, tree).next() {
        let arguments = arguments(parts, tree, check);
        usage.push_str(&format!("const auto result = {name}::{}({arguments});\n", function.name));
    }
    usage.push_str(&format!(
        "```\n\n`{name}.hpp` includes `{name}.h`, which can also be used from C; a matrix is an array, row by row. Several outputs are \
         returned as a structure. To test it:\n\n```sh\nc++ -std=c++17 -O2 -ffp-contract=off test.cpp -o test && \
         ./test\n```\n\nor with CMake: `cmake -B build && cmake --build build && ctest --test-dir build`. {}\n",
        options(parts)
    ));
    parts.readme(tree, "C++17: straight-line code without branches or allocation", &usage, "Model")
}

fn test(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let mut text = comparison(parts, tree);
    if has_bits(parts) {
        text.push_str(FLAGS);
    }
    text.push_str("int main()\n{\n");
    for line in model(parts, tree) {
        text.push_str(&format!("    {line}\n"));
    }
    if has_bits(parts) {
        text.push_str("    name_flags();\n");
    }
    for (function, check) in checked(parts, tree) {
        text.push_str(&test_of(parts, tree, function, check));
    }
    text.push_str(
        "    puts(failures ? \"FAILED\" : \"all results match the check values\");\n    return failures != 0;\n}\n",
    );
    text
}

/// Prints the part of the test before `main`.
fn comparison(parts: &Parts<'_>, tree: &Tree<'_>) -> String {
    let (name, real) = (&tree.name, real(parts));
    let tolerance = if parts.options.scalar == Scalar::F64 { "1e-12" } else { "1e-4" };
    let bits = match has_bits(parts) {
        true => {
            "        // Where the code promises them, all bits.
        if (std::memcmp(&found[i], &stated[i], sizeof stated[i]) != 0) {
            printf(\"%s: last bits of entry %zu differ: compile with -ffp-contract=off and, with gcc, -fno-tree-slp-vectorize\\n\", what, i);
            failures++;
        }
"
        }
        false => "",
    };
    format!(
        "// {}
// The check values of the README.

#include \"{name}.hpp\"

#include <cmath>
#include <cstring>
#include <stdio.h>
#include <vector>

static int failures = 0;

// The compiler must not know the numbers; otherwise it could compute the results itself.
template <std::size_t N> static std::array<{real}, N> hidden(std::array<{real}, N> numbers)
{{
    for ({real} &number : numbers) {{
        volatile {real} unknown = number;
        number = unknown;
    }}
    return numbers;
}}

static void append(std::vector<double> &entries, {real} value) {{ entries.push_back(static_cast<double>(value)); }}

template <std::size_t N> static void append(std::vector<double> &entries, const std::array<{real}, N> &values)
{{
    for ({real} value : values) {{
        append(entries, value);
    }}
}}

static void check(const char *what, const std::vector<double> &found, const std::vector<double> &stated)
{{
    double size = 0.0;
    for (double value : stated) {{
        size = std::fmax(size, std::fabs(value));
    }}
    for (std::size_t i = 0; i < stated.size(); i++) {{
        if (found.size() != stated.size() || !(std::fabs(found[i] - stated[i]) <= {tolerance} * size)) {{
            printf(\"%s: entry %zu is not the stated one\\n\", what, i);
            failures++;
            continue;
        }}
{bits}    }}
}}

",
        unnamed_header()
    )
}

/// Prints the check of one function.
fn test_of(
    parts: &Parts<'_>,
    tree: &Tree<'_>,
    function: &Function<'_>,
    check: &CheckValue,
) -> String {
    let stated: Vec<f64> =
        check.outputs.iter().flat_map(|output| output.values.iter().copied()).collect();
    let (name, called) = (&tree.name, &function.name);
    let model = tree.has_parameters().then(|| "model".to_owned());
    let inputs = function
        .inputs
        .iter()
        .zip(inputs(parts, check))
        .map(|(array, entries)| format!("hidden<{}>({{{{{entries}}}}})", array.length));
    let arguments = model.into_iter().chain(inputs).collect::<Vec<_>>().join(", ");
    let mut text = format!(
        "    {{\n        const auto result = {name}::{called}({arguments});\n        std::vector<double> found;\n"
    );
    for array in &function.outputs {
        let field =
            if function.outputs.len() > 1 { format!(".{}", array.name) } else { String::new() };
        text.push_str(&format!("        append(found, result{field});\n"));
    }
    text.push_str(&format!(
        "        check(\"{called}\", found, {{{}}});\n    }}\n",
        numbers(&stated, ", ")
    ));
    text
}
