//! Checks of robots and equations.
//!
//! [`doctor`] finds likely mistakes in robot files; [`errata`] compares published equations with derived ones;
//! [`difference`] compares two robots; [`accuracy`] compares programs with the numeric solver; [`check_value`] computes
//! joint torques in a state, with which readers can check equations that they have copied.

pub mod accuracy;
mod check_value;
pub mod difference;
pub mod doctor;
pub mod errata;
#[cfg(test)]
mod tests;

pub use check_value::check_value;
