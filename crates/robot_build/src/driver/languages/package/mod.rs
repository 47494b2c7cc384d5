//! Whole packages: the module, files to build it, a test and a README.

mod arduino;
mod c;
mod call;
mod casadi;
mod cpp;
mod cuda;
mod description;
mod javascript;
mod matlab;
mod python;
mod wasm;
mod wgsl;

use robot_codegen::Module;
use robot_codegen::backend::SourceFile;
use robot_codegen::backend::flat::{FlatOptions, Tree};
use robot_model::diagnostic::Source;

use super::{Language, check, printing, sources_of};
use crate::driver::budget;
use crate::driver::check::{CheckValue, finite_check_values};
use crate::driver::file::File;
use crate::driver::generate::{file_name, unnamed_header};
use crate::driver::options::Options;
use crate::driver::package;
use crate::driver::programs::Programs;
use crate::driver::readme::{Sections, paragraph, plain, section};
use crate::error::Errors;

/// Generates the files of a package with a robot's functions in a language, in a fixed order: the sources, which can be
/// built or loaded without changes, a README, a description in JSON and a test of the check values.
///
/// # Errors
///
/// All errors in the file or the options, and options that the language does not have.
pub fn package(
    source: &Source,
    options: &Options,
    language: Language,
) -> Result<Vec<File>, Errors> {
    check(options, language)?;
    if language == Language::Rust {
        return package::package(source, options);
    }
    let programs = budget::programs(source, options)?;
    package_of(&programs, source, options, language)
}

/// Does the same as [`package()`] for existing programs; budgets are not checked.
///
/// # Errors
///
/// Options that the language does not have, and numbers outside the range of single precision.
pub fn package_of(
    programs: &Programs,
    source: &Source,
    options: &Options,
    language: Language,
) -> Result<Vec<File>, Errors> {
    if language == Language::Rust {
        return package::package_of(programs, source, options);
    }
    let module = printing::described(programs);
    let flat = printing::flat_options(programs, source, options);
    let checks = finite_check_values(source, programs, options.trigonometry)?;
    let files = sources_of(programs, source, options, language)?;
    let parts = Parts { source, options, programs, module: &module, flat: &flat, checks: &checks };
    Ok(match language {
        Language::Rust => vec![],
        Language::C => c::files(&parts, files),
        Language::Arduino => arduino::files(&parts, files),
        Language::Cpp => cpp::files(&parts, files),
        Language::Cuda => cuda::files(&parts, files),
        Language::Matlab => matlab::files(&parts, files),
        Language::Python => python::files(&parts, files),
        Language::JavaScript => javascript::files(&parts, files),
        Language::Wasm => wasm::files(&parts, files),
        Language::Wgsl => wgsl::files(&parts, files)?,
    })
}

/// The data from which the files of a package are made.
struct Parts<'a> {
    source: &'a Source,
    options: &'a Options,
    programs: &'a Programs,
    module: &'a Module,
    flat: &'a FlatOptions,
    /// The check values that are finite.
    checks: &'a [CheckValue],
}

/// Makes a text file of a package.
fn file(path: &str, text: String) -> File {
    File::text(path, text)
}

/// Converts source files to files of the package.
fn of_sources(sources: Vec<SourceFile>) -> impl Iterator<Item = File> {
    sources.into_iter().map(|SourceFile { name, contents }| File { path: name, contents })
}

impl Parts<'_> {
    /// Prints the README: what the package is, how it is used, and the sections that all READMEs share.
    fn readme(&self, tree: &Tree<'_>, what: &str, usage: &str, constructor: &str) -> String {
        let robot = &self.programs.robot;
        let from = plain(&file_name(self.source));
        let mut text = format!(
            "<!-- {} -->\n\n# {}\n\nThe dynamics of the robot {} in {what}, generated from `{from}`.\n",
            unnamed_header(),
            robot.name,
            robot.name,
        );
        if let Some(description) = &robot.description {
            paragraph(&mut text, &plain(description));
        }
        section(&mut text, "Use");
        text.push_str(usage);
        for (setter, name) in self.flat.setters.iter().zip(&tree.setters) {
            let arguments: Vec<&str> =
                setter.arguments.iter().map(|argument| argument.name.as_str()).collect();
            paragraph(
                &mut text,
                &format!(
                    "`{name}` sets these values in the parameters: `{}`.",
                    arguments.join("`, `")
                ),
            );
        }
        let functions: Vec<String> =
            tree.functions.iter().map(|function| function.name.clone()).collect();
        let sections = Sections {
            robot,
            module: self.module,
            parameters: &tree.parameters,
            functions: &functions,
            constructor,
            trigonometry: self.options.trigonometry,
            checks: self.checks,
        };
        sections.add(&mut text);
        text
    }

    /// The fields of the parameters without nominal values, with the values for which the check values were computed.
    fn given_parameters<'t>(&self, tree: &'t Tree<'_>) -> Vec<(&'t str, f64)> {
        let fields = tree.parameters.iter().map(String::as_str).zip(self.stated_parameters());
        let specs = self.module.parameters.iter().zip(fields);
        specs.filter(|(spec, _)| spec.nominal.is_none()).map(|(_, given)| given).collect()
    }

    /// The value of each parameter for which the check values were computed.
    fn stated_parameters(&self) -> Vec<f64> {
        let stated = self.checks.first().map_or(&[][..], |check| check.parameters.as_slice());
        let values = self.module.parameters.iter().map(|parameter| {
            let stated = stated.iter().find(|(name, _)| *name == parameter.name);
            parameter.nominal.or(stated.map(|(_, value)| *value)).unwrap_or(1.0)
        });
        values.collect()
    }
}
