//! Conversion of recordings of other programs to logs.

mod cdr;
mod episodes;
mod lerobot;
mod mcap;

use std::path::Path;

use crate::error::Error;
use crate::robots::Model;

/// The options of a conversion.
#[derive(Clone, Debug, PartialEq)]
pub struct Conversion {
    /// The number of samples over which a cubic is fitted for velocities and accelerations.
    pub window: usize,
    /// The topic of an MCAP file; not needed if only one topic has joint states.
    pub topic: Option<String>,
    /// The names of the robot's joints in the recording, in the robot's order, if they differ from those of the
    /// robot file.
    pub joints: Option<Vec<String>>,
    /// Whether positions are in degrees.
    pub degrees: bool,
    /// The column of torques of a LeRobot data set.
    pub tau: Option<String>,
}

/// The contents of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Converted {
    /// The number of samples in the log.
    pub rows: u64,
    /// The number of episodes.
    pub episodes: u64,
}

/// Converts a recording to a log with the columns `episode`, `t` in seconds since the first sample of the episode,
/// q as recorded, q̇ and q̈ from polynomials over the positions, and the torques if there are any. A path that ends
/// with `.mcap` is a ROS 2 recording of `sensor_msgs/msg/JointState`; a folder is a LeRobot data set of version 3.
///
/// # Errors
///
/// Recordings that cannot be read; joints that the recording lacks; times that do not increase.
pub fn convert(
    model: &Model,
    input: &Path,
    how: &Conversion,
    output: &Path,
) -> Result<Converted, Error> {
    if input.is_dir() {
        return lerobot::convert(model, input, how, output);
    }
    match input.extension().and_then(|ending| ending.to_str()) {
        Some("mcap") => mcap::convert(model, input, how, output),
        _ => Err(Error::file(
            input,
            "it is neither an .mcap file nor the folder of a LeRobot data set",
        )),
    }
}

/// The places of the robot's joints among names.
///
/// # Errors
///
/// A joint that is not among the names.
fn places(
    model: &Model,
    how: &Conversion,
    names: &[String],
    path: &Path,
) -> Result<Vec<usize>, Error> {
    let own =
        || model.robot.coordinates.iter().map(|coordinate| coordinate.joint.clone()).collect();
    let wanted: Vec<String> = how.joints.clone().unwrap_or_else(own);
    if wanted.len() != model.joints() {
        return Err(Error::file(
            path,
            format!(
                "{} joints are given, but {} has {}",
                wanted.len(),
                model.robot.name,
                model.joints()
            ),
        ));
    }
    let place = |wanted: &String| {
        names.iter().position(|name| name == wanted).ok_or_else(|| {
            let there = names.join(", ");
            let reason = format!("it has no joint `{wanted}`; it has {there}; name the robot's in its order with --joints");
            Error::file(path, reason)
        })
    };
    wanted.iter().map(place).collect()
}
