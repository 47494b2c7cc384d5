//! Torques, residuals and identification over logs of robots.
//!
//! A log is a table: rows are states at times, columns are q, q̇, q̈ and τ. [`functions`] computes the dynamics over
//! its columns; [`identify`] folds them into parameters.

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
