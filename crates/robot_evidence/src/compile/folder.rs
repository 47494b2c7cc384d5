//! The temporary folders in which the compiler works.

use core::time::Duration;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempDir;

/// The folders that exist.
static FOLDERS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A temporary folder, which is removed when the value is dropped.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> io::Result<Folder> {
        let mut folders = folders();
        let folder = Folder(tempfile::tempdir()?);
        folders.push(folder.path().to_owned());
        Ok(folder)
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        folders().retain(|path| path != self.0.path());
    }
}

/// The number of attempts to remove a folder, and the time between them.
const TRIES: usize = 100;
const PAUSE: Duration = Duration::from_millis(20);

/// Removes the temporary folders of all compilers that run in this process. For programs that end at a signal, where no
/// value is dropped.
pub fn remove_temporary_folders() {
    for path in folders().drain(..) {
        // The compiler can write into it until it ends.
        for _ in 0..TRIES {
            if std::fs::remove_dir_all(&path).is_ok() || !path.exists() {
                break;
            }
            std::thread::sleep(PAUSE);
        }
    }
}

fn folders() -> MutexGuard<'static, Vec<PathBuf>> {
    FOLDERS.lock().unwrap_or_else(PoisonError::into_inner)
}
