//! Printers of compiled modules. [`common`] is shared by the printers of all languages, [`flat`] by those that print
//! functions of statements. Each language has a module of its own, behind a feature of its name.

#[cfg(feature = "c")]
pub mod c;
pub mod common;
#[cfg(feature = "flat")]
pub mod flat;
#[cfg(feature = "javascript")]
pub mod javascript;
#[cfg(feature = "matlab")]
pub mod matlab;
#[cfg(feature = "python")]
pub mod python;
#[cfg(feature = "rust")]
pub mod rust;
mod target;
#[cfg(feature = "wasm")]
pub mod wasm;
#[cfg(feature = "wgsl")]
pub mod wgsl;

pub use target::{Contents, Language, SourceFile, Target};
