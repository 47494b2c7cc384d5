//! The model of a robot, and its readers.
//!
//! [`description`] reads a robot file into a checked [`robot::Robot`], whose values are formulas with [`mod@unit`]s;
//! each error is a [`diagnostic`] with a place, a reason and a remedy. [`functions`] lists the functions that can be
//! derived from a robot, but does not derive them. [`signs`] defines the symbols of printed formulas.

pub mod description;
pub mod diagnostic;
pub mod functions;
pub mod physics;
pub mod robot;
pub mod signs;
pub mod snap;
mod space;
pub mod unit;
pub mod variable;
