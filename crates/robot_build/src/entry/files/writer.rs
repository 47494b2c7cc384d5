//! The rules for writing output files.

use std::fs::{self, Metadata, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::marker::Ends;
use super::pending::{self, Pending};
use super::place::{Place, folder_of, is_of_system, is_same, place};
use super::seal::is_edited;
use super::staging::{Staged, remove_leftovers};
use crate::driver::file::File;
use crate::entry::system::system_reason;
use crate::error::{Error, Errors};

/// The evidence that this program wrote an existing file, which may then be replaced.
#[derive(Clone, Copy, Debug)]
pub enum Ownership {
    /// The [`MARKER`](super::MARKER), or the mark of generated code, near its start or on its last line, and a
    /// [seal](super::sealed()) that matches, if it has one.
    Marked,
    /// Its first line, for formats without comments; the function returns whether this program writes such a line.
    Headed(fn(&str) -> bool),
    /// No evidence, because the file is meant to be edited.
    Edited,
}

/// A file to write.
#[derive(Clone, Debug)]
pub struct Output<'a> {
    /// The path.
    pub path: PathBuf,
    /// The content.
    pub bytes: &'a [u8],
    /// The existing files that it may replace.
    pub ownership: Ownership,
}

/// Writes output files.
///
/// - An output that is one of the inputs is always an error. Another path, a symbolic link or a hard link to an
///   input is the same file.
/// - An existing file that is not empty and that this program did not write, or whose [seal](super::sealed()) shows
///   that it was edited since, is an error, unless [`Writer::force`] is set.
/// - Everything is checked before anything is written.
/// - A regular file is written to a temporary file in the same folder, which is renamed when it is complete and on
///   the disk; it keeps the permissions of the file that it replaces. A symbolic link stays, and the file
///   to which it points is replaced.
/// - A file whose bytes do not change is not written, so that its modification time stays meaningful.
/// - A device, a pipe or an open stream such as `/dev/stdout` is written to and never read.
#[derive(Clone, Debug)]
#[must_use]
pub struct Writer {
    inputs: Vec<PathBuf>,
    force: bool,
    remedy: &'static str,
}

impl Default for Writer {
    fn default() -> Writer {
        Writer::new()
    }
}

impl Writer {
    /// Makes a writer without inputs that replaces only files of this program.
    pub fn new() -> Writer {
        let remedy = "choose another name, or move that file away";
        Writer { inputs: vec![], force: false, remedy }
    }

    /// Adds files that were read for the outputs, or that the next run will read.
    pub fn inputs(mut self, paths: impl IntoIterator<Item = impl Into<PathBuf>>) -> Writer {
        self.inputs.extend(paths.into_iter().map(Into::into));
        self
    }

    /// Sets whether files that this program did not write are replaced.
    pub fn force(mut self, force: bool) -> Writer {
        self.force = force;
        self
    }

    /// Sets the remedy in the message about a file that is not replaced.
    pub fn remedy(mut self, remedy: &'static str) -> Writer {
        self.remedy = remedy;
        self
    }

    /// Checks whether outputs could not be written, as far as this is known before their contents; for use before long
    /// computations.
    ///
    /// # Errors
    ///
    /// The errors of [`Writer::write`], and two outputs with the same path.
    pub fn check(&self, outputs: &[(&Path, Ownership)]) -> Result<(), Errors> {
        let mut errors = vec![];
        for (index, (path, ownership)) in outputs.iter().enumerate() {
            let others = outputs.iter().take(index);
            if others.into_iter().any(|(other, _)| is_same(path, other)) {
                let reason = "two outputs have this name; rename one of them".to_owned();
                errors.push(Error::File { action: "write", path: (*path).to_owned(), reason });
            }
            errors.extend(self.check_one(path, *ownership).err());
        }
        Errors::check(errors, ())
    }

    fn check_one(&self, path: &Path, ownership: Ownership) -> Result<(), Error> {
        match (self.target(path)?, ownership) {
            // The existing file can have the same content as the output.
            (_, Ownership::Edited) | (Target::Free(_) | Target::Stream, _) => Ok(()),
            (Target::Regular(target, _), _) => self.check_owner(path, &target, ownership),
        }
    }

