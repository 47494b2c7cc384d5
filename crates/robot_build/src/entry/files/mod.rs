//! Writing of output files.
//!
//! The builder and the command write only through [`Writer`]. It never replaces an input, replaces files that this
//! program did not write only if forced to, and replaces a file completely or not at all.

mod marker;
mod pending;
mod place;
mod remaining;
mod seal;
mod staging;
mod writer;

use std::path::Path;

pub use marker::MARKER;
pub(crate) use marker::is_marked;
pub use pending::Pending;
pub use place::is_stream;
pub use remaining::remaining;
pub use seal::sealed;
pub use writer::{Output, Ownership, Writer};

use crate::entry::system::system_reason;
use crate::error::Error;

/// The difference between a file on disk and the content that would be generated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Staleness {
    /// The file does not exist.
    Missing,
    /// The texts differ from this line on, counted from 1.
    Differs {
        /// The line.
        line: usize,
    },
    /// The contents are not text and differ.
    Bytes,
}

/// Compares the file on disk with what it should contain, except for line ends of text; `None` if they are equal.
///
/// # Errors
///
/// A file that exists but cannot be read, or is not a regular file; such files are never read.
pub fn staleness(path: &Path, wanted: &[u8]) -> Result<Option<Staleness>, Error> {
    let failed = |reason: String| Error::File { action: "read", path: path.to_owned(), reason };
    match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_file() => {}
        Ok(_) => return Err(failed("it is not a regular file".to_owned())),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Ok(Some(Staleness::Missing));
        }
        Err(error) => return Err(failed(system_reason(&error))),
    }
    let present = std::fs::read(path).map_err(|error| failed(system_reason(&error)))?;
    let Ok(text) = std::str::from_utf8(wanted) else {
        return Ok((present != wanted).then_some(Staleness::Bytes));
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

#[cfg(test)]
mod tests;
