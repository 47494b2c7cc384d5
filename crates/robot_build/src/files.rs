//! Writing generated files.

use std::path::{Path, PathBuf};

use crate::error::Error;

/// A generated file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// The path, relative to the folder that the file belongs to, with `/` between its parts.
    pub path: String,
    /// The text.
    pub text: String,
}

/// How a file on disk differs from what would be generated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Staleness {
    /// There is no such file.
    Missing,
    /// The texts differ from this line on, counted from 1.
    Differs {
        /// The line.
        line: usize,
    },
}

/// Writes a file where its text differs from what is there, so that its time of change means
/// something; makes the folders above it.
///
/// # Errors
///
/// What the system says, with the path.
pub fn write_if_changed(path: &Path, text: &str) -> Result<bool, Error> {
    if std::fs::read(path).is_ok_and(|present| present == text.as_bytes()) {
        return Ok(false);
    }
    let failed = |error: std::io::Error| Error::File {
        action: "write",
        path: path.to_owned(),
        reason: error.to_string(),
    };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    std::fs::write(path, text).map_err(failed)?;
    Ok(true)
}

/// How the file on disk differs from `text`, line ends apart; `None` where it does not.
///
/// # Errors
///
/// A file that is there but cannot be read.
pub fn staleness(path: &Path, text: &str) -> Result<Option<Staleness>, Error> {
    let present = match std::fs::read(path) {
        Ok(present) => present,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Ok(Some(Staleness::Missing));
        }
        Err(error) => {
            let (path, reason) = (PathBuf::from(path), error.to_string());
            return Err(Error::File { action: "read", path, reason });
        }
    };
    let present = String::from_utf8_lossy(&present);
    let (mut old, mut new) = (present.lines(), text.lines());
    let mut line = 1;
    loop {
        match (old.next(), new.next()) {
            (None, None) => return Ok(None),
            (a, b) if a == b => line += 1,
            _ => return Ok(Some(Staleness::Differs { line })),
        }
    }
}
