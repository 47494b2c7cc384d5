//! Checks of robots and equations.
//!
//! [`doctor`] looks for likely mistakes in robot files, [`errata`] compares published equations with the
//! derived ones, [`difference`] compares two robots, [`accuracy`] compares programs with the numeric
//! solver, and [`check_value`] is a state for readers who copy the equations.

pub mod accuracy;
mod check_value;
pub mod difference;
pub mod doctor;
pub mod errata;
#[cfg(test)]
mod tests;

pub use check_value::check_value;
