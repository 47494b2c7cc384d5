//! Derivation of a robot's dynamics as symbolic expressions.
//!
//! [`mechanism`] puts a checked [`robot_model::robot::Robot`] into symbols; the recursions turn it into
//! equations of motion, every quantity a named expression: [`newton_euler`] is the paper's, for people, and
//! [`economical`] a second form of it that needs the fewest operations, for code.

pub mod base_parameters;
mod body;
mod derivation;
pub mod economical;
pub mod functions;
pub mod limbs;
pub mod matrix;
pub mod mechanism;
pub mod newton_euler;
mod plain;
pub mod quantity;
pub mod vector;
