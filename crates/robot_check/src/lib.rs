//! What judges robots and equations.
//!
//! [`doctor`] looks for likely slips in robot files, [`errata`] compares published equations with the
//! derived ones, [`difference`] tells in what two robots differ.

pub mod difference;
pub mod doctor;
pub mod errata;
