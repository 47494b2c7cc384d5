//! Files that commands write, and the check that they are up to date.

use std::borrow::Cow;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use robot_build::{
    Error, File, Output, Ownership, Staleness, Writer, remaining, sealed, shown, staleness,
};

use crate::Terminal;
use crate::failure::Failure;

/// The largest number of files of an earlier run that a message names.
const SHOWN: usize = 5;

/// Whether files of others are replaced.
#[derive(Args)]
pub(crate) struct ForceArgument {
    /// Replace an existing file that this program did not write, or that may have been edited since; never an input
    #[arg(long)]
    force: bool,
}

impl ForceArgument {
    /// Makes a writer of outputs that are made from these inputs; `-` is standard input. Returns an error if `--force`
    /// is given although nothing is written.
    pub(crate) fn writer(
        &self,
        inputs: impl IntoIterator<Item = PathBuf>,
        writes: bool,
    ) -> Result<Writer, Failure> {
        if self.force && !writes {
            let message = "--force has no effect, because no file is written; leave it out";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let inputs = inputs.into_iter().map(|input| match input.to_str() {
            Some("-") => PathBuf::from("/dev/stdin"),
            _ => input,
        });
        let remedy = "choose another name, or replace it with --force";
        Ok(Writer::new().inputs(inputs).force(self.force).remedy(remedy))
    }
}

/// Where a command that makes one text puts it.
#[derive(Args)]
pub(crate) struct OutputArguments {
    /// The file to write; `-` is standard output [default: -]
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Compare the file with what would be written, and write nothing
    #[arg(long, requires = "output")]
    check: bool,
    #[command(flatten)]
    force: ForceArgument,
}

/// The file of an output; `None` for `-`, which is standard output.
pub(crate) fn file_of(path: Option<&Path>) -> Option<&Path> {
    path.filter(|path| path.as_os_str() != "-")
}

/// The endings of names of files that this program reads or writes.
#[rustfmt::skip]
const ENDINGS: [&str; 29] = [
    "toml", "urdf", "xacro", "plan", "rs", "c", "h", "cc", "cpp", "hpp", "cu", "cuh", "ino", "py", "m", "js", "mjs", "ts",
    "mts", "wgsl", "wasm", "html", "svg", "pdf", "tex", "typ", "md", "json", "csv",
];

/// Whether the name of a file ends as that of another kind of file than the one with this ending.
pub(crate) fn is_of_other_kind(path: &Path, own: &str) -> bool {
    let is = |ending: &str| path.extension().is_some_and(|end| end.eq_ignore_ascii_case(ending));
    !is(own) && ENDINGS.into_iter().any(is)
}

/// A kind of output.
#[derive(Clone, Copy)]
pub(crate) struct Kind<'k> {
    /// What it is, as in "a schema is JSON".
    pub(crate) doc: &'k str,
    /// The ending of the names of its files.
    pub(crate) ending: &'k str,
}

impl Kind<'_> {
    /// Checks that the file's name does not end as that of another kind of file, which could be an earlier output.
    pub(crate) fn check(&self, path: &Path) -> Result<(), Failure> {
        if !is_of_other_kind(path, self.ending) {
            return Ok(());
        }
        let name = shown(&path.with_extension(self.ending));
        Err(Failure::Usage(vec![format!("{}; name the file {name}", self.doc)]))
    }
}

/// The destination of a text, which has been checked.
pub(crate) struct Delivery<'a> {
    path: Option<Cow<'a, Path>>,
    check: bool,
    writer: Writer,
    ownership: Ownership,
}

impl OutputArguments {
    /// The file that is given, if there is one.
    pub(crate) fn file(&self) -> Option<&PathBuf> {
        self.output.as_ref().filter(|path| file_of(Some(path)).is_some())
    }

    /// Whether neither a file nor standard output is given.
    pub(crate) fn is_open(&self) -> bool {
        self.output.is_none()
    }

    /// The destination of a text with the mark of this program that is made from these inputs. If it cannot be written,
    /// the error is returned here, before any work.
    pub(crate) fn open(
        &self,
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> Result<Delivery<'_>, Failure> {
        self.open_as(Ownership::Marked, inputs)
    }

