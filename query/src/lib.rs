//! Torques, residuals and identification over logs of robots.
//!
//! A log is a table with a row for each time and columns for q, q̇, q̈ and τ. [`functions`] computes the dynamics
//! over its columns; [`identify`] identifies parameters from them.

pub mod cluster;
mod columns;
pub mod convert;
pub mod derivative;
mod error;
pub mod functions;
pub mod identify;
pub mod log;
pub mod motion;
pub mod residual;
mod robots;

pub use error::Error;
pub use robots::{Compiled, Model, Robots};
