//! Robots and their mechanics.
//!
//! A robot file is read by [`description`] into a checked [`model::Robot`]; [`mechanism`] puts it
//! into symbols; the recursions turn it into equations of motion, every quantity a named expression.

pub mod base_parameters;
mod body;
pub mod description;
pub mod diagnostic;
pub mod doctor;
pub mod economical;
pub mod errata;
pub mod functions;
pub mod matrix;
pub mod mechanism;
pub mod model;
pub mod newton_euler;
pub mod numeric;
pub mod quantity;
pub mod random;
pub mod unit;
pub mod vector;
