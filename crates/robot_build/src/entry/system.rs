//! The system's reasons why files cannot be read or written, in plain words.

use std::io::{Error, ErrorKind};

/// Returns the reason why a file cannot be read or written, for the end of a message.
#[must_use]
pub fn system_reason(error: &Error) -> String {
    let words = match error.kind() {
        ErrorKind::NotFound => "there is no such file or folder",
        ErrorKind::PermissionDenied => "you do not have permission",
        ErrorKind::NotADirectory => "a part of its path is a file, not a folder",
        ErrorKind::IsADirectory => "it is a folder",
        ErrorKind::ReadOnlyFilesystem => "its disk is read-only",
        ErrorKind::StorageFull => "the disk is full",
        ErrorKind::QuotaExceeded => "your disk quota is used up",
        ErrorKind::InvalidData => "it is not UTF-8 text",
        ErrorKind::FileTooLarge => "the file is too large for the system",
        // This kind has no stable name yet.
        kind if format!("{kind:?}") == "FilesystemLoop" => "its symbolic links form a cycle",
        // EIO, which has no kind yet.
        _ if cfg!(unix) && error.raw_os_error() == Some(5) => {
            "the system reports an input/output error"
        }
        _ => return without_number(&error.to_string()).to_owned(),
    };
    match error.get_ref() {
        // An error of this program, with a reason of its own.
        Some(_) => error.to_string(),
        None => words.to_owned(),
    }
}

/// The system's message without its number.
fn without_number(message: &str) -> &str {
    message.split_once(" (os error").map_or(message, |(words, _)| words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_words_without_numbers() {
        let path = std::env::temp_dir().join(format!("robot_build_system_{}", std::process::id()));
        std::fs::write(&path, "").unwrap();
        let reason = |path: &std::path::Path| system_reason(&std::fs::read(path).unwrap_err());
        assert!(reason(&path.join("below")).starts_with("a part of its path is a file"));
        assert!(reason(&path.with_extension("missing")).starts_with("there is no such file"));
        std::fs::remove_file(&path).unwrap();
        assert_eq!(without_number("Text file busy (os error 26)"), "Text file busy");
        assert_eq!(system_reason(&Error::new(ErrorKind::NotFound, "mine")), "mine");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&path, &path).unwrap();
            assert_eq!(reason(&path), "its symbolic links form a cycle");
            std::fs::remove_file(&path).unwrap();
            assert_eq!(reason(&std::env::temp_dir()), "it is a folder");
        }
    }
}
