//! Robot files on disk.

use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};

use robot_model::description::{self, MAX_BYTES};
use robot_model::diagnostic::Source;
use robot_symbolic::nearest_word;

use crate::entry::pin::pin_path;
use crate::entry::system::system_reason;
use crate::error::{Error, Errors, shown};

/// The message about a pipe or a device. A robot is not read from one, because its pinned plan is stored beside the robot
/// file.
const NOT_REGULAR: &str = "it is not a regular file; save its content in one";

/// A robot file that has been read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotFile {
    /// The path of the file, after following symbolic links.
    pub path: PathBuf,
    /// The text of the file; its name is the path as given.
    pub source: Source,
}

impl RobotFile {
    /// Reads a file of a package; `path` is relative to the folder of the package.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, is too large or is not text; a file or a pinned plan outside the package, by `..` or
    /// by a symbolic link, unless `allow_outside` is set.
    pub fn in_package(
        path: &Path,
        package: &Path,
        allow_outside: bool,
    ) -> Result<RobotFile, Errors> {
        check_is_file_name(path)?;
        let found = canonical(&package.join(path), path)?;
        let package = canonical(package, package)?;
        let plan = pin_path(&found).canonicalize().ok();
        let read = [Some(found.clone()), plan];
        let is_outside = |path: &PathBuf| !allow_outside && !path.starts_with(&package);
        if let Some(path) = read.into_iter().flatten().find(is_outside) {
            return Err(Errors::from(Error::Outside { path, package }));
        }
        RobotFile::read_at(found, path)
    }

    /// Reads a file from anywhere.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, is too large or is not text.
    pub fn read(path: &Path) -> Result<RobotFile, Errors> {
        check_is_file_name(path)?;
        RobotFile::read_at(canonical(path, path)?, path)
    }

    /// Reads the file at a path; `given` is the path for messages.
    fn read_at(path: PathBuf, given: &Path) -> Result<RobotFile, Errors> {
        let failed = |error: std::io::Error| cannot_read(given, &system_reason(&error));
        let found = std::fs::metadata(&path).map_err(failed)?;
        if found.is_dir() {
            return Err(Errors::from(cannot_read(given, "it is a folder; name a file")));
        }
        if !found.is_file() {
            return Err(Errors::from(cannot_read(given, NOT_REGULAR)));
        }
        let name = given.to_string_lossy().into_owned();
        if name.chars().any(char::is_control) {
            // Cargo reads a build script's output line by line.
            let reason = "its path contains control characters; rename it";
            return Err(Errors::from(cannot_read(given, reason)));
        }
        let mut bytes = vec![];
        let file = std::fs::File::open(&path).map_err(failed)?;
        // One byte more than the reader accepts is enough to make it reject the file.
        file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(failed)?;
        let text = description::decode(&name, bytes)?;
        Ok(RobotFile { path, source: Source { name, text } })
    }
}

