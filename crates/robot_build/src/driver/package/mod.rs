//! A self-contained crate for a robot: code, runtime, documentation and a test.

mod call;
mod readme;

use robot_codegen::Trigonometry;
use robot_codegen::backend::rust::{self, Names, Wrapping};
use robot_model::diagnostic::Source;

use crate::driver::budget;
use crate::driver::check::{CheckValue, finite_check_values};
use crate::driver::file::File;
use crate::driver::generate::{header, names, rust_text, unnamed_header};
use crate::driver::options::Options;
use crate::driver::programs::Programs;
use crate::error::Errors;

/// Generates the files of a crate with a robot's functions, in a fixed order.
///
/// The crate has no dependencies, because it contains the runtime's modules. With [`Options::parallel`] it has the
/// optional dependency `rayon`, for a feature of the same name. Its default feature `std` adds the choice of the
/// processor at run time, fused multiply-add and the processor's square root. Without it the crate is `no_std`, unless
/// [`Options::trigonometry`] is the standard library, which needs `std`. [`Options::runtime`] has no effect.
///
/// # Errors
///
/// All errors in the file or the options.
pub fn package(source: &Source, options: &Options) -> Result<Vec<File>, Errors> {
    let programs = budget::programs(source, options)?;
    package_of(&programs, source, options)
}

/// Does the same as [`package`] for existing programs; budgets are not checked.
///
/// # Errors
///
/// All errors in the options.
pub fn package_of(
    programs: &Programs,
    source: &Source,
    options: &Options,
) -> Result<Vec<File>, Errors> {
    let options = Options { runtime: "crate::runtime".to_owned(), ..options.clone() };
    let checks = finite_check_values(source, programs, options.trigonometry)?;
    let names = names(programs);
    let parts = Parts { source, options: &options, programs, names, checks: &checks };
    let mut files = vec![
        file("Cargo.toml", parts.manifest()),
        file("README.md", readme::readme(&parts)),
        file("src/lib.rs", parts.root()),
        file("src/model.rs", parts.model()?),
    ];
    for (path, text) in robot_runtime::SOURCES {
        files.push(file(
            &format!("src/runtime/{path}"),
            format!("// {}\n\n{text}", unnamed_header()),
        ));
    }
    files.push(file("tests/check.rs", parts.tests()));
    Ok(files)
}

fn file(path: &str, text: String) -> File {
    File::text(path, text)
}

/// The data from which the files are made.
struct Parts<'a> {
    source: &'a Source,
    options: &'a Options,
    programs: &'a Programs,
    /// The names of the printed items.
    names: Names,
    checks: &'a [CheckValue],
}

impl Parts<'_> {
    /// The name of the crate.
    fn name(&self) -> &str {
        &self.names.module
    }

    /// The method of a function.
    fn method<'n>(&'n self, function: &'n str) -> &'n str {
        let functions = &self.programs.module.functions;
        let index = functions.iter().position(|known| known.name == function);
        index.and_then(|index| self.names.functions.get(index)).map_or(function, String::as_str)
    }

    /// For each output of a function, the suffix that selects it from the result of a call.
    fn outputs(&self, function: &str) -> Vec<String> {
        match self.programs.module.function(function) {
            Some(function) if function.outputs.len() > 1 => {
                rust::output_names(function).iter().map(|name| format!(".{name}")).collect()
            }
            _ => vec![String::new()],
        }
    }

    fn needs_std(&self) -> bool {
        self.options.trigonometry == Trigonometry::Standard
    }

    fn manifest(&self) -> String {
        let (name, robot) = (self.name(), &self.programs.robot.name);
        let (feature, dependency) = match self.options.parallel {
            true => (
                "# Parallel batches.\nrayon = [\"dep:rayon\"]\n",
                "\n[dependencies]\nrayon = { version = \"1.11\", optional = true }\n",
            ),
            false => ("", ""),
        };
        format!(
            "# {}\n\n\
             [package]\n\
             name = \"{name}\"\n\
             version = \"0.1.0\"\n\
             edition = \"2024\"\n\
             rust-version = \"{}\"\n\
             description = \"Dynamics of the robot {robot}\"\n\
             readme = \"README.md\"\n\
             publish = false\n\n\
             [features]\n\
             default = [\"std\"]\n\
             # Code for the processor at hand, fused multiply-add and square root of the standard library.\n\
             std = []\n{feature}{dependency}",
            header(self.source),
            robot_runtime::RUST_VERSION,
        )
    }

    fn root(&self) -> String {
        let guard = if self.needs_std() {
            "\n#[cfg(not(feature = \"std\"))]\ncompile_error!(\"sine and cosine come from the \
             standard library: enable the feature `std`\");\n"
        } else {
            ""
        };
        format!(
            "// {}\n\n\
             #![doc = include_str!(\"../README.md\")]\n\
             #![no_std]\n\
             #![deny(unsafe_code)]\n\n\
             mod model;\n\
             pub mod runtime;\n\n\
             pub use model::*;\n\
             {guard}",
            header(self.source)
        )
    }

    fn model(&self) -> Result<String, Errors> {
        let code = rust_text(self.programs, self.source, self.options, Wrapping::Items)?;
        // The inner attribute must be before all items and after the comment at the top.
        let (comment, items) = code.split_once("\n\n").unwrap_or(("", &code));
        let lints: Vec<String> =
            rust::allowed_lints().iter().map(|lint| format!("    {lint},\n")).collect();
        Ok(format!("{comment}\n\n#![allow(\n{})]\n\n{items}", lints.concat()))
    }

    /// Prints tests that compare every function with its check value.
    fn tests(&self) -> String {
        let (name, tolerance) = (self.name(), call::tolerance(self.options));
        let tests: Vec<String> = self.checks.iter().map(|check| call::test(self, check)).collect();
        format!(
            "// {}\n\
             //! The check values of the README.\n\n\
             use {name}::*;\n\n\
             /// Compares entries, to within a fraction of the largest one.\n\
             fn assert_close<T>(found: &[T], stated: &[f64])\n\
             where\n    \
                 T: ::core::marker::Copy + ::core::convert::Into<f64>,\n\
             {{\n    \
                 let size = stated.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));\n    \
                 assert_eq!(found.len(), stated.len());\n    \
                 for (found, stated) in found.iter().zip(stated) {{\n        \
                     let difference = ((*found).into() - stated).abs();\n        \
                     assert!(difference <= {tolerance:?} * size, \"off by {{difference}}\");\n    \
                 }}\n\
             }}\n{}",
            header(self.source),
            tests.concat()
        )
    }
}
