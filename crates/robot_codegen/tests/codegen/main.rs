//! Tests of the whole: from expressions to programs, numbers and compiled code.

// Helpers of tests fail as tests do.
#![allow(clippy::unwrap_used, clippy::panic)]

mod callable;
mod compiled;
mod coverage;
mod errors;
mod golden;
#[cfg(all(
    feature = "c",
    feature = "javascript",
    feature = "matlab",
    feature = "python",
    feature = "wgsl"
))]
mod languages;
mod reserved;
#[path = "../support/mod.rs"]
mod support;
#[cfg(feature = "wasm")]
mod wasm;
