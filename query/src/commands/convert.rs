//! `convert`: recordings of other programs to logs.

use std::path::PathBuf;

use clap::Args;
use robot_query::Error;
use robot_query::convert::{Conversion, convert};

use super::Engine;

/// Converts a recording to a log: joint states of ROS 2 in MCAP, or a LeRobot data set, version 3
///
/// The log has the columns episode, t, q as recorded, qd and qdd from cubics fitted to the positions around each
/// sample (Savitzky and Golay), and tau if there are efforts. Joints are found by name.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query convert robots/ur5.toml recording.mcap -o log.parquet --window 51
  robot-query convert arm.toml dataset -o log.parquet --degrees --joints shoulder,elbow,wrist")]
pub(super) struct Arguments {
    /// The robot: a path, or a name in a folder of --robots
    robot: String,
    /// The .mcap file, or the folder of the data set
    recording: PathBuf,
    /// The number of samples to which a cubic is fitted
    #[arg(long, value_name = "N", default_value_t = 21, value_parser = clap::value_parser!(u32).range(5..))]
    window: u32,
    /// The topic, if several have joint states
    #[arg(long, value_name = "TOPIC")]
    topic: Option<String>,
    /// The names of the robot's joints in the recording, in the robot's order [default: those of the robot file]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    joints: Option<Vec<String>>,
    /// The recording has positions in degrees
    #[arg(long)]
    degrees: bool,
    /// The column of torques of a LeRobot data set, with the entries of observation.state
    #[arg(long, value_name = "COLUMN")]
    tau: Option<String>,
    /// The .parquet file to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Arguments {
    pub(super) fn run(&self, engine: &Engine) -> Result<(), Error> {
        let model = engine.robots()?.model(&self.robot)?;
        let how = Conversion {
            window: self.window as usize,
            topic: self.topic.clone(),
            joints: self.joints.clone(),
            degrees: self.degrees,
            tau: self.tau.clone(),
        };
        let converted = convert(&model, &self.recording, &how, &self.output)?;
        eprintln!("{} rows in {} episodes", converted.rows, converted.episodes);
        Ok(())
    }
}
