//! An Arduino library: the C header, and an example that is also the test.

use robot_codegen::backend::SourceFile;
use robot_codegen::backend::c::{self, Names};

use super::c::Printer;
use super::{Parts, description, file, of_sources};
use crate::driver::file::File;
use crate::driver::generate::unnamed_header;

/// Makes the files of the library.
pub(super) fn files(parts: &Parts<'_>, sources: Vec<SourceFile>) -> Vec<File> {
    let tree = c::arduino_tree(parts.module, parts.flat);
    let printer = Printer { parts, tree: &tree, names: Names::new(&tree.name), casadi: None };
    let name = &tree.name;
    let mut files = vec![
        file("README.md", readme(&printer)),
        file("library.properties", properties(name)),
        file("robot.json", description::json(parts, &tree)),
    ];
    let sources = of_sources(sources);
    files.extend(sources.map(|file| File { path: format!("src/{}", file.path), ..file }));
    files.push(file(&format!("examples/{name}/{name}.ino"), sketch(&printer)));
    files
}

fn properties(name: &str) -> String {
    format!(
        "# {}
name={name}
version=0.1.0
author=robot_build
maintainer=robot_build
sentence=The dynamics of a robot.
paragraph=Straight-line code in single precision, generated from the description of the robot.
category=Device Control
url=
architectures=*
includes={name}.h
",
        unnamed_header()
    )
}

fn readme(printer: &Printer<'_>) -> String {
    let name = &printer.tree.name;
    let mut usage = format!("```cpp\n#include <{name}.h>\n\n");
    for line in printer.model() {
        usage.push_str(&format!("{line}\n"));
    }
    if let Some(check) = printer.parts.checks.first() {
        let lines = printer.block(check).unwrap_or_default();
        usage.push_str(&format!("{}\n", lines.join("\n")));
    }
    usage.push_str(&format!(
        "```\n\nCopy this folder into `libraries` in your sketchbook, or zip it and use *Add .ZIP Library*. The example `{name}` computes \
         the check values and prints those that differ. Arrays have elements of type `float`; a matrix is an array, row by row. Values that \
         depend only on parameters are computed once in `double`, which must have 64 bits: on AVR it does not, so the example does \
         not compile there.\n"
    ));
    let what = "C99, as an Arduino library: straight-line code without branches or allocation";
    let constructor = printer.names.item("model_init");
    printer.parts.readme(printer.tree, what, &usage, &constructor)
}

fn sketch(printer: &Printer<'_>) -> String {
    let name = &printer.tree.name;
    let mut text = format!(
        "/* {} */
/* The check values of the README, once every ten seconds. */

#include <{name}.h>

static_assert(sizeof(double) == 8, \"values that depend on parameters are computed in 64 bits\");

static int failures = 0;

static void check(const char *what, const float *found, const float *stated, int count)
{{
    float size = 0.0F;
    for (int i = 0; i < count; i++) {{
        size = fmaxf(size, fabsf(stated[i]));
    }}
    for (int i = 0; i < count; i++) {{
        if (!(fabsf(found[i] - stated[i]) <= {}F * size)) {{
            Serial.print(what);
            Serial.println(\": an entry is not the stated one\");
            failures++;
        }}
    }}
}}

{}void setup()
{{
    Serial.begin(115200);
}}

void loop()
{{
    failures = 0;
",
        unnamed_header(),
        printer.tolerance(),
        printer.hidden()
    );
    for line in printer.model() {
        text.push_str(&format!("    {line}\n"));
    }
    for check in printer.parts.checks {
        text.push_str(&printer.test_of(check));
    }
    text.push_str(
        "    Serial.println(failures ? \"FAILED\" : \"all results match the check values\");\n    delay(10000);\n}\n",
    );
    text
}
