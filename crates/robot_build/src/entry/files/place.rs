//! The kind of file at the path of an output, after following symbolic links.

use std::fs::{self, Metadata};
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

/// The largest number of symbolic links that are followed; more are regarded as a cycle.
const MAX_LINKS: usize = 40;

/// The kind of file at a path.
pub(super) enum Place {
    /// Nothing exists yet; this is the path after following symbolic links.
    Free(PathBuf),
    /// A regular file, with its path after following symbolic links.
    Regular(PathBuf, Metadata),
    /// A device, a pipe or an open stream of the process, which is written to directly.
    Stream,
    /// A folder, with its path after following symbolic links.
    Folder(PathBuf),
}

/// Finds the kind of file at a path.
pub(super) fn place(path: &Path) -> Result<Place> {
    let mut target = path.to_owned();
    for _ in 0..MAX_LINKS {
        if is_stream(&target) {
            return match is_for_reading(&target) {
                true => Err(Error::other("it is a stream that is open for reading only")),
                false => Ok(Place::Stream),
            };
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

/// Whether the path names an open stream of a process, such as `/dev/stdout`. The stream can be redirected to a
/// regular file to which other programs also write, and which must not be replaced.
#[must_use]
pub fn is_stream(path: &Path) -> bool {
    let streams = ["/dev/stdin", "/dev/stdout", "/dev/stderr"];
    streams.iter().any(|stream| path == Path::new(stream))
        || path.parent().is_some_and(|folder| {
            folder == Path::new("/dev/fd") || folder.starts_with("/proc") && folder.ends_with("fd")
        })
}

/// Whether the path names an open stream from which the process only reads, as from standard input. Linux opens such a
/// path for writing nevertheless: the end of a pipe from which nothing else reads, or a file that belongs to others.
fn is_for_reading(path: &Path) -> bool {
    let own = || PathBuf::from("/proc/self");
    let (process, stream) = match (path.to_str(), path.parent(), path.file_name()) {
        (Some("/dev/stdin"), ..) => (own(), "0".as_ref()),
        (Some("/dev/stdout"), ..) => (own(), "1".as_ref()),
        (Some("/dev/stderr"), ..) => (own(), "2".as_ref()),
        (_, Some(folder), Some(name)) if folder == Path::new("/dev/fd") => (own(), name),
        (_, Some(folder), Some(name)) => (folder_of(folder).to_owned(), name),
        _ => return false,
    };
    let info = fs::read_to_string(process.join("fdinfo").join(stream)).unwrap_or_default();
    let flags = info.lines().find_map(|line| line.strip_prefix("flags:"));
    let flags = flags.and_then(|flags| u32::from_str_radix(flags.trim(), 8).ok());
    flags.is_some_and(|flags| flags & 3 == 0)
}

/// Whether a path is in `/proc` or `/sys` of Linux, whose files look ordinary but cannot be replaced.
pub(super) fn is_of_system(path: &Path) -> bool {
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    cfg!(target_os = "linux") && ["/proc", "/sys"].iter().any(|folder| path.starts_with(folder))
}

/// The folder that contains a path.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Whether two paths name the same file, by symbolic links, by hard links, or because a new file would be created at
/// the same place.
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

/// The canonical path of a file, existing or not; `None` for streams, because different streams can have the same path.
fn location(path: &Path) -> Option<PathBuf> {
    match place(path).ok()? {
        Place::Stream => None,
        Place::Free(target) => {
            Some(folder_of(&target).canonicalize().ok()?.join(target.file_name()?))
        }
        Place::Regular(target, _) | Place::Folder(target) => target.canonicalize().ok(),
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::os::fd::AsRawFd;

    use super::*;

    #[test]
    fn streams_of_the_process_are_not_files() {
        for path in [
            "/dev/stdin",
            "/dev/stdout",
            "/dev/stderr",
            "/dev/fd/3",
            "/proc/self/fd/1",
            "/proc/7/fd/0",
        ] {
            assert!(is_stream(Path::new(path)), "{path}");
        }
        for path in [
            "/dev/null",
            "/dev/fd",
            "/proc/self/status",
            "/proc/fdinfo/1",
            "/home/fd/1",
            "fd/1",
            "",
        ] {
            assert!(!is_stream(Path::new(path)), "{path}");
        }
    }

    #[test]
    fn streams_are_for_reading_if_they_are_opened_for_it_alone() {
        let written = fs::File::create("/dev/null").unwrap();
        let read = fs::File::open("/dev/null").unwrap();
        for (file, expected) in [(&read, true), (&written, false)] {
            for folder in ["/dev/fd", "/proc/self/fd"] {
                let stream = Path::new(folder).join(file.as_raw_fd().to_string());
                assert_eq!(is_for_reading(&stream), expected, "{}", stream.display());
            }
        }
        assert!(!is_for_reading(Path::new("/")));
    }

    #[test]
    fn files_of_the_system_are_known_by_their_folder() {
        for (path, expected) in [
            ("/proc/version", true),
            ("/proc/none", true),
            ("/sys", true),
            ("/dev/null", false),
            ("/processes", false),
            ("proc/version", false),
        ] {
            assert_eq!(is_of_system(Path::new(path)), expected, "{path}");
        }
    }

    #[test]
    fn the_folder_of_a_name_alone_is_the_present_one() {
        for (path, folder) in [("a.rs", "."), ("", "."), ("/", "."), ("a/b.rs", "a"), ("/a", "/")] {
            assert_eq!(folder_of(Path::new(path)), Path::new(folder), "{path}");
        }
    }
}
