//! Robot files on disk.

use std::io::Read;
use std::path::{Path, PathBuf};

use robot_model::description::{self, MAX_BYTES};
use robot_model::diagnostic::Source;
use robot_symbolic::nearest_word;

use crate::error::{Error, Errors, shown};

/// A robot file that has been read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotFile {
    /// Its path, with symbolic links followed.
    pub path: PathBuf,
    /// Its text, under the path as it was given.
    pub source: Source,
}

impl RobotFile {
    /// Reads a file that belongs to a package: `path` is relative to its folder.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, is too large or no text; one outside of the package, be it by
    /// `..` or a symbolic link, unless `allow_outside` says that this is meant.
    pub fn in_package(
        path: &Path,
        package: &Path,
        allow_outside: bool,
    ) -> Result<RobotFile, Errors> {
        check_not_empty(path)?;
        let found = canonical(&package.join(path), path)?;
        let package = canonical(package, package)?;
        if !allow_outside && !found.starts_with(&package) {
            return Err(Errors::from(Error::Outside { path: found, package }));
        }
        RobotFile::read_at(found, path)
    }

    /// Reads a file wherever it lies.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, is too large or no text.
    pub fn read(path: &Path) -> Result<RobotFile, Errors> {
        check_not_empty(path)?;
        RobotFile::read_at(canonical(path, path)?, path)
    }

    /// `given` is the path for messages.
    fn read_at(path: PathBuf, given: &Path) -> Result<RobotFile, Errors> {
        let failed = |error: std::io::Error| cannot_read(given, &error.to_string());
        let found = std::fs::metadata(&path).map_err(failed)?;
        if found.is_dir() {
            return Err(Errors::from(cannot_read(given, "it is a folder; name a robot file")));
        }
        if !found.is_file() {
            return Err(Errors::from(cannot_read(given, "it is not a regular file")));
        }
        let name = given.to_string_lossy().into_owned();
        if name.chars().any(char::is_control) {
            // Cargo reads a build script's output line by line.
            let reason = "its path contains control characters; rename it";
            return Err(Errors::from(cannot_read(given, reason)));
        }
        let mut bytes = vec![];
        let file = std::fs::File::open(&path).map_err(failed)?;
        // One byte more than the reader accepts is enough for it to refuse the file.
        file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(failed)?;
        let text = description::decode(&name, bytes)?;
        Ok(RobotFile { path, source: Source { name, text } })
    }
}

/// The robot files of a folder, relative to the package as the folder is, in the order of names.
pub(crate) fn robot_files(package: &Path, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let failed = |error: std::io::Error| cannot_read(folder, &error.to_string());
    let mut files = vec![];
    for entry in std::fs::read_dir(package.join(folder)).map_err(failed)? {
        let path = folder.join(entry.map_err(failed)?.file_name());
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn check_not_empty(path: &Path) -> Result<(), Error> {
    if path.as_os_str().is_empty() {
        return Err(cannot_read(Path::new("``"), "the path of a robot file is empty; name a file"));
    }
    Ok(())
}

fn canonical(path: &Path, given: &Path) -> Result<PathBuf, Error> {
    path.canonicalize().map_err(|error| {
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound => missing_at(path, given),
            _ => error.to_string(),
        };
        cannot_read(given, &reason)
    })
}

/// That there is no file of that path, and the one in its folder whose name is nearest.
#[must_use]
pub fn missing(path: &Path) -> String {
    missing_at(path, path)
}

/// The same of a file that was looked for at a path made of the one given.
fn missing_at(path: &Path, given: &Path) -> String {
    let place =
        if path == given { String::new() } else { format!(" (looked for {})", shown(path)) };
    let mut near =
        nearest(path).map(|near| format!("; did you mean {}?", shown(&given.with_file_name(near))));
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.exists());
    if let Some(folder) = folder {
        near = Some(format!("; there is no folder {}", shown(folder)));
    }
    format!("there is no such file{place}{}", near.unwrap_or_default())
}

/// The name of the file in the same folder whose name is nearest, with the same extension first.
fn nearest(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
    let names = entries.filter_map(|entry| {
        let path = entry.ok()?.path();
        // A plan is never asked for by its name.
        let is_wanted = path.is_file() && path.extension().is_none_or(|end| end != "plan");
        is_wanted.then(|| Some(path.file_name()?.to_str()?.to_owned()))?
    });
    let mut names: Vec<String> = names.take(MOST_NAMES).collect();
    names.sort();
    let stem = |name: &str| Path::new(name).file_stem()?.to_str().map(str::to_owned);
    let name = path.file_name()?.to_str()?;
    let whole = nearest_word(name, names.iter().map(String::as_str)).map(str::to_owned);
    whole.or_else(|| names.iter().find(|known| stem(known) == stem(name)).cloned())
}

/// The most files of a folder that are looked at for a name.
const MOST_NAMES: usize = 10_000;

fn cannot_read(path: &Path, reason: &str) -> Error {
    Error::File { action: "read", path: path.to_owned(), reason: reason.to_owned() }
}
