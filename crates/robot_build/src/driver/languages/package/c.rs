//! A package in C: the header, a test of it, and a file for CMake.

use robot_codegen::backend::SourceFile;
use robot_codegen::backend::c::{self, Casadi, Names};
use robot_codegen::backend::flat::{Function, Tree};
use robot_codegen::{Scalar, Trigonometry};

use super::{Parts, casadi, description, file, of_sources};
use crate::driver::check::CheckValue;
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// Makes the files of the package.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = c::tree(parts.module, parts.flat);
    let casadi = c::casadi(parts.module, parts.flat);
    let printer =
        Printer { parts, tree: &tree, names: Names::new(&tree.name), casadi: casadi.as_ref() };
    let mut files = vec![
        file("README.md", printer.readme()),
        file("CMakeLists.txt", printer.cmake()),
        file("robot.json", description::json(parts, &tree)),
    ];
    files.extend(of_sources(sources));
    files.push(file("test.c", printer.test()));
    files.extend(of_sources(casadi.into_iter().map(|casadi| casadi.file).collect()));
    files
}

/// The paragraph of the README about compiler options.
pub(super) fn options(parts: &Parts<'_>) -> String {
    let sines = match parts.options.trigonometry {
        Trigonometry::Polynomial => {
            "`-ffast-math` reorders sums, which makes sines wrong, so the header refuses to compile with it"
        }
        Trigonometry::Standard => "`-ffast-math` reorders sums: last bits differ",
    };
    format!(
        "Without `-ffp-contract=off` some compilers fuse products and sums: the last bits of results then differ. With gcc, also \
         use `-fno-tree-slp-vectorize` if the processor has multiply-adds that round once (`-march=native`): version 12 \
         fuses some operations even with `-ffp-contract=off`. {sines}."
    )
}

/// Whether the check values have the bits of the interpreter, which requires double precision.
pub(super) fn has_bits(parts: &Parts<'_>) -> bool {
    parts.options.scalar == Scalar::F64
        && parts.options.trigonometry == Trigonometry::Polynomial
        && !parts.options.fused
}

