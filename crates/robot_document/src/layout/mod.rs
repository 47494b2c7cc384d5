//! Formulas as layout, in no notation: [`math`] is the tree, [`symbols`] makes it of expressions and of
//! polynomials, [`breaking`] cuts it into lines by its [`width`], [`meaning`] goes the way back.

pub mod breaking;
mod digits;
mod expression;
pub mod math;
pub mod meaning;
mod order;
mod polynomial;
mod spelling;
mod symbols;
#[cfg(test)]
mod tests;
mod trigonometry;
pub mod width;

pub use digits::DIGITS;
pub(crate) use digits::{has_longer, number, tidied, tidied_text};
pub(crate) use order::BRACKETS;
pub use order::{Order, Rank};
pub(crate) use order::{is_motion, is_rate};
pub use symbols::SymbolTable;
pub use trigonometry::Trigonometry;
