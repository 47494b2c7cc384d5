//! Errors of making a page.

use robot_build::Errors;
use robot_model::robot::Robot;

/// The most coordinates of a robot on a page: its matrices and forms are no longer for reading beyond, and
/// what is counted takes the derivation of its code a dozen times.
pub const MOST_COORDINATES: usize = 24;

/// Why there is no page about a robot.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Everything that is wrong with the file or the options.
    #[error(transparent)]
    Robot(#[from] Errors),
    /// A robot too long for a page.
    #[error(
        "{name} has {count} coordinates, but a page covers at most {MOST_COORDINATES}; print the \
         equations (form `recursive`) and count the operations separately"
    )]
    TooManyCoordinates {
        /// The robot.
        name: String,
        /// Its coordinates.
        count: usize,
    },
}

/// Whether a page about the robot can be made, before the work for it is.
///
/// # Errors
///
/// More than [`MOST_COORDINATES`].
pub fn presentable(robot: &Robot) -> Result<(), Error> {
    let count = robot.degrees_of_freedom();
    if count > MOST_COORDINATES {
        return Err(Error::TooManyCoordinates { name: robot.name.clone(), count });
    }
    Ok(())
}
