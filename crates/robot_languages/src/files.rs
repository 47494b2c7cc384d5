//! Helpers that write files and run programs.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The root of the repository.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Writes a file in a folder, and creates the folders that it needs.
///
/// # Errors
///
/// An error of the system.
pub fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), String> {
    let path = folder.join(name);
    let parent = path.parent().unwrap_or(folder);
    let said = |error: std::io::Error| format!("{}: {error}", path.display());
    std::fs::create_dir_all(parent).map_err(said)?;
    std::fs::write(&path, bytes).map_err(said)
}

/// Runs a program in a folder; returns its output if it succeeds.
///
/// # Errors
///
/// The messages of the program, if it fails.
pub fn run(folder: &Path, program: &str, arguments: &[&str]) -> Result<String, String> {
    let ran = Command::new(program).args(arguments).current_dir(folder).output();
    let ran = ran.map_err(|error| format!("{program}: {error}"))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if ran.status.success() {
        Ok(text(&ran.stdout))
    } else {
        let said: String = (text(&ran.stderr) + &text(&ran.stdout)).chars().take(4000).collect();
        Err(format!("{program} {}: {}\n{said}", arguments.join(" "), ran.status))
    }
}

/// Whether a program can be run; with these arguments it should only print information about itself.
#[must_use]
pub fn is_there(program: &str, arguments: &[&str]) -> bool {
    Command::new(program).args(arguments).output().is_ok_and(|ran| ran.status.success())
}
