//! Formulas as layouts that do not depend on a notation. [`math`] is the tree, [`symbols`] makes it from expressions
//! and polynomials, [`breaking`] splits it into lines by its [`width`], and [`meaning`] turns it back into an
//! expression.

mod appearance;
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
pub(crate) use order::{is_motion, is_rate, is_root_of_number};
pub use symbols::SymbolTable;
pub use trigonometry::Trigonometry;
