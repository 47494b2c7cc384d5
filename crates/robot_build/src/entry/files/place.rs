//! What exists at the path of an output, symbolic links followed.

use std::fs::{self, Metadata};
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

/// More links in a row are a circle.
const MAX_LINKS: usize = 40;

/// What exists at a path.
pub(super) enum Place {
    /// Nothing yet; this is the path with symbolic links followed.
    Free(PathBuf),
    /// A regular file, at the path with symbolic links followed.
    Regular(PathBuf, Metadata),
    /// A device, a pipe or an open stream of the process: it is written to directly.
    Stream,
    /// A folder, at the path with symbolic links followed.
    Folder(PathBuf),
}

/// Finds what exists at the path.
pub(super) fn place(path: &Path) -> Result<Place> {
    let mut target = path.to_owned();
    for _ in 0..MAX_LINKS {
        if is_stream(&target) {
            return Ok(Place::Stream);
        }
        if let Ok(next) = fs::read_link(&target) {
            target = folder_of(&target).join(next);
            continue;
        }
        return match fs::metadata(&target) {
            Ok(metadata) if metadata.is_file() => Ok(Place::Regular(target, metadata)),
            Ok(metadata) if metadata.is_dir() => Ok(Place::Folder(target)),
            Ok(_) => Ok(Place::Stream),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Place::Free(target)),
            Err(error) => Err(error),
        };
    }
    Err(Error::other("its symbolic links form a cycle"))
}

/// Whether the path names an open stream of a process, as `/dev/stdout` does: what is behind it may be a
/// regular file that others write too, and must not be replaced.
fn is_stream(path: &Path) -> bool {
    let streams = ["/dev/stdin", "/dev/stdout", "/dev/stderr"];
    streams.iter().any(|stream| path == Path::new(stream))
        || path.parent().is_some_and(|folder| {
            folder == Path::new("/dev/fd") || folder.starts_with("/proc") && folder.ends_with("fd")
        })
}

/// Whether a file is the system's view of itself, which looks like a file but cannot be replaced.
pub(super) fn is_of_system(path: &Path) -> bool {
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    cfg!(target_os = "linux") && ["/proc", "/sys"].iter().any(|folder| path.starts_with(folder))
}

/// The folder in which a path lies.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Whether two paths name one file, be it by symbolic links, by hard links or by the place where a file
/// would come to lie.
pub(super) fn is_same(a: &Path, b: &Path) -> bool {
    is_same_node(a, b) || matches!((location(a), location(b)), (Some(a), Some(b)) if a == b)
}

#[cfg(unix)]
fn is_same_node(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (fs::metadata(a), fs::metadata(b)) {
        (Ok(a), Ok(b)) => a.is_file() && (a.dev(), a.ino()) == (b.dev(), b.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_same_node(_: &Path, _: &Path) -> bool {
    false
}

/// The canonical path of a file, existing or not; `None` for streams, two of which may have one name.
fn location(path: &Path) -> Option<PathBuf> {
    match place(path).ok()? {
        Place::Stream => None,
        Place::Free(target) => {
            Some(folder_of(&target).canonicalize().ok()?.join(target.file_name()?))
        }
        Place::Regular(target, _) | Place::Folder(target) => target.canonicalize().ok(),
    }
}
