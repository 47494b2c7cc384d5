//! The options of equations: which quantities, and in which form.

use robot_dynamics::quantity::Kind;
use robot_symbolic::AngleSums;

use super::letters::VELOCITY_MATRIX;
use super::{Letters, TermOrder};
use crate::layout::Trigonometry;

/// The form of the equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Sums of products with like terms merged, as in the paper.
    #[default]
    Expanded,
    /// As people write equations: with common factors in front of parentheses, complete squares and sums of angles.
    Collected,
    /// Q = M(q) q̈ + C(q, q̇) q̇ + g(q), with a function for each coefficient. Only for joint torques.
    Grouped,
    /// The recursion link by link, with each quantity in terms of earlier ones. Only for joint torques.
    Recursive,
    /// The economical recursion, with names for expressions that occur several times.
    Compact,
    /// Linear in the base parameters. Only for joint torques.
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

    /// The name of the form in the command.
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

/// The options of equations: which quantities, and in which form.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationOptions {
    /// The form.
    pub form: Form,
    /// The quantities, in the order of the equations. The forms [`Form::Grouped`], [`Form::Recursive`] and
    /// [`Form::Regrouped`] always give the joint torques.
    pub kinds: Vec<Kind>,
    /// Whether the joint torques include friction, equations (4) and (5) of the paper.
    pub friction: bool,
    /// The tolerance in rad within which constant angles are rounded to a multiple of π/2; `None` for the value in the
    /// robot file or, if it has none, 10⁻⁹.
    pub snap: Option<f64>,
    /// The notation of sines and cosines.
    pub trigonometry: Trigonometry,
    /// How sines and cosines of sums of angles of parallel joints are written: kept or expanded. If it is `None`, only
    /// [`Form::Expanded`] expands them. [`Form::Recursive`] ignores this option.
    pub angle_sums: Option<AngleSums>,
    /// Whether 2 sin x cos x is written as sin 2x, and 1 − 2 sin² x and 2 cos² x − 1 as cos 2x. This applies to the forms
    /// [`Form::Collected`], [`Form::Grouped`] and [`Form::Regrouped`], unless [`EquationOptions::expand`] is set.
    pub double_angles: bool,
    /// Whether the coefficients in the forms [`Form::Grouped`] and [`Form::Regrouped`] are multiplied out instead of
    /// collected.
    pub expand: bool,
    /// Whether a coefficient in the form [`Form::Grouped`] is written as a multiple of an earlier one, plus a
    /// remainder, if that is at most two thirds as long.
    pub references: bool,
    /// Whether the grouped form has Christoffel symbols instead of the coefficients of products of velocities. It
    /// also has them if the letter of the Coriolis and centrifugal terms is C.
    pub christoffel: bool,
    /// Whether quantities are printed as in the paper: forces and moments in the joints from the last link to the
    /// first, vectors with the number of their link as the lower index too, Q with the index m, terms and factors in
    /// the order in which the paper's relations yield them, masses in front of parentheses, and relations before the
    /// quantities that they yield.
    pub paper: bool,
    /// The order of terms and factors in the form [`Form::Expanded`], for the quantities that it contains.
    pub order: TermOrder,
    /// The letters of joint torques and of the symbols that the grouped form defines.
    pub letters: Letters,
    /// The largest number of significant digits of printed decimals; the text of equations stays exact.
    pub digits: Option<usize>,
    /// Whether long sums of numbers with roots, or with sines of constant angles, become the nearest double. The
    /// equations, also as text, are then exact only to the digits of doubles.
    pub rounds_roots: bool,
}

impl EquationOptions {
    /// Whether the grouped form has Christoffel symbols: if they are requested, or if the letter of the Coriolis and
    /// centrifugal terms is C, which robotics uses for the matrix in C(q, q̇) q̇.
    pub(super) fn has_christoffel(&self) -> bool {
        self.christoffel || self.letters.velocity.as_deref() == Some(VELOCITY_MATRIX)
    }

    /// Whether components of vectors are printed, with the number of a link as their upper index.
    pub(super) fn has_components(&self) -> bool {
        match self.form {
            Form::Recursive => true,
            Form::Grouped | Form::Regrouped => false,
            Form::Expanded | Form::Collected | Form::Compact => {
                self.kinds.iter().any(|kind| *kind != Kind::JointTorque)
            }
        }
    }
}

/// The default options: the joint torques, expanded, without friction.
impl Default for EquationOptions {
    fn default() -> EquationOptions {
        EquationOptions {
            form: Form::Expanded,
            kinds: vec![Kind::JointTorque],
            friction: false,
            snap: None,
            trigonometry: Trigonometry::Named,
            angle_sums: None,
            double_angles: false,
            expand: false,
            references: true,
            christoffel: false,
            paper: false,
            order: TermOrder::default(),
            letters: Letters::default(),
            digits: None,
            rounds_roots: false,
        }
    }
}
