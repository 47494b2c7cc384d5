//! `check`: likely mistakes in a log.

use std::path::PathBuf;

use clap::Args;
use robot_query::Error;
use robot_query::log::{Log, check};

use super::inputs::Variables;
use super::{Engine, show};

/// Lists likely mistakes in a log: rows with nulls or NaN, times that repeat or go back, units, files that cannot be
/// read
///
/// The exit code is 1 if anything is found. Each finding names the file, the row group and the row.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query check robots/ur5.toml logs --time t --episode episode")]
pub(super) struct Arguments {
    /// The robot: a path, or a name in a folder of --robots
    robot: String,
    /// The log: Parquet files, or folders of them
    #[arg(required = true)]
    log: Vec<PathBuf>,
    #[command(flatten)]
    variables: Variables,
    /// The column of times, s; without it, times are not checked
    #[arg(long, value_name = "COLUMN")]
    time: Option<String>,
    /// The column of episodes; times start again in each episode
    #[arg(long, value_name = "COLUMN", requires = "time")]
    episode: Option<String>,
}

impl Arguments {
    pub(super) fn run(&self, engine: &Engine) -> Result<(), Error> {
        let model = engine.robots()?.model(&self.robot)?;
        let log = Log::open(&self.log)?;
        let (time, episode) = (self.time.as_deref(), self.episode.as_deref());
        let found = check(&log, &model, &self.variables.names(), time, episode)?;
        show(&found.iter().map(|finding| format!("{finding}\n")).collect::<String>())?;
        if time.is_none() {
            eprintln!("times are not checked; --time names their column");
        }
        match found.len() {
            0 => Ok(()),
            1 => Err(Error::Columns("1 finding".to_owned())),
            count => Err(Error::Columns(format!("{count} findings"))),
        }
    }
}
