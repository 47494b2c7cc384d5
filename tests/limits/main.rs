//! What files can ask for at most, what code costs, and what is pinned.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod operation_counts;
mod options;
mod pins;
mod records;
mod security;
