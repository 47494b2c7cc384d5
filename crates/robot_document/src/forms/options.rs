//! Which equations, and how they are put.

use robot_dynamics::quantity::Kind;
use robot_symbolic::AngleSums;

use super::{Letters, TermOrder};
use crate::layout::Trigonometry;

/// The form of the equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Sums of products, like terms merged: the paper's.
    #[default]
    Expanded,
    /// As people write: common factors in front of brackets, complete squares, sums of angles.
    Collected,
    /// Q = M(q) q̈ + C(q, q̇) q̇ + g(q), with a function for each coefficient. Joint torques only.
    Grouped,
    /// The iterations link by link, each quantity by those before it. Joint torques only.
    Recursive,
    /// As the economical recursion has them, expressions that are used again under names.
    Compact,
    /// By base parameters, in which the joint torques are linear. Joint torques only.
    Regrouped,
}

impl Form {
    /// All forms.
    pub const ALL: [Form; 6] = [
        Form::Expanded,
        Form::Collected,
        Form::Grouped,
        Form::Recursive,
        Form::Compact,
        Form::Regrouped,
    ];

    /// The name, as the command has it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Form::Expanded => "expanded",
            Form::Collected => "collected",
            Form::Grouped => "grouped",
            Form::Recursive => "recursive",
            Form::Compact => "compact",
            Form::Regrouped => "regrouped",
        }
    }
}

/// Which equations, and how they are put.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationOptions {
    /// The form.
    pub form: Form,
    /// The quantities, in the order in which they are wanted. The forms [`Form::Grouped`],
    /// [`Form::Recursive`] and [`Form::Regrouped`] are about the joint torques whatever is chosen.
    pub kinds: Vec<Kind>,
    /// Whether the joint torques include friction, equations (4)-(5).
    pub friction: bool,
    /// Constant angles within this many radians of a multiple of π/2 become that multiple; `None`
    /// for what the robot file says, or 10⁻⁹.
    pub snap: Option<f64>,
    /// The notation of sines and cosines.
    pub trigonometry: Trigonometry,
    /// Whether sines and cosines of sums of angles of parallel joints are written, in all forms but
    /// [`Form::Recursive`]; `None` for all but [`Form::Expanded`].
    pub angle_sums: Option<AngleSums>,
    /// Whether the coefficients of the forms [`Form::Grouped`] and [`Form::Regrouped`] are multiplied out rather
    /// than collected.
    pub expand: bool,
    /// Whether a coefficient of the form [`Form::Grouped`] is written as a multiple of an earlier one, plus a rest, if
    /// that is at most two thirds as long.
    pub references: bool,
    /// Whether the grouped form has Christoffel symbols in place of the coefficients of velocities.
    pub christoffel: bool,
    /// Whether quantities are in the order, the shape and under the signs of the paper: forces and moments in the joints
    /// from the last link to the first, vectors with the number of their link below as well, Q with the index m, terms and
    /// factors as the paper's relations yield them, masses in front of brackets, relations before what they yield.
    pub paper: bool,
    /// The order of terms and factors in the form [`Form::Expanded`], for the quantities that it has.
    pub order: TermOrder,
    /// The letters of joint torques and of what the grouped form defines.
    pub letters: Letters,
    /// The most significant digits of decimals, but in the text of equations, which is exact.
    pub digits: Option<usize>,
}

/// The joint torques, expanded, without friction.
impl Default for EquationOptions {
    fn default() -> EquationOptions {
        EquationOptions {
            form: Form::Expanded,
            kinds: vec![Kind::GeneralizedForce],
            friction: false,
            snap: None,
            trigonometry: Trigonometry::Named,
            angle_sums: None,
            expand: false,
            references: true,
            christoffel: false,
            paper: false,
            order: TermOrder::default(),
            letters: Letters::default(),
            digits: None,
        }
    }
}
