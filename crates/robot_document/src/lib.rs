//! Equations of robots as documents.
//!
//! [`forms`] puts the equations of motion in the form that is asked for; each side of an equation is a
//! [`math::Math`], a layout of pieces that no notation owns, made of expressions by a [`SymbolTable`]. A
//! [`document::Document`] holds headings, text, tables and equations, still in no notation; [`robot`] fills
//! one from a robot. Each notation is a printer of its own: [`latex`], [`mathml`], [`typst`]; [`html`] makes
//! a page. HTML and MathML are trees of [`markup`], which escapes all text. The infix text beside each formula is that of `robot_symbolic`, which reads back.
//!
//! [`latex::read`] and [`meaning`] go the way back, from LaTeX to layout and to the expression that it stands
//! for, so that tests can prove what was printed.

pub mod base_parameters;
pub mod document;
mod error;
pub mod figure;
pub mod forms;
mod layout;
pub mod markup;
mod notation;
pub mod robot;

pub use error::{Centimeters, Error};
pub use forms::{Array, Cell, Room, Written};
pub use forms::{
    Equation, EquationOptions, Equations, Form, Group, InvalidLetters, Letters, TermOrder, Unlike,
    equations,
};
pub use layout::{DIGITS, Order, Rank, SymbolTable, Trigonometry};
pub use layout::{breaking, math, meaning, width};
pub use notation::{html, latex, markdown, math_font, mathml, typst};
