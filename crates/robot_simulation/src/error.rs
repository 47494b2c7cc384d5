//! The errors of simulations.

use std::fmt;

use robot_model::diagnostic::number;

/// The reason why there is no motion, or no plot of it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Errors in the robot, or functions that it lacks.
    #[error(transparent)]
    Robot(#[from] robot_build::Errors),
    /// Errors in the parameters of the robot.
    #[error(transparent)]
    Program(#[from] robot_codegen::Errors),
    /// Errors in the inputs, with a message for each.
    #[error("{}", .0.join("\n"))]
    Input(Vec<String>),
    /// The integration stopped early.
    #[error("the motion ends at t = {} s: {cause}", number(*.t))]
    Stopped {
        /// The time that was reached, in s.
        t: f64,
        /// The reason.
        cause: Cause,
    },
    /// The plot could not be drawn.
    #[error("the plot cannot be drawn: {0}")]
    Plot(String),
}

impl Error {
    /// The error for a single wrong input.
    pub(crate) fn input(message: impl Into<String>) -> Error {
        Error::Input(vec![message.into()])
    }

    /// Returns `value` if there are no messages, otherwise the error with them.
    pub(crate) fn check<T>(messages: Vec<String>, value: T) -> Result<T, Error> {
        if messages.is_empty() { Ok(value) } else { Err(Error::Input(messages)) }
    }
}

/// The reason why an integration stopped early.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cause {
    /// Steps became too small to advance the time.
    StepSize,
    /// The accelerations have no finite value.
    Accelerations,
    /// The joint torques have no finite value.
    Torques,
    /// No acceleration is consistent with the load-dependent friction that it causes.
    Friction,
    /// Joints come to rest and break away endlessly at the same time.
    Events,
    /// The largest allowed number of steps, which is given, was not enough.
    Steps(usize),
    /// The last steps, whose number is given first, advanced so little that the allowed number would not be enough.
    Slow(usize, usize),
    /// A velocity or an acceleration, such as `qdd1 = 1e300`, is too large for any step.
    Large(String),
    /// The message of another error, such as that of the program or of the robot's mass matrix.
    Other(String),
}

/// The usual reasons for small steps.
const SMALL: &str = "Look for stiff springs, friction with a small `smoothing`, and discontinuous or very large forces";

impl fmt::Display for Cause {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::StepSize => {
                write!(
                    formatter,
                    "the steps became too small for the time to simulate. {SMALL}; otherwise increase the \
                     tolerance, or simulate a shorter time"
                )
            }
            Cause::Accelerations => formatter.write_str(
                "the accelerations are not a finite number for each coordinate: the mass matrix is singular (a \
                 coordinate moves no mass), the motion has diverged, or a torque is too large",
            ),
            Cause::Torques => formatter.write_str(
                "the joint torques are not a finite number for each joint there; look for a division by zero, \
                 the square root of a negative number or an overflow in their expressions",
            ),
            Cause::Friction => formatter.write_str(
                "no acceleration is consistent with the load-dependent friction; check the \
                 coefficients `coulomb` of the joints, or set `smoothing` for their friction",
            ),
            Cause::Events => formatter.write_str(
                "joints with Coulomb friction stick and break away endlessly; look for forces \
                 that jump with a velocity, or set `smoothing` for the friction",
            ),
            Cause::Steps(limit) => {
                let steps = if *limit == 1 { "step" } else { "steps" };
                write!(
                    formatter,
                    "the limit of {limit} {steps} was reached. {SMALL}; otherwise allow more steps, or increase \
                     the tolerance"
                )
            }
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
