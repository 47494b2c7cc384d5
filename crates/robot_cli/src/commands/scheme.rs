//! `scheme`: the kinematic scheme of a robot as a picture.

use std::path::PathBuf;

use clap::Args;
use robot_report::scheme_picture;

use crate::Terminal;
use crate::delivery::OutputArguments;
use crate::failure::Failure;
use crate::robot::RobotArgument;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic scheme robots/trttr1.toml -o trttr1.svg

The picture is that of `report`: the robot at q = 0, cylinders for revolute joints, boxes for prismatic ones, with
axes, lengths, frames and names. It is an SVG file, which browsers show and word processors take; for LaTeX, make
a PDF file of it, with `rsvg-convert -f pdf -o trttr1.pdf trttr1.svg` or with Inkscape.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let is_svg = |path: &PathBuf| path.extension().is_none_or(|extension| extension == "svg");
        if let Some(path) = self.output.file().filter(|path| !is_svg(path)) {
            let name = robot_build::shown(&path.with_extension("svg"));
            let message = format!("a scheme is written as SVG only; name the file {name}");
            return Err(Failure::Usage(vec![message]));
        }
        let output = self.output.open(self.robot.inputs())?;
        let robot = self.robot.read(terminal)?.robot;
        self.robot.check_base_frames(&[], terminal)?;
        output.deliver(&scheme_picture(&robot), terminal)
    }
}
