//! Symbolic algebra for robot mechanics.
//!
//! A [`Graph`] interns expressions: every [`Expr`] is a small handle that can be copied, and equal expressions share
//! one node. The operators `+ - * /` simplify only by local rules (see [`rules`]). Constants are exact rational numbers
//! ([`Number`]), and sines and cosines of multiples of π/2 are exact.
//!
//! ```
//! use robot_symbolic::Graph;
//! let graph = Graph::new();
//! let (q1, q2) = (graph.symbol("q1"), graph.symbol("q2"));
//! assert_eq!((q1 + q2) - q2, q1);
//! assert_eq!((q1 + graph.pi() / 2).sin(), q1.cos());
//! ```
//!
//! The main parts besides the graph:
//!
//! - [`Formula`] is the text of an expression, as in robot files. It belongs to no graph and is checked when it is
//!   read; [`Graph::parse`] makes an expression directly from text.
//! - [`walk`] evaluates, substitutes and differentiates expressions.
//! - [`Polynomial`] is the canonical form: it decides equality, expands expressions and collects terms by symbols.
//! - [`mod@print`] writes expressions and polynomials as text that can be parsed again.
//!
//! ```
//! use robot_symbolic::{Graph, Polynomial, PolynomialOptions, polynomial, print};
//!
//! let graph = Graph::new();
//! let torque = graph.parse("m*l*(l*qdd1 + g*sin(q1))").unwrap();
//! assert_eq!(print::to_text(torque).unwrap(), "m*l*(l*qdd1 + g*sin(q1))");
//!
//! let expanded = Polynomial::of(torque, &PolynomialOptions::default())?;
//! assert_eq!(expanded.to_text().unwrap(), "m*l^2*qdd1 + m*l*g*sin(q1)");
//! let mass = &expanded.collect(&["qdd1"])[0].1;
//! assert_eq!(mass.to_text().unwrap(), "m*l^2");
//!
//! let other = graph.parse("l*m*g*sin(q1) + qdd1*m*l^2*(sin(q1)^2 + cos(q1)^2)").unwrap();
//! assert!(polynomial::equal(torque, other)?);
//! # Ok::<(), robot_symbolic::PolynomialError>(())
//! ```

pub mod collected;
pub mod differentiate;
mod expr;
pub mod formula;
mod graph;
pub mod named;
mod number;
mod operations;
mod operators;
pub mod polynomial;
pub mod print;
mod random;
#[cfg(test)]
mod random_expressions;
mod rational;
pub mod rules;
mod spelling;
mod trigonometry;
pub mod walk;

pub use expr::{Expr, View};
pub use formula::{Formula, ParseError};
pub use graph::{Function, Graph, Id, SymbolId};
pub use number::{Number, Real, is_below_range};
pub use operations::{Counter, Operations, operations};
pub use polynomial::{AngleSums, Monomial, Polynomial, PolynomialError, PolynomialOptions};
pub use random::Random;
pub use rational::{MAX_DIGITS, Rational};
pub use spelling::nearest_word;
