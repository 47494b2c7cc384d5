//! Errors of a mechanism or of the arguments of a call.

use std::fmt;

/// One problem in the data of a mechanism.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {reason}")]
pub struct Fault {
    /// The place of the problem: `gravity`, `link 3`, `frame 0`.
    pub place: String,
    /// The problem and what was expected.
    pub reason: String,
}

/// An argument of a call that has the wrong number of entries.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{argument}` must have {expected} entries, not {found}")]
pub struct Mismatch {
    /// The name of the argument.
    pub argument: &'static str,
    /// The number of entries that it must have.
    pub expected: usize,
    /// The number that it has.
    pub found: usize,
}

/// The reason why a quantity could not be computed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NumericError {
    /// The mechanism is not valid: all its faults.
    #[error("the mechanism is not valid: {}", listed(.0))]
    Mechanism(Vec<Fault>),
    /// The mechanism cannot be evaluated at nominal values, because these parameters have none.
    #[error("no nominal value is given for `{}`", .0.join("`, `"))]
    WithoutValues(Vec<String>),
    /// Arguments have the wrong length: all of them.
    #[error("{}", listed(.0))]
    Lengths(Vec<Mismatch>),
    /// A link or frame with this index does not exist.
    #[error("{kind} {index} does not exist: the mechanism has {count}, counted from 0")]
    NoSuchBody {
        /// `link` or `frame`.
        kind: &'static str,
        /// The requested index.
        index: usize,
        /// The number of links or frames.
        count: usize,
    },
    /// The mass matrix is not positive definite in this configuration, so torques do not determine accelerations.
    /// Possible reasons are a coordinate that moves no mass, an inertia that no body can have, and a number that is not
    /// finite.
    #[error(
        "the mass matrix is not positive definite in this configuration: check that every coordinate \
         moves mass and that inertias and arguments are finite and physically possible"
    )]
    NotPositiveDefinite,
    /// The articulated-body algorithm requires that each coordinate drives only one joint, but this coordinate drives
    /// several. [`Mechanism::forward_dynamics`] has no such restriction.
    ///
    /// [`Mechanism::forward_dynamics`]: super::Mechanism::forward_dynamics
    #[error(
        "coordinate {coordinate} moves several joints, which the articulated-body algorithm \
         does not support: call `forward_dynamics`, which uses the mass matrix"
    )]
    SharedCoordinate {
        /// The index of the coordinate.
        coordinate: usize,
    },
}

fn listed(items: &[impl fmt::Display]) -> String {
    let lines: Vec<String> = items.iter().map(ToString::to_string).collect();
    lines.join("; ")
}

/// Checks the lengths of arguments, which are given as (name, expected, found).
pub(super) fn check_lengths(
    arguments: &[(&'static str, usize, usize)],
) -> Result<(), NumericError> {
    let wrong: Vec<Mismatch> = arguments
        .iter()
        .filter(|(_, expected, found)| expected != found)
        .map(|&(argument, expected, found)| Mismatch { argument, expected, found })
        .collect();
    if wrong.is_empty() { Ok(()) } else { Err(NumericError::Lengths(wrong)) }
}

/// Checks the index of a link or frame.
pub(super) fn check_index(
    kind: &'static str,
    index: usize,
    count: usize,
) -> Result<(), NumericError> {
    if index < count { Ok(()) } else { Err(NumericError::NoSuchBody { kind, index, count }) }
}
