//! What is derived against a second derivation, against what must hold between functions, and against values and
//! equations from elsewhere.
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

// The example `identification`, whose parts name each other from the root of its program.
#[path = "../../examples/identification/report.rs"]
mod report;
#[path = "../../examples/identification/study.rs"]
mod study;
#[path = "../../examples/identification/trajectory.rs"]
mod trajectory;
