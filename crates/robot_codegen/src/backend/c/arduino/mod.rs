//! The header of C as an Arduino library, whose names are not those of Arduino's macros.

mod macros;

use super::{LANGUAGE as C, header_file, keywords, names, standard, tree_of};
use crate::backend::common::check_range;
use crate::backend::flat::{FlatOptions, Tree};
use crate::backend::{Language, SourceFile, Target};
use crate::error::Errors;
use crate::module::Module;

/// C for Arduino, as a language of printed code.
const LANGUAGE: Language = Language {
    name: "Arduino",
    reserved: &[keywords::RESERVED, standard::MACROS, macros::MACROS],
    ..C
};

/// The printer of C for Arduino.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arduino {
    /// The options.
    pub options: FlatOptions,
}

impl Target for Arduino {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints one header.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        check_range(module, self.options.scalar)?;
        Ok(vec![header_file(&arduino_tree(module, &self.options), &self.options)])
    }
}

/// The tree of a module as it is printed for Arduino.
#[must_use]
pub fn arduino_tree<'m>(module: &'m Module, options: &FlatOptions) -> Tree<'m> {
    tree_of(module, &LANGUAGE, options, names::TAKEN, &["sc", "batch"])
}