/// A function of the printed test that names the compiler options that change bits, and counts them as failures.
pub(super) const FLAGS: &str = "/* Names the compiler options that change bits. */
static void name_flags(void)
{
    /* (1 + e)^2 - 1 - 2 e is e^2 if a product and a sum are fused, else 0. */
    volatile double e = 7.450580596923828e-9;
    const double a = 1.0 + e, b = 1.0 + 2.0 * e;
    const double fused = a * a - b;
    /* A sum that is not reordered leaves an integer. */
    const double integer = (e + 6755399441055744.0) - 6755399441055744.0;
    if (fused != 0.0) {
        printf(\"products and sums are fused: compile with -ffp-contract=off\\n\");
        failures++;
    }
    if (integer != 0.0) {
        printf(\"sums are reordered: compile without -ffast-math, -fassociative-math, -funsafe-math-optimizations\\n\");
        failures++;
    }
}

";

/// Prints calls of functions through the C interface.
pub(super) struct Printer<'a> {
    pub(super) parts: &'a Parts<'a>,
    pub(super) tree: &'a Tree<'a>,
    pub(super) names: Names,
    /// The external functions for CasADi, in double precision only.
    pub(super) casadi: Option<&'a Casadi>,
}

impl Printer<'_> {
    pub(super) fn real(&self) -> &'static str {
        match self.parts.options.scalar {
            Scalar::F64 => "double",
            Scalar::F32 => "float",
        }
    }

    fn cmake(&self) -> String {
        let name = &self.tree.name;
        format!(
            "# {}
cmake_minimum_required(VERSION 3.13)
project({name} LANGUAGES C)

add_library({name} INTERFACE)
target_include_directories({name} INTERFACE ${{CMAKE_CURRENT_SOURCE_DIR}})
# Products and sums are not fused, so that results have the same bits on every machine.
target_compile_options({name} INTERFACE $<$<C_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>)
# Some versions of gcc still fuse products and sums when they vectorize straight-line code.
target_compile_options({name} INTERFACE $<$<C_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
if(UNIX)
  target_link_libraries({name} INTERFACE m)
endif()

enable_testing()
add_executable({name}_test test.c)
target_link_libraries({name}_test PRIVATE {name})
set_target_properties({name}_test PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
add_test(NAME {name} COMMAND {name}_test)
{}",
            unnamed_header(),
            self.casadi.map(|_| casadi::cmake(name)).unwrap_or_default()
        )
    }

    fn readme(&self) -> String {
        let name = &self.tree.name;
        let mut usage = String::new();
        if let Some(check) = self.parts.checks.first() {
            let example = [self.model(), self.block(check).unwrap_or_default()].concat().join("\n");
            usage = format!("```c\n#include \"{name}.h\"\n\n{example}\n```\n\n");
        }
        usage.push_str(&format!(
            "Every function is in the header `{name}.h`, which needs only `<math.h>`, and `memcpy` of `<string.h>`. Arrays have \
             elements of type `{}`; a matrix is an array, row by row. To test it:\n\n\
             ```sh\ncc -std=c99 -O2 -ffp-contract=off test.c -o test -lm && ./test\n```\n\n\
             or with CMake: `cmake -B build && cmake --build build && ctest --test-dir build`. {}\n",
            self.real(),
            options(self.parts)
        ));
        usage.push_str(
            &self.casadi.map(|casadi| casadi::usage(self.tree, casadi)).unwrap_or_default(),
        );
        let constructor = self.names.item("model_init");
        self.parts.readme(
            self.tree,
            "C99: straight-line code without branches or allocation",
            &usage,
            &constructor,
        )
    }

    /// Prints the statements that make `model` from the stated parameters, if there are parameters.
    pub(super) fn model(&self) -> Vec<String> {
        if !self.tree.has_parameters() {
            return vec![];
        }
        let (model, parameters) = (self.names.item("model"), self.names.item("parameters"));
        let mut lines = vec![format!("{model} model;")];
        let all = self.parts.module.parameters.iter().all(|one| one.nominal.is_some());
        if all {
            lines.push(format!("{parameters} parameters = {}();", self.names.item("nominal")));
        } else {
            lines.push(format!("{parameters} parameters;"));
            let values = self.parts.stated_parameters();
            let fields = self.tree.parameters.iter().zip(values);
            lines.extend(fields.map(|(field, value)| format!("parameters.{field} = {value:?};")));
        }
        lines.push(format!("{}(&model, &parameters);", self.names.item("model_init")));
        lines
    }

    pub(super) fn function(&self, name: &str) -> Option<&Function<'_>> {
        self.tree.functions.iter().find(|function| function.source.name == name)
    }

    pub(super) fn numbers(&self, values: &[f64]) -> String {
        let suffix = if self.parts.options.scalar == Scalar::F32 { "F" } else { "" };
        let values = values.iter().map(|value| format!("{value:?}{suffix}"));
        values.collect::<Vec<_>>().join(", ")
    }

    /// Prints the call of a function at its check state, with the declarations before it.
    pub(super) fn block(&self, check: &CheckValue) -> Option<Vec<String>> {
        let (function, real) = (self.function(&check.function)?, self.real());
        let mut lines = vec![];
        let mut arguments = vec![];
        if self.tree.has_parameters() {
            arguments.push("&model".to_owned());
        }
        for (array, (_, values)) in function.inputs.iter().zip(&check.inputs) {
            let values = self.numbers(values);
            lines.push(format!("const {real} {}[{}] = {{{values}}};", array.name, array.length));
            arguments.push(array.name.clone());
        }
        for array in &function.outputs {
            lines.push(format!("{real} {}[{}];", array.name, array.length));
            arguments.push(array.name.clone());
        }
        let name = self.names.item(&function.name);
        lines.push(format!("{name}({});", arguments.join(", ")));
        Some(lines)
    }

    fn test(&self) -> String {
        let name = &self.tree.name;
        let mut text = format!(
            "/* {} */\n/* The check values of the README. */\n\n#include \"{name}.h\"\n\n#include <stdio.h>\n\n",
            unnamed_header()
        );
        text.push_str(
            &self.comparison(
                "compile with -ffp-contract=off and, with gcc, -fno-tree-slp-vectorize",
            ),
        );
        text.push_str(&self.hidden());
        if self.has_bits() {
            text.push_str(FLAGS);
        }
        text.push_str("int main(void)\n{\n");
        for line in self.model() {
            text.push_str(&format!("    {line}\n"));
        }
        if self.has_bits() {
            text.push_str("    name_flags();\n");
        }
        for check in self.parts.checks {
            text.push_str(&self.test_of(check));
        }
        text.push_str("    printf(failures ? \"FAILED\\n\" : \"all results match the check values\\n\");\n    return failures != 0;\n}\n");
        text
    }

    /// Prints the function that hides inputs from the compiler.
    pub(super) fn hidden(&self) -> String {
        let real = self.real();
        format!(
            "/* Hides the numbers from the compiler, which could otherwise compute the results during compilation. */
static void hide({real} *numbers, int count)
{{
    volatile {real} number;
    int i;
    for (i = 0; i < count; i++) {{
        number = numbers[i];
        numbers[i] = number;
    }}
}}

"
        )
    }

    /// Prints the function that compares results with stated values; `remedy` is the advice if bits differ.
    pub(super) fn comparison(&self, remedy: &str) -> String {
        let real = self.real();
        let mut text = format!(
            "static int failures = 0;

/* Compares entries to within a fraction of the largest one and, where the code promises equal bits, bit by bit. */
static void check(const char *what, const {real} *found, const {real} *stated, int count)
{{
    double size = 0.0;
    int i, differs = 0;
    for (i = 0; i < count; i++) {{
        if (fabs((double)stated[i]) > size) {{
            size = fabs((double)stated[i]);
        }}
    }}
    for (i = 0; i < count; i++) {{
        if (!(fabs((double)found[i] - (double)stated[i]) <= {} * size)) {{
            printf(\"%s: entry %d is %.17g, expected %.17g\\n\", what, i, (double)found[i], (double)stated[i]);
            failures++;
        }}
        differs |= memcmp(&found[i], &stated[i], sizeof found[i]);
    }}
",
            self.tolerance(),
        );
        text.push_str(&self.bits(remedy));
        text.push_str("}\n\n");
        text
    }

    /// Whether the check values have the bits of the interpreter, which requires double precision.
    pub(super) fn has_bits(&self) -> bool {
        has_bits(self.parts)
    }

    fn bits(&self, remedy: &str) -> String {
        if !self.has_bits() {
            return "    (void)differs;\n".to_owned();
        }
        format!(
            "    if (differs) {{
        printf(\"%s: last bits differ: {remedy}\\n\", what);
        failures++;
    }}
"
        )
    }

    pub(super) fn tolerance(&self) -> &'static str {
        match self.parts.options.scalar {
            Scalar::F64 => "1e-12",
            Scalar::F32 => "1e-4",
        }
    }

    pub(super) fn test_of(&self, check: &CheckValue) -> String {
        let (Some(lines), Some(function)) = (self.block(check), self.function(&check.function))
        else {
            return String::new();
        };
        // The call is the last line; the inputs come first.
        let mut text = "    {\n".to_owned();
        let (declared, call) = lines.split_at(lines.len().saturating_sub(1));
        for line in declared {
            let line = line.strip_prefix("const ").unwrap_or(line);
            text.push_str(&format!("        {line}\n"));
        }
        for array in &function.inputs {
            text.push_str(&format!("        hide({}, {});\n", array.name, array.length));
        }
        for line in call {
            text.push_str(&format!("        {line}\n"));
        }
        for (array, output) in function.outputs.iter().zip(&check.outputs) {
            let (length, values) = (array.length, self.numbers(&output.values));
            text.push_str(&format!(
                "        {{\n            const {} stated_[{length}] = {{{values}}};\n            \
                 check(\"{}\", {}, stated_, {length});\n        }}\n",
                self.real(),
                function.name,
                array.name
            ));
        }
        text.push_str("    }\n");
        text
    }
}
