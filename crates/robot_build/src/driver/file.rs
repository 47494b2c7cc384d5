//! A generated file, before anybody writes it.

use std::path::{Path, PathBuf};

/// A generated file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// The path, relative to the folder that the file belongs to, with `/` between its parts.
    pub path: String,
    /// The text.
    pub text: String,
}

impl File {
    /// The file's path in a folder.
    #[must_use]
    pub fn path_in(&self, folder: &Path) -> PathBuf {
        let parts = self.path.split('/').filter(|part| !part.is_empty());
        parts.fold(folder.to_owned(), |path, part| path.join(part))
    }
}
