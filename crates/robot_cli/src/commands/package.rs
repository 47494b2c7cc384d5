//! `crate`: a whole crate with the functions of a robot, or a package in another language.

use std::path::PathBuf;

use clap::Args;
use robot_build::languages::package_of;

use crate::Terminal;
use crate::delivery::{ForceArgument, deliver_folder};
use crate::derived::programs;
use crate::failure::Failure;
use crate::progress::watched;
use crate::robot::{CodeArguments, LanguageArgument, RobotArgument};

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic crate robots/trttr1.toml -o trttr1
  cargo test --manifest-path trttr1/Cargo.toml
  robot-symbolic crate robots/trttr1.toml -o trttr1 --check

The crate has no dependencies and does not need the standard library; its README contains the conventions, the
operation counts and a check value for each function, which the crate's test asserts. --check writes nothing,
and the exit code is 1 if a file is out of date.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    code: CodeArguments,
    #[command(flatten)]
    language: LanguageArgument,
    /// The folder to write
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Compare the files with what would be written
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    force: ForceArgument,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let source = self.robot.source()?;
        let robot = self.robot.read(terminal)?;
        let language = self.language.language;
        let options = self.code.options(&self.robot, &robot, language, terminal)?;
        let programs = programs(&source, &options, terminal)?;
        let files =
            watched("generating", terminal, || package_of(&programs, &source, &options, language))?;
        let writer = self.force.writer(self.robot.inputs(), !self.check)?;
        deliver_folder(&self.output, &files, self.check, &writer, terminal)
    }
}
