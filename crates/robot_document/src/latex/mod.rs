//! LaTeX: formulas, documents, and the way back.

mod document;
mod equations;
mod formula;
mod read;
mod read_back;
mod text;

pub(crate) use document::natural_width;
pub use document::{Page, document};
pub use equations::{Layout, equations};
pub use formula::formula;
pub(crate) use read::read_name;
pub use read::{ReadError, Symbols, read};
pub use read_back::read_equations;
pub use text::text;
