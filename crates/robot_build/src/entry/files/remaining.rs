//! Generated files of an earlier package that are not part of the present one.

use std::collections::BTreeSet;
use std::fs::{FileType, read_dir};
use std::path::{Path, PathBuf};

use super::marker::Ends;
use crate::driver::file::File;

/// The folders that a package can have, in any language; below them, all folders can belong to it. Folders that begin
/// with `+` are those of MATLAB.
const FOLDERS: [&str; 3] = ["src", "tests", "examples"];

/// The file that every package has in its folder.
const README: &str = "README.md";

/// The file in a folder whose contents another program can make again, such as Cargo's `target`.
const CACHE: &str = "CACHEDIR.TAG";

/// Finds generated code, and the other files of packages, that an earlier run wrote to a folder and that are not among
/// `files`. They describe an earlier state of the robot or its functions, or belong to a package in another language.
/// Only the folder itself and those that packages have are searched, without symbolic links and without other packages
/// below. Documents and pinned plans are not found. Returns paths in `folder`, sorted by name; files that cannot be
/// read are not included.
#[must_use]
pub fn remaining(folder: &Path, files: &[File]) -> Vec<PathBuf> {
    let written: BTreeSet<PathBuf> = files.iter().map(|file| file.path_in(folder)).collect();
    let mut folders: BTreeSet<PathBuf> =
        written.iter().filter_map(|path| path.parent()).map(Path::to_owned).collect();
    folders.insert(folder.to_owned());
    for (path, kind) in entries(folder) {
        if kind.is_dir() && is_of_package(&path) {
            add_below(path, &mut folders);
        }
    }
    let paths = folders.iter().flat_map(|folder| entries(folder));
    let paths = paths.filter(|(_, kind)| kind.is_file()).map(|(path, _)| path);
    let found: BTreeSet<PathBuf> =
        paths.filter(|path| !written.contains(path) && is_code(path)).collect();
    found.into_iter().collect()
}

fn entries(folder: &Path) -> impl Iterator<Item = (PathBuf, FileType)> {
    let entries = read_dir(folder).ok().into_iter().flatten().flatten();
    entries.filter_map(|entry| Some((entry.path(), entry.file_type().ok()?)))
}

fn is_of_package(folder: &Path) -> bool {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with('+') || FOLDERS.contains(&&*name)
}

fn is_code(path: &Path) -> bool {
    Ends::of(path).is_ok_and(|ends| ends.are_of_code())
}

/// Adds a folder and those below it, except for other packages and caches.
fn add_below(folder: PathBuf, folders: &mut BTreeSet<PathBuf>) {
    let mut waiting = vec![folder];
    while let Some(folder) = waiting.pop() {
        if is_code(&folder.join(README)) || folder.join(CACHE).exists() {
            continue;
        }
        waiting.extend(entries(&folder).filter(|(_, kind)| kind.is_dir()).map(|(path, _)| path));
        folders.insert(folder);
    }
}
