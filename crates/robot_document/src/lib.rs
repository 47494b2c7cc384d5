//! Equations of robots as documents.
//!
//! [`forms`] puts the equations of motion in the form that is asked for; each side of an equation is a
//! [`math::Math`], a layout of pieces that no notation owns. A [`document::Document`] holds headings,
//! text, tables and equations, still in no notation; [`robot`] fills one from a robot. Each notation
//! is a printer of its own: [`latex`], [`mathml`], [`typst`]; [`html`] makes a page. [`meaning`] goes the way back, from a formula to the expression
//! that it stands for, so that tests can prove what was printed.

pub mod base;
pub mod breaking;
pub mod document;
mod error;
pub mod forms;
pub mod html;
pub mod latex;
pub mod math;
pub mod mathml;
pub mod meaning;
mod notation;
mod order;
pub mod robot;
mod signs;
pub mod typst;
pub mod width;
pub mod words;

pub use error::{Centimetres, Error};
pub use forms::{Equation, EquationOptions, Equations, Form, Group, equations};
pub use notation::Notation;
pub use order::{Order, Rank};
