//! `crate`: a whole crate with the functions of a robot.

use std::path::{Path, PathBuf};

use clap::Args;
use robot_build::{File, Staleness, package, staleness, write_if_changed};

use crate::Terminal;
use crate::failure::Failure;
use crate::robot::{CodeArguments, RobotArgument, TrigonometryName};

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic crate robots/trttr1.toml -o trttr1
  cargo test --manifest-path trttr1/Cargo.toml
  robot-symbolic crate robots/trttr1.toml -o trttr1 --check

The crate has no dependencies and needs no standard library; its README has the conventions, the
operation counts and a check value of each function, which its test asserts. With --check nothing is
written: the exit code is 1 where a file is out of date.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    code: CodeArguments,
    /// Where sines and cosines come from; with `standard` the crate needs the standard library
    #[arg(long, value_enum, default_value_t = TrigonometryName::Polynomial)]
    trigonometry: TrigonometryName,
    /// The folder to write
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Compare the files with what would be written
    #[arg(long)]
    check: bool,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let options = self.code.options(&self.robot, self.trigonometry)?;
        let source = self.robot.source()?;
        let files = package::package(&source, &options)?;
        deliver(&self.output, &files, self.check, terminal)
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
