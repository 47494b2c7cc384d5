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
    /// What is in it.
    pub contents: Contents,
}

impl SourceFile {
    /// A file of text.
    #[must_use]
    pub fn text(name: String, text: String) -> SourceFile {
        SourceFile { name, contents: Contents::Text(text) }
    }
}

/// What is in a file.
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

    /// The text; `None` of bytes that are not text.
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

    /// The source files of a module, in a fixed order.
    ///
    /// # Errors
    ///
    /// Options that the language does not take, and constants that its numbers cannot hold.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors>;
}
