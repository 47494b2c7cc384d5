//! Any names and texts of a robot, in every language: all names that a robot can have are printed, and no text
//! becomes code. The input is eight names and three texts, separated by the control character 1F. A plain name
//! replaces a missing name and a name that no robot file can have.
#![no_main]

#[path = "../../crates/robot_build/tests/languages/harmless.rs"]
mod harmless;

use harmless::{Chosen, PLAIN};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let mut parts = text.split('\u{1f}').map(str::to_owned);
    let names: [String; 8] = std::array::from_fn(|at| parts.next().unwrap_or(PLAIN[at].to_owned()));
    let texts = std::array::from_fn(|_| parts.next().unwrap_or_default());
    assert!(harmless::in_every_language(&Chosen { names, texts }.accepted()));
});
