//! The temporary folders in which the compiler works.

use core::time::Duration;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use robot_build::File;
use tempfile::TempDir;

/// The folders that exist.
static FOLDERS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A temporary folder, which is removed when the value is dropped.
pub(crate) struct Folder(TempDir);

impl Folder {
    /// A folder with these files.
    pub(crate) fn new(files: &[File]) -> io::Result<Folder> {
        let mut folders = folders();
        let folder = TempDir::new()?;
        // The folder is not removed while its files are written: writing one creates its folder again.
        write(files, folder.path())?;
        folders.push(folder.path().to_owned());
        Ok(Folder(folder))
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let mut folders = folders();
        // A folder is on the list as long as it exists.
        let _ = std::fs::remove_dir_all(self.path());
        folders.retain(|path| path != self.0.path());
    }
}

fn write(files: &[File], folder: &Path) -> io::Result<()> {
    for file in files {
        let path = folder.join(&file.path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::write(path, file.contents.bytes())?;
    }
    Ok(())
}

/// The number of attempts to remove a folder, and the time between them.
const TRIES: usize = 100;
const PAUSE: Duration = Duration::from_millis(20);

/// Removes the temporary folders of all compilers that this process has started; from now on, [`prove`](crate::prove) does not
/// return. For programs that end at a signal, where no value is dropped.
pub fn remove_temporary_folders() {
    let mut folders = folders();
    for path in folders.drain(..) {
        // The compiler can write into it until it ends.
        for _ in 0..TRIES {
            if std::fs::remove_dir_all(&path).is_ok() || !path.exists() {
                break;
            }
            std::thread::sleep(PAUSE);
        }
    }
    // No folder is created between now and the end of the process.
    core::mem::forget(folders);
}

fn folders() -> MutexGuard<'static, Vec<PathBuf>> {
    FOLDERS.lock().unwrap_or_else(PoisonError::into_inner)
}
