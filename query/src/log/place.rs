//! Files that are whole or not there.

use std::fs::File;
use std::path::{Path, PathBuf};

use crate::error::Error;

/// A file that is written beside its place, and moved there when it is whole.
#[derive(Debug)]
pub(crate) struct Place {
    path: PathBuf,
    beside: PathBuf,
}

/// A new folder, or one that has nothing in it.
///
/// # Errors
///
/// A folder with files; one that cannot be made.
pub(crate) fn empty_folder(folder: &Path) -> Result<(), Error> {
    let failed = |error: std::io::Error| Error::file(folder, error);
    std::fs::create_dir_all(folder).map_err(failed)?;
    match std::fs::read_dir(folder).map_err(failed)?.next() {
        None => Ok(()),
        Some(_) => Err(Error::file(folder, "the folder is not empty; remove it or choose another")),
    }
}

impl Place {
    /// A new file.
    ///
    /// # Errors
    ///
    /// A place where something is; a file that cannot be made.
    pub(crate) fn create(path: &Path) -> Result<(Place, File), Error> {
        if std::fs::symlink_metadata(path).is_ok() {
            return Err(Error::file(path, "it exists; remove it or choose another name"));
        }
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(".incomplete");
        let beside = path.with_file_name(name);
        let file = File::create(&beside).map_err(|error| Error::file(&beside, error))?;
        Ok((Place { path: path.to_owned(), beside }, file))
    }

    /// The path at which the file will be.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Moves the file to its place.
    ///
    /// # Errors
    ///
    /// A file that cannot be moved.
    pub(crate) fn keep(self) -> Result<(), Error> {
        std::fs::rename(&self.beside, &self.path).map_err(|error| Error::file(&self.path, error))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // A file that was kept is no longer here.
        let _ = std::fs::remove_file(&self.beside);
    }
}
