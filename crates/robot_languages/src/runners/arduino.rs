//! The Arduino library: its example is run as C++ on the processor, and compiled for a Cortex-M4.

use std::path::Path;

use robot_build::Functions;
use robot_build::languages::{Language, package};
use robot_codegen::Scalar;
use robot_model::functions::{Effects, FunctionKind};

use super::{Found, Runner};
use crate::files;
use crate::work::Work;

/// The runner of the library's example. It does not compare bits: wrong check values are an error.
pub(super) struct Arduino;

/// The parts of Arduino that the example uses, for any compiler.
const SHIM: &str = "#include <math.h>
#include <stdio.h>
struct {
    void begin(long) {}
    void print(const char *text) { fputs(text, stdout); }
    void println(const char *text) { puts(text); }
} Serial;
static void delay(unsigned long) {}
";

impl Runner for Arduino {
    fn name(&self) -> &'static str {
        "arduino"
    }

    fn missing(&self) -> Option<String> {
        let is_there =
            ["g++", "arm-none-eabi-g++"].map(|tool| files::is_there(tool, &["--version"]));
        (is_there != [true; 2]).then(|| "g++ or arm-none-eabi-g++ is not installed".to_owned())
    }

    fn has(&self, scalar: Scalar) -> bool {
        scalar == Scalar::F32
    }

    fn has_standard_sines(&self) -> bool {
        false
    }

    /// Runs only three functions, because other runners compile the header with all of them.
    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        let functions = vec![
            FunctionKind::InverseDynamics(Effects::default()),
            FunctionKind::ForwardDynamics(Effects::default()),
            FunctionKind::Gravity,
        ];
        let mut options = work.options.clone();
        options.functions = Functions::Chosen(functions);
        options.bundles = vec![];
        let found = package(&work.source, &options, Language::Arduino);
        for file in found.map_err(|error| error.to_string())? {
            let contents = file.contents.bytes();
            files::write(folder, &file.path, contents)?;
            if file.path.ends_with(".ino") {
                let main = b"int main() { setup(); loop(); return failures != 0; }\n";
                let text = [SHIM.as_bytes(), contents, main].concat();
                files::write(folder, "example.cpp", &text)?;
            }
        }
        let common = ["-std=gnu++11", "-Isrc", "-Wall", "-Wextra", "-Werror", "example.cpp"];
        files::run(folder, "g++", &[&common[..], &["-o", "example"]].concat())?;
        files::run(folder, "./example", &[])?;
        let cortex = ["-mcpu=cortex-m4", "-mthumb", "-Os", "-c", "-o", "example.o"];
        files::run(folder, "arm-none-eabi-g++", &[&common[..], &cortex].concat())?;
        Ok(vec![])
    }
}
