//! LaTeX: the printers of formulas and documents, and the reader of LaTeX in robot files and printed equations.

mod document;
mod equations;
mod figure;
mod formula;
mod read;
mod read_back;
mod text;

pub use document::{Page, document};
pub(super) use equations::continued;
pub use equations::{Layout, equations};
pub use formula::formula;
pub(crate) use read::read_symbol;
pub use read::{ReadError, read};
pub use read_back::read_equations;
pub use text::text;
