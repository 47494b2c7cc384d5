//! `compare`: comparison of published equations with derived ones.

mod blocks;
mod show;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::RobotFile;
use robot_check::errata::{Comparison, Notation, Options, compare};
use robot_model::robot::Robot;

use crate::Terminal;
use crate::delivery::answered;
use crate::failure::Failure;
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::screen::is_colored;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic compare robots/trttr1.toml docs/trttr1.printed
  robot-symbolic compare robots/trttr1.toml docs/trttr1.printed --format markdown
  robot-symbolic compare robots/trttr1.toml docs/trttr1.printed --notation text --format json

PRINTED contains equations `(number) quantity = terms`; the quantities a_c1.x, F1.x, M_c1.x, F_l1.x, M_l1.x and
Q1 are those that `equations` prints. In text, each equation starts on a new line and continues on indented
lines; `#` begins a comment; a product is `*` and a minus is `-` (not `·` and `−`). In LaTeX, each is on a line or
in a display (equation, align, \\[ \\] …), and everything else is prose; a vector may be a column. Write sines and
cosines as \\sin q_2, s_2 or sq_2. Terms may be in any order and in parentheses. Friction is left out, and so are tip
wrenches that no equation contains.

Exit codes: 0 if nothing differs; 1 if terms differ; 2 if a file or the command line is wrong.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// The published equations
    printed: PathBuf,
    /// Notation of the equations [default: latex if the file ends in .tex or contains a backslash, $, _{ or ^{, else
    /// text]
    #[arg(long, value_enum)]
    notation: Option<NotationName>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum NotationName {
    Text,
    #[value(alias = "tex")]
    Latex,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
    Markdown,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let (robot, comparison) = self.comparison(terminal).map_err(Failure::refused)?;
        let shown = match self.format {
            Format::Text if is_colored(terminal.screen) => show::colored(&show::text(&comparison)),
            Format::Text => show::text(&comparison),
            Format::Json => show::json(&comparison),
            Format::Markdown => blocks::markdown(&comparison, &robot),
        };
        answered(&shown, terminal)?;
        if comparison.differences.is_empty() { Ok(()) } else { Err(Failure::Shown) }
    }

    fn comparison(&self, terminal: &mut Terminal<'_>) -> Result<(Robot, Comparison), Failure> {
        // Published equations are compared with those that `equations` prints.
        let robot = self.robot.printed(terminal)?;
        self.robot.check_base_frames(&[], terminal)?;
        let has = |extension: &str| self.printed.extension().is_some_and(|own| own == extension);
        if has("typ") {
            let name = self.printed.display();
            let message =
                format!("{name}: Typst is not read; print equations with --format latex or text");
            return Err(Failure::Usage(vec![message]));
        }
        let printed = RobotFile::read(&self.printed)?.source;
        let notation = match self.notation {
            Some(NotationName::Text) => Some(Notation::Text),
            Some(NotationName::Latex) => Some(Notation::Latex),
            None => has("tex").then_some(Notation::Latex),
        };
        let options = Options { notation, snap: self.robot.snap() };
        let found = watched("comparing", terminal, || compare(&robot, &printed, &options));
        let found = found.map_err(|errors| Failure::Robot(errors.into()))?;
        Ok((robot, found))
    }
}
