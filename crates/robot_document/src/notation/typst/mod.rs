//! Typst: formulas, equations and documents.

mod document;
mod figure;
mod formula;
mod text;

pub use document::{document, equations};
pub use formula::formula;
pub use text::text;
