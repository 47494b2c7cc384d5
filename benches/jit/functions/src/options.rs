//! The robots and options of both the compiled code and the machine code.

use std::path::PathBuf;

use robot_build::{DEFAULT_BATCH, Errors, Functions, Options, RobotFile, Trigonometry};

/// The robots that are compared.
pub const ROBOTS: [&str; 2] = ["ur5", "panda"];

/// A robot's file, and the options with its pinned plan.
///
/// # Errors
///
/// A file that does not exist, or a stale plan.
pub fn robot(name: &str) -> Result<(RobotFile, Options), Errors> {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../robots"));
    let file = RobotFile::read(&folder.join(format!("{name}.toml")))?;
    let options = Options {
        functions: Functions::All,
        trigonometry: Trigonometry::Polynomial,
        batch: Some(DEFAULT_BATCH),
        ..Options::default()
    };
    let options = file.with_pin(&options)?;
    Ok((file, options))
}
