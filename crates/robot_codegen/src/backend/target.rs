//! The properties of a language that the rest of the compiler needs.

use super::common::{Reserved, identifier, unreserved};
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
    pub reserved: &'static Reserved,
    /// Further names that a module cannot have: its files or its scope would hide what the language comes with.
    pub modules: &'static [&'static str],
    /// The sizes of expressions, blocks and functions that its compilers handle well.
    pub limits: Limits,
}

impl Language {
    /// The name of a module in printed code: an identifier as close to `text` as possible; a name that is reserved, or
    /// that would hide a part of the language's own library, gets an underscore.
    #[must_use]
    pub fn module_name(&self, text: &str) -> String {
        unreserved(identifier(text, self.reserved), &[self.modules])
    }
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

#[cfg(all(
    test,
    feature = "c",
    feature = "javascript",
    feature = "matlab",
    feature = "python",
    feature = "rust",
    feature = "wgsl"
))]
mod tests {
    use super::{Language, Target};
    use crate::backend::{c, javascript, matlab, python, rust, wgsl};

    fn languages() -> [&'static Language; 7] {
        [
            &c::LANGUAGE,
            c::Arduino::default().language(),
            &javascript::LANGUAGE,
            &matlab::LANGUAGE,
            &python::LANGUAGE,
            &rust::LANGUAGE,
            &wgsl::LANGUAGE,
        ]
    }

    #[test]
    fn lists_of_names_are_sorted() {
        for language in languages() {
            for list in language.reserved.iter().chain([&language.modules]) {
                assert!(list.is_sorted_by(|a, b| a < b), "{}", language.name);
            }
        }
    }

    /// A robot file has no names that begin or end with an underscore, or contain two in a row.
    #[test]
    fn macros_are_names_that_robots_can_have() {
        for language in languages() {
            for macros in language.reserved.iter().skip(1) {
                let cannot = macros.iter().find(|name| {
                    name.starts_with('_') || name.ends_with('_') || name.contains("__")
                });
                assert_eq!(cannot, None, "{}", language.name);
            }
        }
        assert_eq!(c::LANGUAGE.module_name("__INT16_MAX__"), "INT16_MAX_");
    }

    #[test]
    fn modules_do_not_hide_libraries() {
        for language in languages() {
            assert_eq!(language.module_name("planar 2r"), "planar_2r");
        }
        for name in ["printf", "stdio", "y0", "stat", "servo", "int"] {
            assert_eq!(c::LANGUAGE.module_name(name), format!("{name}_"));
        }
        for name in ["std", "mean", "cross", "check", "test_functions", "timetable", "sin"] {
            assert_eq!(matlab::LANGUAGE.module_name(name), format!("{name}_"));
        }
        for name in ["random", "numpy", "test", "lambda"] {
            assert_eq!(python::LANGUAGE.module_name(name), format!("{name}_"));
        }
        for name in ["test", "core", "match"] {
            assert_eq!(rust::LANGUAGE.module_name(name), format!("{name}_"));
        }
    }
}
