//! Derivation of a robot's dynamics as symbolic expressions.
//!
//! [`mechanism`] makes a symbolic robot from a checked [`robot_model::robot::Robot`]; the recursions turn it into
//! equations of motion, in which every quantity is a named expression: [`newton_euler`] is the paper's recursion, for
//! people, and [`economical`] a second form that needs the fewest operations, for code.

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