    /// The destination of a text whose origin is recognized as given by `ownership`.
    pub(crate) fn open_as(
        &self,
        ownership: Ownership,
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> Result<Delivery<'_>, Failure> {
        let path = file_of(self.output.as_deref());
        if self.check && path.is_none() {
            let message = "--check compares a file, and `-` is standard output; name a file";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let writer = self.force.writer(inputs, path.is_some() && !self.check)?;
        let path = path.map(Cow::Borrowed);
        Delivery { path, check: self.check, writer, ownership }.opened()
    }

    /// The destination of a text of one kind. The error about an output that is an input has priority over one about its
    /// name, and this one over that about a file of others.
    pub(crate) fn open_kind(
        &self,
        kind: Kind<'_>,
        ownership: Ownership,
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> Result<Delivery<'_>, Failure> {
        let unowned = self.open_as(Ownership::Edited, inputs)?;
        self.file().map_or(Ok(()), |path| kind.check(path))?;
        Delivery { ownership, ..unowned }.opened()
    }

    /// The destination of a text with the mark of this program, at a path that the user did not give.
    pub(crate) fn open_at(
        &self,
        path: PathBuf,
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> Result<Delivery<'_>, Failure> {
        let writer = self.force.writer(inputs, true)?;
        let (path, ownership) = (Some(Cow::Owned(path)), Ownership::Marked);
        Delivery { path, check: false, writer, ownership }.opened()
    }
}

impl<'a> Delivery<'a> {
    /// The destination of a text with the mark of this program, which is written and never compared.
    pub(crate) fn open(path: Option<&'a Path>, writer: Writer) -> Result<Delivery<'a>, Failure> {
        let path = file_of(path).map(Cow::Borrowed);
        Delivery { path, check: false, writer, ownership: Ownership::Marked }.opened()
    }

    /// The file; `None` if it is standard output.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    fn opened(self) -> Result<Delivery<'a>, Failure> {
        if let Some(path) = self.path().filter(|_| !self.check) {
            self.writer.check(&[(path, self.ownership)])?;
        }
        Ok(self)
    }

