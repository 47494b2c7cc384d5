//! Printers of compiled modules: [`common`] has what a printer of any language needs, [`flat`] what those share that
//! print functions of statements. Beside them stands a module for each language, behind a feature of its name.

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
