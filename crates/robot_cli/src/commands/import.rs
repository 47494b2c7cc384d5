//! `import`: conversion of a URDF file to a robot file.

use std::path::PathBuf;

use clap::Args;
use robot_build::{Errors, Ownership, RobotFile, robot_inputs};
use robot_model::description::{self, Format, Options};

use crate::Terminal;
use crate::delivery::{Kind, OutputArguments};
use crate::failure::Failure;
use crate::reading::ReadingArguments;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic import arm.urdf -o robots/arm.toml

The robot file keeps the names and values of the source; every choice is reported. Checks that are waived here
are also waived in the robot file, so the other commands accept it. A robot file is meant to be edited: an
existing file with other content is replaced only with --force.")]
pub(crate) struct Arguments {
    /// The URDF file
    file: PathBuf,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    reading: ReadingArguments,
    /// Import the damping and friction of `<dynamics>` as joint friction
    #[arg(long)]
    friction: bool,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let kind = Kind { doc: "a robot file is TOML", ending: "toml" };
        let output = self.output.open_kind(kind, Ownership::Edited, robot_inputs(&self.file))?;
        let source = RobotFile::read(&self.file)?.source;
        let options = Options { friction: self.friction, ..self.reading.options().reading() };
        let import =
            description::import(&source.name, &source.text, &options).map_err(Errors::from)?;
        if import.described.format == Format::Toml {
            return Err(Failure::input(format!("{}: this is already a robot file", source.name)));
        }
        text::warnings(&import.described.warnings, terminal)?;
        for group in import.described.choices.groups() {
            writeln!(terminal.errors, "note: {}", group.line(&source))?;
        }
        if self.friction && !import.described.robot.has_friction() {
            let name = &source.name;
            writeln!(
                terminal.errors,
                "note: {name}: --friction has no effect, because no joint has `<dynamics>` with damping or friction"
            )?;
        }
        output.deliver(&import.toml, terminal)
    }
}