    /// Prints the text, writes it to the file, or compares it with the file. In a file, a document has a seal, so that
    /// the next run does not replace it if it was edited.
    pub(crate) fn deliver(&self, text: &str, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let Some(path) = self.path() else {
            return Ok(terminal.output.write_all(text.as_bytes())?);
        };
        let text = sealed(text);
        if self.check {
            let file = (path.to_owned(), text.as_bytes());
            return up_to_date([file], self.ownership, &self.writer);
        }
        let ownership = self.ownership;
        let output = Output { path: path.to_owned(), bytes: text.as_bytes(), ownership };
        write(&self.writer, &[output], terminal.errors)
    }
}

/// Writes files, and prints the size of each that changed.
pub(crate) fn write(
    writer: &Writer,
    outputs: &[Output<'_>],
    errors: &mut dyn Write,
) -> Result<(), Failure> {
    let is_same = |output: &&Output<'_>| {
        output.path.is_file() && std::fs::read(&output.path).is_ok_and(|old| old == output.bytes)
    };
    let same: Vec<&Path> =
        outputs.iter().filter(is_same).map(|output| output.path.as_path()).collect();
    writer.write(outputs)?;
    for output in outputs.iter().filter(|output| !same.contains(&output.path.as_path())) {
        let size = size(output.bytes.len());
        writeln!(errors, "wrote {} ({size})", named(&output.path))?;
    }
    Ok(())
}

/// The name of an output; that of a symbolic link with its target, which is the file that is replaced.
pub(crate) fn named(path: &Path) -> String {
    match path.read_link().ok().filter(|_| path.exists()) {
        Some(target) => format!("{}, a symbolic link to {}", shown(path), shown(&target)),
        None => shown(path),
    }
}

/// Prints a size in a suitable unit.
pub(crate) fn size(bytes: usize) -> String {
    match bytes {
        0..1000 => format!("{bytes} bytes"),
        1000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

/// Prints a text whose result is also the exit code; a reader that closes the stream early does not change the code.
pub(crate) fn answered(text: &str, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    let output = &mut terminal.output;
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}

/// Writes files into a folder, or reports which are out of date.
pub(crate) fn deliver_folder(
    folder: &Path,
    files: &[File],
    check: bool,
    writer: &Writer,
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    if file_of(Some(folder)).is_none() {
        let message = "standard output cannot take several files; name a folder (`./-` if its \
            name is `-`)";
        return Err(Failure::Usage(vec![message.to_owned()]));
    }
    if check {
        let files = files.iter().map(|file| (file.path_in(folder), file.contents.bytes()));
        return up_to_date(files, Ownership::Marked, writer);
    }
    let (changed, all) = (writer.write_folder(folder, files)?, files.len());
    let count = if changed == all { String::new() } else { format!("{changed} of ") };
    if changed > 0 {
        writeln!(terminal.errors, "wrote {}: {count}{all} files", named(folder))?;
    }
    warn_of_remaining(folder, &remaining(folder, files), terminal)
}

/// Warns of generated files of an earlier run, which could be used like those of this run.
fn warn_of_remaining(
    folder: &Path,
    files: &[PathBuf],
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    if files.is_empty() {
        return Ok(());
    }
    let names: Vec<String> = files
        .iter()
        .take(SHOWN)
        .map(|path| shown(path.strip_prefix(folder).unwrap_or(path)))
        .collect();
    let more = files.len().saturating_sub(SHOWN);
    let more = if more == 0 { String::new() } else { format!(" and {more} more") };
    let (names, place) = (names.join(", "), shown(folder));
    let remark = match files.len() {
        1 => format!(
            "a generated file of an earlier run that is not part of this package: {names}; remove it if you do not \
             need it"
        ),
        count => format!(
            "{count} generated files of an earlier run that are not part of this package: {names}{more}; remove those \
             that you do not need"
        ),
    };
    writeln!(terminal.errors, "warning: {place} has {remark}")?;
    Ok(())
}

/// Checks that files have the expected contents; reports all that do not, with the remedy, which `writer` knows for
/// files that it would not replace.
fn up_to_date<'a>(
    files: impl IntoIterator<Item = (PathBuf, &'a [u8])>,
    ownership: Ownership,
    writer: &Writer,
) -> Result<(), Failure> {
    let (mut stale, mut refused) = (vec![], vec![]);
    for (path, bytes) in files {
        let Some(found) = staleness(&path, bytes)? else { continue };
        let name = shown(&path);
        let is_missing = matches!(found, Staleness::Missing);
        stale.push(match found {
            Staleness::Bytes => format!("{name} is out of date"),
            Staleness::Missing => format!("{name} is missing"),
            Staleness::Differs { line } => format!("{name}:{line} is out of date"),
        });
        if let Err(errors) = writer.check(&[(&path, ownership)]) {
            refused.extend(errors.as_slice().iter().map(Error::to_string));
        } else if matches!(ownership, Ownership::Edited) && !is_missing {
            refused.push(format!(
                "run the same command with --force instead of --check to replace {name}; edits of it are lost"
            ));
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    if refused.is_empty() {
        refused.push("run the same command without --check to update it".to_owned());
    }
    stale.extend(refused);
    Err(Failure::Input(stale))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_other_kinds_of_files_are_recognized() {
        let is_other = |name: &str| is_of_other_kind(Path::new(name), "json");
        let others = ["g.rs", "Cargo.TOML", "o.plan", ".json.md"];
        assert_eq!(others.map(is_other), [true; 4]);
        assert_eq!(["a.json", "a.JSON", "a", "a.txt", ".plan", "plan"].map(is_other), [false; 6]);
    }

    #[test]
    fn sizes_are_those_of_people() {
        assert_eq!(
            [0, 999, 1000, 1_440_000].map(size),
            ["0 bytes", "999 bytes", "1.0 kB", "1.4 MB"]
        );
    }
}