/// Finds the robot files of a folder, sorted by name. Their paths, like that of the folder, are relative to the
/// package.
pub(crate) fn robot_files(package: &Path, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let failed = |error: std::io::Error| cannot_read(folder, &system_reason(&error));
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

fn check_is_file_name(path: &Path) -> Result<(), Error> {
    if path.as_os_str().is_empty() {
        return Err(cannot_read(Path::new("``"), "the path of a robot file is empty; name a file"));
    }
    // A plan and data that a robot file refers to stand beside it.
    if path.as_os_str() == "-" && !path.exists() {
        let why = "this file is not read from standard input; save it and name the file";
        return Err(cannot_read(path, why));
    }
    Ok(())
}

fn canonical(path: &Path, given: &Path) -> Result<PathBuf, Error> {
    path.canonicalize().map_err(|error| {
        let reason = match error.kind() {
            // A pipe has a path, such as /dev/stdin, that leads to no file.
            std::io::ErrorKind::NotFound if path.exists() => NOT_REGULAR.to_owned(),
            std::io::ErrorKind::NotFound => missing_at(path, given),
            _ => system_reason(&error),
        };
        cannot_read(given, &reason)
    })
}

/// The message that there is no file with this path, with the most similar name in its folder.
#[must_use]
pub fn missing(path: &Path) -> String {
    missing_at(path, path)
}

/// The same message for a file whose actual path was derived from the given one.
fn missing_at(path: &Path, given: &Path) -> String {
    if let Ok(target) = path.read_link() {
        return format!("it is a symbolic link to {}, which does not exist", shown(&target));
    }
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

/// The file in the same folder whose name, without its extension, is most similar.
fn nearest(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
    let names = entries.filter_map(|entry| {
        let path = entry.ok()?.path();
        // Users do not name plans, which belong to robot files.
        let is_wanted = path.is_file() && path.extension().is_none_or(|end| end != "plan");
        is_wanted.then(|| Some(path.file_name()?.to_str()?.to_owned()))?
    });
    let mut names: Vec<String> = names.take(MOST_NAMES).collect();
    names.sort();
    let stem = |name: &'_ str| Some(Path::new(name).file_stem()?.to_str()?.to_owned());
    let stems: Vec<String> = names.iter().filter_map(|name| stem(name)).collect();
    let near = nearest_word(&stem(path.file_name()?.to_str()?)?, stems.iter().map(String::as_str))?;
    let is_near = |name: &&String| stem(name).is_some_and(|stem| stem == near);
    // With the same extension, if there is such a file, or else a robot file before others.
    let extension = path.extension();
    let of_near = || names.iter().filter(is_near);
    let with = |end: &dyn Fn(Option<&OsStr>) -> bool| {
        of_near().find(|name| end(Path::new(name).extension()))
    };
    let same = with(&|end| end == extension);
    let robot = || with(&|end| end.is_some_and(|end| end == "toml" || end == "urdf"));
    same.or_else(robot).or_else(|| of_near().next()).cloned()
}

/// The largest number of files of a folder that are examined for a similar name.
const MOST_NAMES: usize = 10_000;

fn cannot_read(path: &Path, reason: &str) -> Error {
    Error::File { action: "read", path: path.to_owned(), reason: reason.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_plan_outside_of_the_package_is_refused() {
        let folder = std::env::temp_dir().join(format!("robot_build_plan_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        let package = folder.join("package");
        std::fs::create_dir_all(&package).unwrap();
        std::fs::write(package.join("arm.toml"), "format = 1").unwrap();
        std::fs::write(folder.join("other.plan"), "").unwrap();
        let read = |allow| RobotFile::in_package(Path::new("arm.toml"), &package, allow);
        assert!(read(false).is_ok());
        std::os::unix::fs::symlink("../other.plan", package.join("arm.plan")).unwrap();
        let shown = read(false).unwrap_err().to_string();
        assert!(shown.contains("other.plan is outside the package"), "{shown}");
        assert!(read(true).is_ok());
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_missing_file_has_the_nearest_name() {
        let folder = std::env::temp_dir().join(format!("robot_build_paths_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(folder.join("lefty.toml")).unwrap();
        for name in ["left.toml", "left.plan", "left.tex", "puma.urdf", "other.toml"] {
            std::fs::write(folder.join(name), "").unwrap();
        }
        let at = |name: &str| folder.join(name);
        let told = |name: &str| missing(&at(name)).replace(folder.to_str().unwrap(), "F");
        let none = "there is no such file";
        for (name, near) in [
            // Neither a folder nor a plan is a robot file.
            ("lefti.toml", "; did you mean F/left.toml?"),
            ("left.plen", "; did you mean F/left.toml?"),
            ("left.tml", "; did you mean F/left.toml?"),
            // Another ending of the same name.
            ("puma.toml", "; did you mean F/puma.urdf?"),
            // The same ending does not make short names alike.
            ("nope.toml", ""),
            ("nothing_like_it.toml", ""),
            ("none/left.toml", "; there is no folder F/none"),
        ] {
            assert_eq!(told(name), format!("{none}{near}"), "{name}");
        }
        // The place is stated if it is not the given path.
        let told = missing_at(&at("puma.tom"), Path::new("arms/puma.tom"));
        let place = format!("{none} (looked for {})", shown(&at("puma.tom")));
        assert_eq!(told, format!("{place}; did you mean arms/puma.urdf?"));
        assert!(missing(Path::new("nothing_like_it")).starts_with(none));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("gone.toml", at("link.toml")).unwrap();
            let link = "it is a symbolic link to gone.toml, which does not exist";
            assert_eq!(missing(&at("link.toml")), link);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn what_is_not_a_robot_file_has_its_reason() {
        let reason = |path: &Path| RobotFile::read(path).unwrap_err().to_string();
        assert!(reason(Path::new("")).contains("the path of a robot file is empty"));
        assert!(reason(&std::env::temp_dir()).contains("it is a folder; name a file"));
        if cfg!(unix) {
            assert!(reason(Path::new("/dev/null")).contains(NOT_REGULAR));
        }
        #[cfg(target_os = "linux")]
        {
            use std::os::fd::AsRawFd;
            // The path of a pipe leads to `pipe:[…]`, which is not a path.
            let (pipe, _writer) = std::io::pipe().unwrap();
            let path = format!("/dev/fd/{}", pipe.as_raw_fd());
            assert!(reason(Path::new(&path)).contains(NOT_REGULAR));
        }
    }
}
