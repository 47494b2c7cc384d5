//! The robots of `robots/` as plain Rust: one module for each robot, generated from its file when this crate is built.
//!
//! A module has the robot's `Parameters` with their nominal values, a `Model` that contains the values that depend only
//! on them, and its functions: inverse dynamics, the same with a wrench at the tip and with friction, and the forces
//! and moments in the joints. Functions take and return arrays; they allocate nothing, cannot panic and have no
//! branches.
//!
//! ```
//! use robots::trttr1::{Model, Parameters};
//!
//! let model = Model::new(&Parameters { M5: 2.5, ..Parameters::NOMINAL });
//! let (q, qd, qdd) = ([0.1, 0.5, 0.2, 0.1, -0.3], [0.0; 5], [0.0; 5]);
//! let tau = model.inverse_dynamics(&q, &qd, &qdd);
//! // At rest, no force acts on the carriage along its axis; the lift carries the links above it.
//! let Parameters { M3, M4, g, .. } = Parameters::NOMINAL;
//! assert!(tau[0].abs() < 1e-12);
//! assert!((tau[2] - (M3 + M4 + 2.5) * g).abs() < 1e-9);
//! ```

#![no_std]

include!(concat!(env!("OUT_DIR"), "/robots.rs"));

/// The Rust of a page of the book.
#[cfg(doctest)]
#[doc = include_str!("../docs/users/teaching.md")]
pub struct Teaching;
