//! Why equations cannot be printed.

use robot_model::snap::InvalidSnap;
use robot_symbolic::print::TooLarge;

use crate::latex::ReadError;

/// Why equations cannot be printed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An expanded form of more terms or products than anybody reads.
    #[error(
        "{reason}. The expanded form of this robot is too long to read; choose the form \
         `grouped`, `recursive` or `compact`"
    )]
    TooLong {
        /// The limit that it exceeds.
        reason: String,
    },
    /// More coefficients than anybody reads.
    #[error(
        "the grouped form has coefficients for each pair of joints, and this robot has \
         {coordinates} coordinates, more than {limit}; choose the form `recursive` or `compact`"
    )]
    TooMany {
        /// The robot's coordinates.
        coordinates: usize,
        /// The most that there are coefficients for.
        limit: usize,
    },
    /// Too many expressions on the way to the equations for anybody to read.
    #[error(
        "the equations need more than {limit} expressions; the forms `recursive` and `compact` \
         need the fewest, and snapping angles that are nearly multiples of π/2 (the option \
         `snap`) makes them shorter"
    )]
    TooManyExpressions {
        /// The most that are derived.
        limit: usize,
    },
    /// An invalid snapping tolerance.
    #[error(transparent)]
    Snap(#[from] InvalidSnap),
    /// Base parameters that cannot be found or written out.
    #[error("the base parameters cannot be computed: {reason}")]
    Base {
        /// Why.
        reason: String,
    },
    /// An expression that cannot be written out.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// A symbol of the robot that has the name of one that a form defines.
    #[error(
        "this form of the equations defines a symbol `{name}` of its own; rename the symbol in \
         the robot file, or choose another form"
    )]
    Taken {
        /// The name.
        name: String,
    },
    /// Two symbols that print alike.
    #[error(
        "`{name}` and `{other}` are both printed as {latex}; give one of them another `latex` in \
         the robot file"
    )]
    Alike {
        /// A symbol.
        name: String,
        /// The other one.
        other: String,
        /// Their printed form.
        latex: String,
    },
    /// A symbol that prints like the short form of a sine or cosine.
    #[error(
        "`{name}` is printed as {latex}, which would read as a sine or cosine; print sines and \
         cosines by name, or give the symbol another `latex` in the robot file"
    )]
    LikeSine {
        /// The symbol.
        name: String,
        /// Its printed form.
        latex: String,
    },
    /// A piece that is wider than a line.
    #[error(
        "part of the equation of `{name}` is {needed} cm wide and does not fit a line of \
         {available} cm; choose another form or wider lines, or set shorter names with `latex` \
         in the robot file"
    )]
    Narrow {
        /// The left side in text.
        name: String,
        /// The width that the piece needs.
        needed: Centimeters,
        /// The width available.
        available: Centimeters,
    },
    /// Parts within parts within parts.
    #[error("an expression has parentheses, fractions and indices nested more than {limit} deep")]
    TooDeep {
        /// The most that are laid out.
        limit: usize,
    },
    /// LaTeX of a symbol that cannot be laid out; what a robot file may have can be.
    #[error("the LaTeX for a symbol cannot be laid out: {0}")]
    Symbol(#[from] ReadError),
}

/// A length in tenths of a millimeter, so that errors can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Centimeters(u32);

impl Centimeters {
    /// A length in printer's points, 72.27 to an inch.
    #[must_use]
    pub fn from_points(points: f64) -> Centimeters {
        Centimeters((points * 254.0 / 72.27).ceil() as u32)
    }
}

impl std::fmt::Display for Centimeters {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{:.1}", f64::from(self.0) / 100.0)
    }
}
