//! Derivation of a robot's dynamics as symbolic expressions.
//!
//! [`mechanism`] builds a symbolic robot from a checked [`robot_model::robot::Robot`]. Two recursions derive equations
//! of motion from it: [`newton_euler`] is the paper's recursion, in which every quantity is a named expression, meant
//! for readers; [`economical`] is a second form with the fewest operations, meant for code.

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
