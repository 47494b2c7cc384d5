//! `generate`: logs of simulated measurements.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_query::Error;
use robot_query::motion::{Generation, Layout, generate, limits};

use super::{Engine, noise, not_negative, positive};

/// Writes a log of simulated measurements, of any size
///
/// Each episode is a random trajectory (a Fourier series) within the limits of the robot file; torques are those of the
/// model, with the friction of the robot file and normal noise. The same seed and files give the same log.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query generate robots/ur5.toml --rows 1e6 --noise 0.5 -o logs")]
pub(super) struct Arguments {
    /// The robot: a path, or a name in a folder of --robots
    robot: String,
    /// The number of rows, such as 100000 or 1e5
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    rows: u64,
    /// The number of files
    #[arg(long, value_name = "N", default_value_t = 2)]
    files: u64,
    /// Rows per second
    #[arg(long, value_name = "HZ", default_value_t = 1000.0, value_parser = positive, allow_negative_numbers = true)]
    rate: f64,
    /// Rows per episode
    #[arg(long, value_name = "N", default_value = "10000", value_parser = count)]
    episode: u64,
    /// The largest speed of the joints, rad/s or m/s
    #[arg(long, value_name = "SPEED", default_value_t = 2.0, value_parser = positive, allow_negative_numbers = true)]
    speed: f64,
    /// The standard deviations of the torques' noise, N m or N: one, or one for each joint
    #[arg(long, value_delimiter = ',', value_name = "NUMBERS", default_value = "0", value_parser = not_negative, allow_negative_numbers = true)]
    noise: Vec<f64>,
    /// The layout: a list for each variable, or a column for each variable and joint, which is faster to read
    #[arg(long, value_enum, default_value_t = Columns::Lists)]
    layout: Columns,
    /// Numbers of the variables in single precision, in half the space
    #[arg(long)]
    single: bool,
    /// The seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// The folder to write
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
}

#[derive(Clone, Copy, ValueEnum)]
enum Columns {
    Lists,
    Columns,
}

/// A whole number, which may have an exponent.
fn count(text: &str) -> Result<u64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    let is_count = (1.0..9e15).contains(&number) && number.fract() == 0.0;
    if is_count { Ok(number as u64) } else { Err("not a whole number above 0".to_owned()) }
}

impl Arguments {
    pub(super) fn run(&self, engine: &Engine) -> Result<(), Error> {
        let model = engine.robots()?.model(&self.robot)?;
        let how = Generation {
            rows: self.rows,
            files: self.files,
            rate: self.rate,
            episode: self.episode,
            limits: limits(&model, self.speed),
            noise: noise(&self.noise, model.joints())?,
            layout: match self.layout {
                Columns::Lists => Layout::Lists,
                Columns::Columns => Layout::Columns,
            },
            single: self.single,
            seed: self.seed,
        };
        let files = generate(&model, &how, &self.output)?;
        eprintln!("{} rows in {} files", self.rows, files.len());
        Ok(())
    }
}
