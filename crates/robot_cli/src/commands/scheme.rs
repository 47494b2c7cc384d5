//! `scheme`: the kinematic scheme of a robot as a picture.

use clap::Args;
use robot_report::{scheme_pdf, scheme_picture};

use crate::Terminal;
use crate::delivery::OutputArguments;
use crate::failure::Failure;
use crate::robot::RobotArgument;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic scheme robots/trttr1.toml -o trttr1.svg
  robot-symbolic scheme robots/trttr1.toml -o trttr1.pdf

The picture is that of `report`: the robot at q = 0, cylinders for revolute joints, boxes for prismatic ones,
with axes, lengths, frames and names. An SVG file is for browsers and word processors, a file NAME.pdf for LaTeX
and other programs that include figures; the PDF uses the standard fonts that every viewer has, and embeds
none.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let extension = self.output.file().and_then(|path| path.extension());
        let is_pdf = extension.is_some_and(|extension| extension == "pdf");
        let is_known = extension.is_none_or(|extension| extension == "svg") || is_pdf;
        if let Some(path) = self.output.file().filter(|_| !is_known) {
            let [svg, pdf] =
                ["svg", "pdf"].map(|end| robot_build::shown(&path.with_extension(end)));
            let message =
                format!("a scheme is written as SVG or PDF; name the file {svg} or {pdf}");
            return Err(Failure::Usage(vec![message]));
        }
        let output = self.output.open(self.robot.inputs())?;
        let robot = self.robot.read(terminal)?.robot;
        self.robot.check_base_frames(&[], terminal)?;
        let shown = if is_pdf { scheme_pdf(&robot) } else { scheme_picture(&robot) };
        output.deliver(&shown, terminal)
    }
}