    /// Writes all files or, if one must not or cannot be written, none; returns the number of files that changed. Only
    /// during the last step, in which the files are renamed one after another in the order of the list, can some be new
    /// and others old.
    ///
    /// # Errors
    ///
    /// All files that must not be written; errors of the system, with the path.
    pub fn write(&self, outputs: &[Output<'_>]) -> Result<usize, Errors> {
        let (mut changed, mut errors) = (vec![], vec![]);
        for output in outputs {
            match self.change(output) {
                Ok(target) => changed.extend(target.map(|target| (output, target))),
                Err(error) => errors.push(error),
            }
        }
        Errors::check(errors, ())?;
        let mut made = Folders::default();
        let (mut staged, mut streams) = (vec![], vec![]);
        for (output, target) in &changed {
            let failed = |error| cannot_write(&output.path, &error);
            let (target, present) = match target {
                Target::Stream => {
                    streams.push(*output);
                    continue;
                }
                Target::Free(target) => (target, None),
                Target::Regular(target, present) => (target, Some(present)),
            };
            made.make(folder_of(target)).map_err(failed)?;
            staged.push((output, Staged::file(target, output.bytes, present).map_err(failed)?));
        }
        for output in streams {
            write_stream(output)?;
        }
        made.keep();
        for (output, staged) in staged {
            staged.put().map_err(|error| cannot_write(&output.path, &error))?;
        }
        Ok(changed.len())
    }

    /// Starts a file that is written piece by piece. The path is checked as in [`Writer::write`], except for files that
    /// are meant to be edited, whose content could turn out to be the same.
    ///
    /// # Errors
    ///
    /// The errors of [`Writer::write`].
    pub fn begin(&self, path: &Path, ownership: Ownership) -> Result<Pending, Errors> {
        self.check_one(path, ownership)?;
        let failed = |error| cannot_write(path, &error);
        let target = self.target(path)?;
        let mut folders = Folders::default();
        let place = match &target {
            Target::Stream => {
                pending::Place::Stream(OpenOptions::new().append(true).open(path).map_err(failed)?)
            }
            Target::Free(target) => {
                folders.make(folder_of(target)).map_err(failed)?;
                pending::Place::Staged(Staged::empty(target).map_err(failed)?, None)
            }
            Target::Regular(target, metadata) => {
                // A file that must not be written must not be replaced either.
                OpenOptions::new().write(true).open(target).map_err(failed)?;
                let staged = Staged::empty(target).map_err(failed)?;
                pending::Place::Staged(staged, Some(Box::new((target.clone(), metadata.clone()))))
            }
        };
        let (writer, path) = (self.clone(), path.to_owned());
        Ok(Pending { writer, path, ownership, place, folders, length: 0 })
    }

    /// Writes the files of a folder, as [`Writer::write`] does. A folder that does not exist yet is created with all of
    /// its files or not at all. In an existing folder, the first file is written last. Returns the number of files that
    /// changed.
    ///
    /// # Errors
    ///
    /// The errors of [`Writer::write`], and a folder whose path is a file or that of an input.
    pub fn write_folder(&self, folder: &Path, files: &[File]) -> Result<usize, Errors> {
        self.check_input(folder)?;
        let failed = |error| cannot_write(folder, &error);
        let target = match place(folder).map_err(failed)? {
            Place::Free(target) => target,
            Place::Folder(target) => {
                remove_leftovers(&target);
                let outputs = files.iter().skip(1).chain(files.first());
                let outputs: Vec<Output<'_>> = outputs
                    .map(|file| Output {
                        path: file.path_in(folder),
                        bytes: file.contents.bytes(),
                        ownership: Ownership::Marked,
                    })
                    .collect();
                return self.write(&outputs);
            }
            place @ (Place::Regular(..) | Place::Stream) => {
                let what = match place {
                    Place::Regular(..) => "a file",
                    _ => "a pipe or a device",
                };
                let reason = format!("it is {what}, but a folder is needed");
                let path = folder.to_owned();
                return Err(Errors::from(Error::File { action: "write", path, reason }));
            }
        };
        let mut made = Folders::default();
        made.make(folder_of(&target)).map_err(failed)?;
        let staged = Staged::folder(&target).map_err(failed)?;
        for file in files {
            let path = file.path_in(staged.path());
            fs::create_dir_all(folder_of(&path))
                .and_then(|()| create(&path, file.contents.bytes()))
                .map_err(|error| cannot_write(&file.path_in(folder), &error))?;
        }
        staged.put().map_err(failed)?;
        made.keep();
        Ok(files.len())
    }

    /// Returns the target that has to be written for an output; `None` if the file is up to date.
    fn change(&self, output: &Output<'_>) -> Result<Option<Target>, Error> {
        let target = self.target(&output.path)?;
        let Target::Regular(path, metadata) = &target else { return Ok(Some(target)) };
        if metadata.len() == output.bytes.len() as u64
            && fs::read(path).is_ok_and(|present| present == output.bytes)
        {
            remove_leftovers(path);
            return Ok(None);
        }
        self.check_owner(&output.path, path, output.ownership)?;
        // A file that must not be written must not be replaced either.
        let writable = OpenOptions::new().write(true).open(path);
        writable.map_err(|error| cannot_write(&output.path, &error))?;
        Ok(Some(target))
    }

    /// Returns an error if the path of an output is that of an input, which does not have to exist.
    fn check_input(&self, path: &Path) -> Result<(), Error> {
        match self.inputs.iter().find(|input| is_same(path, input)) {
            Some(input) => Err(Error::IsInput { path: path.to_owned(), input: input.clone() }),
            None => Ok(()),
        }
    }

    /// Finds the target at the path of an output; inputs, folders and system files are errors.
    fn target(&self, path: &Path) -> Result<Target, Error> {
        self.check_input(path)?;
        let is_folder = || {
            let reason = "it is a folder; name a file".to_owned();
            Error::File { action: "write", path: path.to_owned(), reason }
        };
        match place(path).map_err(|error| cannot_write(path, &error))? {
            Place::Folder(_) => Err(is_folder()),
            Place::Free(_) if names_folder(path) => Err(is_folder()),
            Place::Free(target) => Ok(Target::Free(target)),
            Place::Regular(target, _) if is_of_system(&target) => {
                let reason =
                    "it is a system file, which is never replaced; choose another name".to_owned();
                Err(Error::File { action: "write", path: path.to_owned(), reason })
            }
            Place::Regular(target, metadata) => Ok(Target::Regular(target, metadata)),
            Place::Stream => Ok(Target::Stream),
        }
    }

    /// Checks that an existing file may be replaced. `path` is for the message; `target` is the path after following
    /// symbolic links.
    pub(super) fn check_owner(
        &self,
        path: &Path,
        target: &Path,
        ownership: Ownership,
    ) -> Result<(), Error> {
        if self.force {
            return Ok(());
        }
        let failed = |error| cannot_write(path, &error);
        let ends = Ends::of(target).map_err(failed)?;
        let (is_own, reason) = match ownership {
            Ownership::Marked if is_edited(&fs::read(target).map_err(failed)?) => {
                (false, "was edited since this program wrote it")
            }
            Ownership::Marked => (
                ends.are_marked(),
                "does not have this program's `@generated by` line at \
                    its start",
            ),
            Ownership::Headed(is_own) => (
                is_own(ends.first_line()),
                "does not begin with the line that this program \
                    writes",
            ),
            Ownership::Edited => {
                (false, "differs from what would be written; it may have been edited")
            }
        };
        // Replacing an empty file loses nothing.
        if is_own || ends.are_empty() {
            return Ok(());
        }
        Err(Error::Foreign { path: path.to_owned(), reason, remedy: self.remedy })
    }
}

/// The target of an output, after following symbolic links.
enum Target {
    Free(PathBuf),
    Regular(PathBuf, Metadata),
    Stream,
}

pub(super) fn cannot_write(path: &Path, error: &std::io::Error) -> Error {
    let reason = match error.kind() {
        // A temporary file is created in the folder of the target.
        std::io::ErrorKind::NotFound => "its folder does not exist, or takes no files".to_owned(),
        _ => system_reason(error),
    };
    Error::File { action: "write", path: path.to_owned(), reason }
}

/// Whether a path ends with a separator, as paths of folders do.
fn names_folder(path: &Path) -> bool {
    let text = path.as_os_str().to_string_lossy();
    text.ends_with(std::path::is_separator)
}

/// Writes a new file and flushes it to the disk.
fn create(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Appends to an open stream or to a device.
fn write_stream(output: &Output<'_>) -> Result<(), Error> {
    let written = OpenOptions::new()
        .append(true)
        .open(&output.path)
        .and_then(|mut stream| stream.write_all(output.bytes));
    written.map_err(|error| cannot_write(&output.path, &error))
}

/// Folders that were created for outputs; empty ones are removed if the outputs fail.
#[derive(Default)]
pub(super) struct Folders(Vec<PathBuf>);

impl Folders {
    /// Creates a folder and its missing parents.
    fn make(&mut self, folder: &Path) -> std::io::Result<()> {
        let missing = folder.ancestors().take_while(|folder| {
            !folder.as_os_str().is_empty() && fs::symlink_metadata(folder).is_err()
        });
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        // `missing/..` does not exist for the system, even though it would after `missing` was created.
        if missing.iter().any(|folder| folder.file_name().is_none()) {
            return Err(std::io::ErrorKind::NotFound.into());
        }
        fs::create_dir_all(folder)?;
        self.0.extend(missing.into_iter().rev());
        Ok(())
    }

    /// Keeps the folders, because they have files now.
    pub(super) fn keep(&mut self) {
        self.0.clear();
    }
}

impl Drop for Folders {
    fn drop(&mut self) {
        for folder in self.0.iter().rev() {
            // A folder with a file in it stays.
            let _ = fs::remove_dir(folder);
        }
    }
}
