//! The reader of robot files: the meaning of valid files, and the messages about invalid ones.

#![allow(clippy::unwrap_used, clippy::panic)]

mod bounds;
mod broken;
mod dh;
mod functions;
mod hostile;
#[path = "../hostility/mod.rs"]
mod hostility;
mod meaning;
mod pages;

use robot_model::description::{Described, read_toml};
use robot_model::diagnostic::Diagnostics;

/// A file with the given text after its head.
fn arm(text: &str) -> String {
    format!("format = 1\n\n[robot]\nname = \"arm\"\n{text}")
}

/// Reads a file that must be valid.
fn read(text: &str) -> Described {
    read_toml("arm.toml", text).unwrap_or_else(|found| panic!("{text}\n{found}"))
}

/// The errors of a file that must be invalid.
fn errors(text: &str) -> Diagnostics {
    match read_toml("arm.toml", text) {
        Ok(_) => panic!("no error in\n{}", text.chars().take(2000).collect::<String>()),
        Err(found) => found,
    }
}
