//! A generated file, before anybody writes it.

use std::path::{Path, PathBuf};

use robot_codegen::backend::Contents;

/// A generated file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// The path, relative to the folder that the file belongs to, with `/` between its parts.
    pub path: String,
    /// What is in it.
    pub contents: Contents,
}

impl File {
    /// A file of text.
    #[must_use]
    pub fn text(path: &str, text: String) -> File {
        File { path: path.to_owned(), contents: Contents::Text(text) }
    }

    /// The file's path in a folder.
    #[must_use]
    pub fn path_in(&self, folder: &Path) -> PathBuf {
        let parts = self.path.split('/').filter(|part| !part.is_empty());
        parts.fold(folder.to_owned(), |path, part| path.join(part))
    }
}
