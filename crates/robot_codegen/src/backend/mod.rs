//! Printers of compiled modules: [`common`] has what a printer of any language needs, beside it stands
//! a module for each language, behind a feature of its name.

pub mod common;
#[cfg(feature = "rust")]
pub mod rust;
mod target;

pub use target::{Language, SourceFile, Target};
