//! `diff`: the differences between two robots.

pub(crate) mod show;

use std::path::{Path, PathBuf};

use clap::Args;
use robot_build::{Options as CodeOptions, RobotFile};
use robot_check::difference::{Difference, Options, difference};

use crate::Terminal;
use crate::delivery::answered;
use crate::failure::Failure;
use crate::format::Format;
use crate::plan::pinned_or_searched;
use crate::progress::watched;
use crate::reading::ReadingArguments;
use crate::screen::is_colored;
use crate::values::whole;

/// The most states at which torques are compared. They take about a minute for a robot with many joints.
const MOST_STATES: u32 = 100_000;

/// The number of terms of an equation that are shown by default.
const TERMS: usize = 20;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic diff robots/planar_2r.toml robots/scara.toml
  robot-symbolic diff robots/planar_2r.toml robots/scara.toml --format json

Links, joints, frames and parameters are matched by name, joint torques by the number of the coordinate, terms
by their symbols. Robot names, descriptions, comments and what does not concern the motion
([code], budgets, LaTeX of symbols) are ignored. Terms are those of the joint torques without friction;
torques are compared at the nominal parameters, with friction and without wrenches at the tips. If a part
cannot be compared, the reason is shown. Text rounds numbers of more than 24 characters.

Exit codes: 0 if nothing differs; 1 if something differs; 2 if a file or the command line is wrong.")]
pub(crate) struct Arguments {
    /// The first robot file
    a: PathBuf,
    /// The second robot file
    b: PathBuf,
    #[command(flatten)]
    reading: ReadingArguments,
    /// Seed of the random states at which torques are compared
    #[arg(long, default_value_t = 1, value_parser = whole(0_u64..), allow_negative_numbers = true)]
    seed: u64,
    /// Number of random states, at most 100000
    #[arg(long, default_value_t = 1000, value_parser = whole(1..=MOST_STATES), allow_negative_numbers = true)]
    states: u32,
    /// Maximum number of terms shown per equation in text [default: 20]
    #[arg(long, value_parser = whole(0_usize..), allow_negative_numbers = true)]
    terms: Option<usize>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        if self.terms.is_some() && matches!(self.format, Format::Json) {
            let message = "--terms has no effect in JSON, which has all terms; leave it out";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let found = self.difference(terminal).map_err(Failure::refused)?;
        let shown = match self.format {
            Format::Text => {
                let text = show::text(&found, self.terms.unwrap_or(TERMS));
                if is_colored(terminal.screen) { show::colored(&text) } else { text }
            }
            Format::Json => show::json(&found),
        };
        answered(&shown, terminal)?;
        if found.is_none() { Ok(()) } else { Err(Failure::Shown) }
    }

    fn difference(&self, terminal: &mut Terminal<'_>) -> Result<Difference, Failure> {
        let (a, of_a) = one(&self.a, self.reading, terminal)?;
        let (b, of_b) = one(&self.b, self.reading, terminal)?;
        let options = Options { code: [of_a, of_b], seed: self.seed, states: self.states as usize };
        Ok(watched("comparing", terminal, || difference(&a, &b, &options)))
    }
}

/// Reads a robot; returns it with the options for its code, which have the pinned plan or the cheapest one.
fn one(
    path: &Path,
    reading: ReadingArguments,
    terminal: &mut Terminal<'_>,
) -> Result<(robot_model::robot::Robot, CodeOptions), Failure> {
    let file = RobotFile::read(path)?;
    let described = reading.read(&file.source, terminal)?;
    let options = CodeOptions { search: true, ..reading.options() };
    Ok((described.robot, pinned_or_searched(&file, options, terminal)?))
}
