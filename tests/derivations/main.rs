//! Compares what is derived with a second derivation, with identities between the functions, and with values and
//! equations from other sources.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod collected;
mod conformance;
mod drives;
mod identification;
mod identities;
mod lagrange;
mod pinocchio;
mod power;
mod textbook;

// The example `identification`, whose modules refer to each other from the root of its program.
#[path = "../../examples/identification/report.rs"]
mod report;
#[path = "../../examples/identification/study.rs"]
mod study;
#[path = "../../examples/identification/trajectory.rs"]
mod trajectory;
