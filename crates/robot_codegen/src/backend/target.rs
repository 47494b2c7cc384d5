//! The properties of a language that the rest of the compiler needs.

use crate::error::Errors;
use crate::module::Module;
use crate::program::Limits;

/// A language that modules are printed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Language {
    /// Its name, as people write it.
    pub name: &'static str,
    /// The extension of its source files.
    pub extension: &'static str,
    /// The words that no printed name may be, if names of a robot file are used.
    pub reserved: &'static [&'static str],
    /// The sizes of expressions, blocks and functions that its compilers take well.
    pub limits: Limits,
}

/// A source file of a printed module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// The name, without a folder.
    pub name: String,
    /// The text.
    pub text: String,
}

/// A language with the options of its printer.
pub trait Target {
    /// The language.
    fn language(&self) -> &'static Language;

    /// The source files of a module, in a fixed order.
    ///
    /// # Errors
    ///
    /// Options that the language does not take, and constants that its numbers cannot hold.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors>;
}
