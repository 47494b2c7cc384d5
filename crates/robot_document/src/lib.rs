//! Equations of robots as documents.
//!
//! [`forms`] puts the equations of motion in the requested form; each side of an equation is a [`math::Math`], a
//! layout that is independent of the notation, which a [`SymbolTable`] makes from expressions. A
//! [`document::Document`] contains headings, text, tables and equations, also independent of the notation; [`robot`]
//! fills one from a robot. Each notation has its own printer: [`latex`], [`mathml`], [`typst`]; [`html`] makes a
//! page. HTML and MathML are trees of [`markup`], which escapes all text. The infix text beside each formula is that
//! of `robot_symbolic`, which reads back.
//!
//! [`latex::read`] and [`meaning`] go the opposite way, from LaTeX to a layout and to the expression for which it
//! stands, so that tests can prove what was printed.

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
