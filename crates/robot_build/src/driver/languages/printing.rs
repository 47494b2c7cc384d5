//! The options of printers.

use robot_codegen::Module;
use robot_codegen::backend::flat::FlatOptions;
use robot_codegen::backend::rust::{RustOptions, Wrapping};
use robot_model::diagnostic::Source;

use crate::driver::generate;
use crate::driver::options::Options;
use crate::driver::programs::Programs;
use crate::driver::specification;

/// The options for printing Rust as a module.
pub(super) fn rust_options(programs: &Programs, source: &Source, options: &Options) -> RustOptions {
    generate::rust_options(programs, source, options, Wrapping::Module)
}

/// The options for the other printers.
pub(super) fn flat_options(programs: &Programs, source: &Source, options: &Options) -> FlatOptions {
    FlatOptions {
        header: vec![generate::header(source)],
        trigonometry: options.trigonometry,
        scalar: options.scalar,
        constants: generate::constants(programs),
        setters: generate::setters(&programs.robot),
    }
}

/// The module with documentation that does not mention Rust.
pub(super) fn described(programs: &Programs) -> Module {
    let doc = specification::module_doc(&programs.robot, &[]);
    Module { doc, ..programs.module.clone() }
}
