//! Compares what is derived and generated with the numeric solver, which shares no code with the derivations: every
//! function and option, for the robot files and for random robots.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod base_parameters;
mod functions;
mod generated;
mod light;
mod options;
mod parallel;
mod recursions;
mod regressor;
mod snapping;
mod symmetric;
mod trees;
