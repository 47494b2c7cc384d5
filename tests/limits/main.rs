//! The limits on input files, the operations of generated code, and pinned plans.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod operation_counts;
mod options;
mod pins;
mod records;
mod security;
