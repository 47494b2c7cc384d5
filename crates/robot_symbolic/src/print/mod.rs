//! Printers: numbers and expressions as text.

mod number;

pub use number::exact_text;
