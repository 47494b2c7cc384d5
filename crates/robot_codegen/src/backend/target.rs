//! The properties of a language that the rest of the compiler needs.

use crate::error::Errors;
use crate::module::Module;
use crate::program::Limits;

/// A language in which modules are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Language {
    /// The name of the language, as people write it.
    pub name: &'static str,
    /// The extension of its source files.
    pub extension: &'static str,
    /// The words that cannot be names in printed code; names from robot files are adapted if necessary.
    pub reserved: &'static [&'static str],
    /// The sizes of expressions, blocks and functions that its compilers handle well.
    pub limits: Limits,
}

/// A source file of a printed module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// The name, without a folder.
    pub name: String,
    /// The contents of the file.
    pub contents: Contents,
}

impl SourceFile {
    /// Makes a text file.
    #[must_use]
    pub fn text(name: String, text: String) -> SourceFile {
        SourceFile { name, contents: Contents::Text(text) }
    }
}

/// The contents of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Contents {
    /// Text.
    Text(String),
    /// Bytes that are not text.
    Bytes(Vec<u8>),
}

impl Contents {
    /// The bytes of the file.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        match self {
            Contents::Text(text) => text.as_bytes(),
            Contents::Bytes(bytes) => bytes,
        }
    }

    /// The text; `None` if the file is not a text file.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match self {
            Contents::Text(text) => Some(text),
            Contents::Bytes(_) => None,
        }
    }
}

/// A language with the options of its printer.
pub trait Target {
    /// The language.
    fn language(&self) -> &'static Language;

    /// Prints the source files of a module, in a fixed order.
    ///
    /// # Errors
    ///
    /// Options that the language does not support, and constants that its number type cannot represent.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors>;
}
