//! The symbols of printed formulas: letters, accents, fonts and functions, each in one row with its spelling in every
//! notation; and [`check_latex`], the check of LaTeX that robot files give for symbols.

mod accent;
mod font;
mod function;
mod latex;
mod letter;

pub use accent::Accent;
pub use font::Font;
pub use function::FunctionName;
pub use latex::{LatexError, check_latex};
pub use letter::{LETTERS, Letter, Use};
