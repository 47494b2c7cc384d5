//! Errors of simulation.

use std::fmt;

use robot_model::diagnostic::number;

/// Why there is no motion, or no plot of one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The robot, or a function that it lacks.
    #[error(transparent)]
    Robot(#[from] robot_build::Errors),
    /// Parameters of the robot.
    #[error(transparent)]
    Program(#[from] robot_codegen::Errors),
    /// Inputs: everything that is wrong with them, a message each.
    #[error("{}", .0.join("\n"))]
    Input(Vec<String>),
    /// The integration ended before its time.
    #[error("the motion ends at t = {} s: {cause}", number(*.t))]
    Stopped {
        /// The time that was reached, s.
        t: f64,
        /// Why it was the last.
        cause: Cause,
    },
    /// The plot could not be drawn.
    #[error("the plot cannot be drawn: {0}")]
    Plot(String),
}

impl Error {
    /// One wrong input.
    pub(crate) fn input(message: impl Into<String>) -> Error {
        Error::Input(vec![message.into()])
    }

    /// `value` if there are no messages.
    pub(crate) fn check<T>(messages: Vec<String>, value: T) -> Result<T, Error> {
        if messages.is_empty() { Ok(value) } else { Err(Error::Input(messages)) }
    }
}

/// Why an integration ended before its time.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cause {
    /// Steps became too small to advance the time.
    StepSize,
    /// The accelerations have no finite value.
    Accelerations,
    /// The joint torques have no finite value.
    Torques,
    /// No acceleration agrees with the dry friction that it causes by the load.
    Friction,
    /// Joints come to rest and break away again and again at one time.
    Events,
    /// So many steps were not enough.
    Steps(usize),
    /// So many steps, the first number, advanced so little that the second would not be enough.
    Slow(usize, usize),
    /// A velocity or an acceleration, such as `qdd1 = 1e300`, that no step can follow.
    Large(String),
    /// The error of the interpreter or of the robot's mass matrix.
    Other(String),
}

/// The usual reasons for small steps.
const SMALL: &str =
    "Look for stiff springs, friction with a small `smoothing` and discontinuous forces";

impl fmt::Display for Cause {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::StepSize => {
                write!(formatter, "the steps became too small. {SMALL}, or increase the tolerance")
            }
            Cause::Accelerations => formatter.write_str(
                "the accelerations do not have finite values. Either the mass matrix is singular \
                 (a coordinate moves no mass) or the motion has diverged",
            ),
            Cause::Torques => formatter.write_str(
                "the joint torques do not have finite values there; look for a division by zero \
                 or the square root of a negative number in their expressions",
            ),
            Cause::Friction => formatter.write_str(
                "no acceleration is consistent with its load-dependent friction; check the \
                 coefficients `coulomb` of the joints, or set `smoothing` for their friction",
            ),
            Cause::Events => formatter.write_str(
                "joints with Coulomb friction stick and break away endlessly; look for forces \
                 that jump with a velocity, or set `smoothing` for the friction",
            ),
            Cause::Steps(limit) => write!(
                formatter,
                "{limit} steps were not enough. {SMALL}; otherwise allow more steps, or increase \
                 the tolerance"
            ),
            Cause::Slow(steps, limit) => write!(
                formatter,
                "the last {steps} steps advanced so little that {limit} would not be enough. \
                 {SMALL}; otherwise allow more steps, or increase the tolerance"
            ),
            Cause::Large(what) => write!(
                formatter,
                "{what} is too large for a step of any length; check the initial velocities, the \
                 joint torques and the masses"
            ),
            Cause::Other(words) => formatter.write_str(words),
        }
    }
}
