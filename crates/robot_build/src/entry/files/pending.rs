//! A file that is written piece by piece.

use std::fs::{self, File, Metadata};
use std::io::{BufRead, BufReader, Result, Write};
use std::path::{Path, PathBuf};

use super::staging::{Staged, remove_leftovers};
use super::writer::{Folders, Ownership, Writer, cannot_write};
use crate::error::Errors;

/// A file that is being written, from [`Writer::begin`]. It is next to its final path until it is [put](Pending::put)
/// there, and is removed if it never is. Output to a stream is written immediately.
#[must_use]
pub struct Pending {
    pub(super) writer: Writer,
    pub(super) path: PathBuf,
    pub(super) ownership: Ownership,
    pub(super) place: Place,
    pub(super) folders: Folders,
    pub(super) length: u64,
}

/// The destination of the bytes.
pub(super) enum Place {
    Stream(File),
    /// A new file, and the existing file that it replaces.
    Staged(Staged, Option<Box<(PathBuf, Metadata)>>),
}

impl Pending {
    /// Appends bytes.
    ///
    /// # Errors
    ///
    /// An error of the system, with the path.
    pub fn write(&mut self, bytes: &[u8]) -> std::result::Result<(), Errors> {
        let written = match &mut self.place {
            Place::Stream(stream) => stream.write_all(bytes),
            Place::Staged(staged, _) => staged.write_all(bytes),
        };
        self.length += bytes.len() as u64;
        Ok(written.map_err(|error| cannot_write(&self.path, &error))?)
    }

    /// Moves the complete file to its final path; returns its length, or `None` if the existing file already has these
    /// bytes.
    ///
    /// # Errors
    ///
    /// An existing file that must not be replaced and differs; an error of the system, with the path.
    pub fn put(mut self) -> std::result::Result<Option<u64>, Errors> {
        let path = &self.path;
        if let Place::Staged(staged, present) = self.place {
            if let Some((target, _)) = present.as_deref() {
                if is_equal(staged.path(), target) {
                    drop(staged);
                    remove_leftovers(target);
                    return Ok(None);
                }
                self.writer.check_owner(path, target, self.ownership)?;
            }
            let put = staged.complete(present.as_deref().map(|(_, metadata)| metadata));
            put.map_err(|error| cannot_write(path, &error))?;
            self.folders.keep();
            staged.put().map_err(|error| cannot_write(path, &error))?;
        }
        Ok(Some(self.length))
    }
}

/// Whether two files have the same bytes; false if one cannot be read.
fn is_equal(a: &Path, b: &Path) -> bool {
    let compare = || -> Result<bool> {
        if fs::metadata(a)?.len() != fs::metadata(b)?.len() {
            return Ok(false);
        }
        let [mut a, mut b] = [BufReader::new(File::open(a)?), BufReader::new(File::open(b)?)];
        loop {
            let (left, right) = (a.fill_buf()?, b.fill_buf()?);
            let length = left.len().min(right.len());
            if length == 0 {
                return Ok(left.len() == right.len());
            }
            if left[..length] != right[..length] {
                return Ok(false);
            }
            a.consume(length);
            b.consume(length);
        }
    };
    compare().unwrap_or(false)
}
