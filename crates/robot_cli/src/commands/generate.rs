//! `generate`: the Rust module of a robot, in a file.

use std::path::PathBuf;

use clap::Args;
use robot_build::{File, generate};

use crate::Terminal;
use crate::commands::package::deliver;
use crate::failure::Failure;
use crate::robot::{CodeArguments, RobotArgument, TrigonometryName};
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic generate robots/trttr1.toml -o src/trttr1.rs
  robot-symbolic generate robots/trttr1.toml -o src/trttr1.rs --check
  robot-symbolic generate robots/ur5.toml --function all --batch --fused
  robot-symbolic generate robots/ur5.toml --bundle dynamics=mass_matrix,bias

The file holds one module, named after the robot in lower case; it calls the crate robot_runtime.
With --check nothing is written: the exit code is 1 where the file is out of date.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    code: CodeArguments,
    /// Where sines and cosines come from
    #[arg(long, value_enum, default_value_t = TrigonometryName::Standard)]
    trigonometry: TrigonometryName,
    /// The path of the runtime in the code
    #[arg(long, value_name = "PATH", default_value = "::robot_runtime")]
    runtime: String,
    /// The file to write; standard output without this
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Compare the file with what would be written
    #[arg(long, requires = "output")]
    check: bool,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let mut options = self.code.options(&self.robot, self.trigonometry)?;
        options.runtime.clone_from(&self.runtime);
        let generated = generate(&self.robot.source()?, &options)?;
        text::warnings(&generated.warnings, terminal)?;
        let Some(path) = &self.output else {
            return Ok(terminal.output.write_all(generated.code.as_bytes())?);
        };
        let file = File { path: String::new(), text: generated.code };
        deliver(path, &[file], self.check, terminal)
    }
}
