//! Files that commands write, and the check that they are up to date.

use std::path::{Path, PathBuf};

use clap::Args;
use robot_build::{File, Staleness, staleness, write_if_changed};

use crate::Terminal;
use crate::failure::Failure;

/// Where a command that makes one text puts it.
#[derive(Args)]
pub(crate) struct OutputArguments {
    /// The file to write; standard output without this
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Compare the file with what would be written, and write nothing
    #[arg(long, requires = "output")]
    check: bool,
}

impl OutputArguments {
    /// Prints the text, writes it to the file, or compares it with the file.
    pub(crate) fn deliver(&self, text: String, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let Some(path) = &self.output else {
            return Ok(terminal.output.write_all(text.as_bytes())?);
        };
        deliver(path, &[File { path: String::new(), text }], self.check, terminal)
    }
}

/// Writes files into a folder, or says which are out of date. A file without a path is the folder's.
pub(crate) fn deliver(
    folder: &Path,
    files: &[File],
    check: bool,
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    let mut stale = vec![];
    for file in files {
        let parts = file.path.split('/').filter(|part| !part.is_empty());
        let path = parts.fold(folder.to_owned(), |path, part| path.join(part));
        if !check {
            if write_if_changed(&path, &file.text)? {
                writeln!(terminal.errors, "wrote {}", path.display())?;
            }
            continue;
        }
        match staleness(&path, &file.text)? {
            None => {}
            Some(Staleness::Missing) => stale.push(format!("{} is missing", path.display())),
            Some(Staleness::Differs { line }) => {
                stale.push(format!("{}:{line} is out of date", path.display()));
            }
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    stale.push("run the same command without --check to write it".to_owned());
    Err(Failure::Input(stale))
}
