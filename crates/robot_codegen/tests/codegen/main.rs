//! Tests of the whole crate: from expressions to programs, numbers and compiled code.

// Helpers of tests may panic, as tests do.
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
