//! The notations, each with its printer.

mod front;
pub mod html;
pub mod latex;
pub mod markdown;
pub mod math_font;
pub mod mathml;
mod tabular;
pub mod typst;
mod words;
