//! The reasons why equations cannot be printed.

use robot_model::snap::InvalidSnap;
use robot_symbolic::print::TooLarge;

use crate::latex::ReadError;

/// The reason why equations cannot be printed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The expanded form has more terms or products than anybody could read.
    #[error(
        "{reason}. Products that are multiplied out, as in the forms `expanded` and `collected`, are \
         too long to read for this robot; choose the form {forms}"
    )]
    TooLong {
        /// The limit that the form exceeds.
        reason: String,
        /// The forms that the robot has, as the end of a sentence.
        forms: &'static str,
    },
    /// The grouped form has more coefficients than anybody could read.
    #[error(
        "the grouped form has coefficients for each pair of coordinates, and this robot has \
         {coordinates} coordinates, more than {limit}; choose the form `recursive` or `compact`"
    )]
    TooMany {
        /// The number of coordinates of the robot.
        coordinates: usize,
        /// The largest number of coordinates for which the form is written.
        limit: usize,
    },
    /// The derivation of the equations needs more expressions than anybody could read.
    #[error(
        "the equations need more than {limit} expressions; the forms `recursive` and `compact` \
         need the fewest, and if angles between frames are nearly multiples of π/2, snapping them \
         (the option `snap`) makes the equations shorter"
    )]
    TooManyExpressions {
        /// The largest number of expressions that are derived.
        limit: usize,
    },
    /// The tolerance for snapping angles is invalid.
    #[error(transparent)]
    Snap(#[from] InvalidSnap),
    /// The base parameters cannot be found.
    #[error("the base parameters cannot be computed: {reason}")]
    NoBase {
        /// The reason.
        reason: &'static str,
    },
    /// The formulas of the base parameters cannot be written out.
    #[error("the base parameters cannot be printed: {reason}")]
    Base {
        /// The reason.
        reason: String,
    },
    /// An expression is too large to be written out.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// A symbol of the robot has the same name as a symbol that the form defines.
    #[error(
        "this form of the equations defines a symbol `{name}` of its own; rename the symbol in \
         the robot file, or choose another form"
    )]
    Taken {
        /// The name.
        name: String,
    },
    /// A symbol of the robot has the name of a vector or matrix.
    #[error(
        "these equations name a vector `{name}`, like a symbol of this robot; rename the symbol in \
         the robot file, or, without a style, print the equations with components"
    )]
    TakenArray {
        /// The name.
        name: String,
    },
    /// A symbol of the robot has the name or the printed form of a standard or base parameter.
    #[error(
        "`{name}` would be both a symbol of the robot and one of the base parameters or of the parameters \
        from which they are made; rename the symbol in the robot file"
    )]
    TakenParameter {
        /// The name of the parameter.
        name: String,
    },
    /// A letter that was chosen for the torques, the mass matrix, the Coriolis and centrifugal terms or the gravity
    /// terms stands for something else in the equations.
    #[error(
        "the letter {letter} already stands for {owner}; choose another letter for the joint torques or the matrices"
    )]
    TakenLetter {
        /// The letter.
        letter: String,
        /// What it stands for.
        owner: &'static str,
    },
    /// Two symbols are printed in the same way.
    #[error(
        "`{name}` and `{other}` are both printed as {latex}; give one of them another `latex` in \
         the robot file"
    )]
    Alike {
        /// One of the symbols.
        name: String,
        /// The other symbol.
        other: String,
        /// Their printed form.
        latex: String,
    },
    /// A symbol is printed like the short form of a sine or cosine.
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
    /// A part of an equation that cannot be broken is wider than the space beside the left side and the number.
    #[error(
        "a part of the equation of `{name}` that cannot be broken is {needed} cm wide, but beside \
         the left side and the number of the equation, a line has only {available} cm; choose \
         wider lines, or set shorter names for the parameters with `latex` in the robot file"
    )]
    Narrow {
        /// The left side of the equation, as text.
        name: String,
        /// The width of the part.
        needed: Centimeters,
        /// The width of a line without the left side, the indent and the number.
        available: Centimeters,
    },
    /// Parts of an expression are nested too deeply.
    #[error("an expression has parentheses, fractions and indices nested more than {limit} deep")]
    TooDeep {
        /// The largest depth that is laid out.
        limit: usize,
    },
    /// The LaTeX for a symbol cannot be laid out. This does not happen for LaTeX that a robot file is allowed to
    /// contain.
    #[error("the LaTeX for a symbol cannot be laid out: {0}")]
    Symbol(#[from] ReadError),
}

/// A length in tenths of a millimeter; integers make errors comparable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Centimeters(u32);

impl Centimeters {
    /// Converts a length in printer's points, 72.27 per inch, and rounds it up.
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
