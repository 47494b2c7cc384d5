//! Equations of robots as documents.
//!
//! [`forms`] writes the equations of motion in the requested form. Each side of an equation is a [`math::Math`], a
//! layout that does not depend on the notation; a [`SymbolTable`] makes it from an expression. A [`document::Document`]
//! contains headings, text, tables and equations, also without a notation; [`robot`] makes the document of a robot.
//! Each notation has its own printer: [`latex`], [`mathml`] and [`typst`]; [`html`] makes a page. HTML and MathML are
//! trees of [`markup`], which escapes all text. The infix text beside each formula is written by `robot_symbolic` and
//! can be parsed again, by `Formula::parse_with_dots` if it contains components such as `M_l1.z`.
//!
//! [`latex::read`] and [`meaning`] work in the opposite direction: from LaTeX to a layout, and from a layout to the
//! expression that it stands for, so that tests can prove printed equations.

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
    Differences, Equation, EquationOptions, Equations, Form, Group, InvalidLetters, Letters,
    TermOrder, equations,
};
pub use layout::{DIGITS, Order, Rank, SymbolTable, Trigonometry};
pub use layout::{breaking, math, meaning, width};
pub use notation::{html, latex, markdown, math_font, mathml, typst};
