//! A generated file, before it is written.

use std::path::{Path, PathBuf};

use robot_codegen::backend::Contents;

/// A generated file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// The path, relative to the folder to which the file belongs, with `/` between its parts.
    pub path: String,
    /// The contents of the file.
    pub contents: Contents,
}

impl File {
    /// Makes a text file.
    #[must_use]
    pub fn text(path: &str, text: String) -> File {
        File { path: path.to_owned(), contents: Contents::Text(text) }
    }

    /// Returns the path of the file in a folder.
    #[must_use]
    pub fn path_in(&self, folder: &Path) -> PathBuf {
        let parts = self.path.split('/').filter(|part| !part.is_empty());
        parts.fold(folder.to_owned(), |path, part| path.join(part))
    }
}
