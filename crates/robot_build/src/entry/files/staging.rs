//! Temporary files and folders that are written next to their target and then moved there in one step.
//!
//! A temporary file is hidden, its name contains that of its target, and it is locked while it is written. So leftovers
//! of a killed process can be distinguished from files that another process is writing, and the next write of the
//! target removes them.

use std::ffi::OsStr;
use std::fs::{self, Metadata, OpenOptions, TryLockError};
use std::io::{ErrorKind, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use super::place::folder_of;

/// The part of a temporary file's name that follows the name of its target.
const INFIX: &str = ".robot-symbolic-tmp-";
/// The largest number of bytes of a target's name in the name of its temporary file; systems allow 255 bytes for the
/// whole name.
const MAX_NAME: usize = 180;
/// The largest number of temporary names that are tried.
const MAX_TRIES: u32 = 1000;

/// The number in the next temporary name, which is different for all files of a process.
static NUMBER: AtomicU32 = AtomicU32::new(0);

/// A temporary file or folder next to its target; removed unless it is moved to the target.
pub(super) struct Staged {
    temporary: PathBuf,
    target: PathBuf,
    /// The open temporary file, whose lock shows other processes that it is in use. `None` for a folder if the system
    /// cannot lock folders.
    lock: Option<fs::File>,
    is_placed: bool,
}

impl Staged {
    /// Writes a temporary file for `target`, with the permissions of the existing file.
    pub(super) fn file(target: &Path, bytes: &[u8], present: Option<&Metadata>) -> Result<Staged> {
        // From here on, an error removes the file.
        let mut staged = Staged::empty(target)?;
        staged.write_all(bytes)?;
        staged.complete(present)?;
        Ok(staged)
    }

    /// Creates an empty temporary file for `target`, to be written and then completed.
    pub(super) fn empty(target: &Path) -> Result<Staged> {
        Staged::beside(target, |path| {
            OpenOptions::new().write(true).create_new(true).open(path).map(Some)
        })
    }

    /// Sets the permissions of a complete file to those of the existing file, and flushes it to the disk.
    pub(super) fn complete(&self, present: Option<&Metadata>) -> Result<()> {
        if let Some(present) = present {
            self.keep_access(present)?;
        }
        self.lock.as_ref().map_or(Ok(()), fs::File::sync_all)
    }

    /// Creates an empty temporary folder for `target`, which must not exist.
    pub(super) fn folder(target: &Path) -> Result<Staged> {
        Staged::beside(target, |path| fs::create_dir(path).map(|()| fs::File::open(path).ok()))
    }

    /// Creates a new, locked file or folder next to the target.
    fn beside(target: &Path, create: impl Fn(&Path) -> Result<Option<fs::File>>) -> Result<Staged> {
        remove_leftovers(target);
        let prefix = prefix(target);
        for _ in 0..MAX_TRIES {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let name = format!("{prefix}{}-{number}", std::process::id());
            let temporary = folder_of(target).join(name);
            let lock = match create(&temporary) {
                Ok(lock) => lock,
                Err(error) if error.kind() == ErrorKind::AlreadyExists => continue,
                Err(error) => return Err(error),
            };
            let locked = lock.as_ref().map(fs::File::try_lock);
            // Before it was locked, another process could have removed it as a leftover.
            let is_taken = matches!(locked, Some(Err(TryLockError::WouldBlock)));
            if !is_taken && fs::symlink_metadata(&temporary).is_ok() {
                return Ok(Staged { temporary, target: target.to_owned(), lock, is_placed: false });
            }
        }
        let reason = "no temporary file could be created beside it; remove the hidden files";
        Err(std::io::Error::other(format!("{reason} `{prefix}…` there")))
    }

    /// Sets the permissions and, if permitted, the owner to those of the existing file.
    fn keep_access(&self, present: &Metadata) -> Result<()> {
        keep_owner(&self.temporary, present);
        if fs::metadata(&self.temporary)?.permissions() == present.permissions() {
            return Ok(());
        }
        fs::set_permissions(&self.temporary, present.permissions())
    }

    /// The temporary path.
    pub(super) fn path(&self) -> &Path {
        &self.temporary
    }

    /// Moves it to the target.
    pub(super) fn put(mut self) -> Result<()> {
        fs::rename(&self.temporary, &self.target)?;
        self.is_placed = true;
        Ok(())
    }
}

/// Writes to the file.
impl Write for Staged {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        match &mut self.lock {
            Some(file) => file.write(bytes),
            None => Err(ErrorKind::IsADirectory.into()),
        }
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        if !self.is_placed {
            remove(&self.temporary);
        }
    }
}

/// Sets the owner of a new file to that of the file that it replaces, if permitted; it belongs to the current user
/// otherwise.
#[cfg(unix)]
fn keep_owner(path: &Path, present: &Metadata) {
    use std::os::unix::fs::{MetadataExt, chown};
    if fs::metadata(path).is_ok_and(|new| (new.uid(), new.gid()) != (present.uid(), present.gid()))
    {
        // Only the superuser is permitted to do this.
        let _ = chown(path, Some(present.uid()), Some(present.gid()));
    }
}

#[cfg(not(unix))]
fn keep_owner(_: &Path, _: &Metadata) {}

/// The common prefix of the temporary names of a target.
fn prefix(target: &Path) -> String {
    let name = target.file_name().unwrap_or(OsStr::new("")).to_string_lossy();
    let end = (0..=MAX_NAME.min(name.len())).rev().find(|end| name.is_char_boundary(*end));
    format!(".{}{INFIX}", &name[..end.unwrap_or(0)])
}

/// Removes temporary files of processes that were killed while they wrote the target.
pub(super) fn remove_leftovers(target: &Path) {
    let prefix = prefix(target);
    let Ok(entries) = fs::read_dir(folder_of(target)) else { return };
    for entry in entries.filter_map(Result::ok) {
        let name = entry.file_name();
        let rest = name.to_str().and_then(|name| name.strip_prefix(&prefix));
        let numbers = rest.and_then(|rest| rest.split_once('-'));
        let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        if numbers.is_some_and(|(process, number)| is_number(process) && is_number(number)) {
            let path = entry.path();
            let is_ours = entry.file_type().is_ok_and(|kind| kind.is_file() || kind.is_dir());
            // If it is locked, another process is writing it; without locks this is unknown, and it stays.
            let lock = is_ours.then(|| fs::File::open(&path).ok()).flatten();
            if let Some(file) = lock
                && file.try_lock().is_ok()
            {
                remove(&path);
            }
        }
    }
}

/// Removes a temporary file or folder; failures are ignored.
fn remove(path: &Path) {
    let _ = fs::remove_file(path).or_else(|_| fs::remove_dir_all(path));
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;

    #[test]
    fn a_temporary_file_that_another_process_took_or_removed_is_passed_over() {
        let name = format!("robot_build-staging-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let others = RefCell::new(vec![]);
        let staged = Staged::beside(&folder.join("a.rs"), |path| {
            let file = fs::File::create_new(path)?;
            let other = fs::File::open(path)?;
            match others.borrow().len() {
                0 => other.try_lock()?,
                1 => fs::remove_file(path)?,
                _ => {}
            }
            others.borrow_mut().push(other);
            Ok(Some(file))
        });
        assert!(staged.unwrap().path().exists());
        assert_eq!(others.borrow().len(), 3);
        let _ = fs::remove_dir_all(&folder);
    }
}
