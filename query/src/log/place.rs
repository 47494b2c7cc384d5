//! Files and folders that are written completely or not at all.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::error::Error;

/// A file that is written under another name beside its path, and renamed when it is complete.
#[derive(Debug)]
pub(crate) struct Place {
    path: PathBuf,
    beside: PathBuf,
}

/// Makes a new folder, or accepts an empty one.
///
/// # Errors
///
/// A folder with files in it; a file of that name; a folder that cannot be made.
pub(crate) fn empty_folder(folder: &Path) -> Result<(), Error> {
    let failed = |error: std::io::Error| Error::file(folder, error);
    if folder.exists() && !folder.is_dir() {
        return Err(Error::file(folder, "it is not a folder; choose another name"));
    }
    std::fs::create_dir_all(folder).map_err(failed)?;
    match std::fs::read_dir(folder).map_err(failed)?.next() {
        None => Ok(()),
        Some(_) => Err(Error::file(folder, "the folder is not empty; remove it or choose another")),
    }
}

/// Refuses a path that is taken, before a long computation whose result would be written there.
///
/// # Errors
///
/// A path at which something exists.
pub fn check_vacant(path: &Path) -> Result<(), Error> {
    match std::fs::symlink_metadata(path) {
        Err(_) => Ok(()),
        Ok(found) if found.is_file() || found.is_dir() => {
            Err(Error::file(path, "it exists; remove it or choose another name"))
        }
        Ok(_) => Err(Error::file(path, "it is not a regular file; choose another name")),
    }
}

/// Writes a new file, completely or not at all.
///
/// # Errors
///
/// A path that is taken; a file that cannot be written.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let (place, mut file) = Place::create(path)?;
    file.write_all(bytes).map_err(|error| Error::file(path, error))?;
    place.keep()
}

impl Place {
    /// Creates the file under its temporary name.
    ///
    /// # Errors
    ///
    /// A path that is taken; a folder that does not exist; a file that cannot be created.
    pub(crate) fn create(path: &Path) -> Result<(Place, File), Error> {
        check_vacant(path)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.exists()) {
            return Err(Error::file(folder, "there is no such folder; make it first"));
        }
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(".incomplete");
        let beside = path.with_file_name(name);
        let file = File::create(&beside).map_err(|error| Error::file(path, error))?;
        Ok((Place { path: path.to_owned(), beside }, file))
    }

    /// The final path of the file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Renames the file to its final path.
    ///
    /// # Errors
    ///
    /// A file that cannot be renamed.
    pub(crate) fn keep(self) -> Result<(), Error> {
        std::fs::rename(&self.beside, &self.path).map_err(|error| Error::file(&self.path, error))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // A file that was kept no longer exists under this name.
        let _ = std::fs::remove_file(&self.beside);
    }
}
