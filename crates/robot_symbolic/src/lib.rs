//! Symbolic algebra for robot mechanics.
//!
//! A [`Graph`] interns expressions: every [`Expr`] is a small copyable handle, equal expressions are
//! one node, and the operators `+ - * /` build new ones through local rules only (see [`rules`]).
//! Constants are exact rationals ([`Number`]); sines and cosines at multiples of π/2 are exact.
//!
//! ```
//! use robot_symbolic::Graph;
//! let graph = Graph::new();
//! let (q1, q2) = (graph.symbol("q1"), graph.symbol("q2"));
//! assert_eq!((q1 + q2) - q2, q1);
//! assert_eq!((q1 + graph.pi() / 2).sin(), q1.cos());
//! ```

mod expr;
pub mod formula;
mod graph;
mod number;
mod operations;
mod operators;
pub mod polynomial;
pub mod print;
#[cfg(test)]
mod random;
mod rational;
pub mod rules;
mod trigonometry;
pub mod walk;

pub use expr::{Expr, View};
pub use formula::{Formula, ParseError};
pub use graph::{Function, Graph, Id, SymbolId};
pub use number::Number;
pub use operations::{Operations, operations};
pub use polynomial::{AngleSums, Monomial, Polynomial, PolynomialError, PolynomialOptions};
pub use rational::Rational;
