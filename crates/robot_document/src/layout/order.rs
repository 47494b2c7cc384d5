//! The order of factors, by which terms are ordered too.
//!
//! The factors of a term come in this order: roots of numbers, components of wrenches, masses, inertias and the
//! combinations of them that a form defines, other parameters, sums in parentheses, sines and cosines, other symbols
//! that a form defines, and last coordinates, velocities and accelerations.
//! Within each group they are ordered by number; sines and cosines, in sums that are collected and in the compact form,
//! by the symbols in their angles, the sine of an angle before its cosine. Terms are ordered by their factors, higher
//! powers of the first factor first: by `compare_powers` of `robot_symbolic`, and by `forms/arranged.rs` in the compact
//! form.

use robot_model::robot::{Parameter, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::print::default_rank;
use robot_symbolic::{Expr, Function, View};
use rustc_hash::FxHashMap;

/// The rank of a factor: its group, its subgroup and its number.
pub type Rank = (u8, u8, usize);

/// The rank of roots of numbers, which stand beside the coefficient of a term: √2/2 F.
const ROOTS: Rank = (0, 0, 0);

/// The rank of sums in parentheses, which stand after parameters and before sines and cosines.
pub(crate) const BRACKETS: Rank = (1, 0, 0);

/// The order of the factors in the equations of a robot.
#[derive(Clone, Debug)]
pub struct Order<'r> {
    parameters: FxHashMap<&'r str, Rank>,
    defined: FxHashMap<String, Rank>,
}

impl<'r> Order<'r> {
    /// The order for the symbols of a robot; parameters are in the order of the robot file.
    #[must_use]
    pub fn new(robot: &'r Robot) -> Order<'r> {
        let rank = |(place, parameter): (usize, &'r Parameter)| {
            (parameter.name.as_str(), (0, 1 + u8::from(!is_inertial(parameter)), place))
        };
        let parameters = robot.parameters.iter().enumerate().map(rank).collect();
        Order { parameters, defined: FxHashMap::default() }
    }

    /// Adds a symbol that a form defines.
    pub fn define(&mut self, name: &str) {
        let rank = (8, 0, self.defined.len());
        self.defined.insert(name.to_owned(), rank);
    }

    /// Adds a combination of masses and inertias that a form defines.
    pub fn define_parameter(&mut self, name: &str) {
        let rank = (0, 1, self.defined.len());
        self.defined.insert(name.to_owned(), rank);
    }

    /// Whether a symbol is a component of a wrench: not a parameter, not a joint's variable and not defined by a form.
    #[must_use]
    pub(crate) fn is_wrench(&self, atom: Expr<'_>) -> bool {
        let View::Symbol(symbol) = atom.view() else { return false };
        let name = atom.graph().symbol_name(symbol);
        !self.parameters.contains_key(name.as_str())
            && !self.defined.contains_key(&name)
            && motion(&name).is_none()
    }

    /// Whether a symbol is a joint position, velocity or acceleration.
    #[must_use]
    pub(crate) fn is_motion(&self, atom: Expr<'_>) -> bool {
        let View::Symbol(symbol) = atom.view() else { return false };
        is_motion(&atom.graph().symbol_name(symbol))
    }

    /// How often a joint position is differentiated with respect to time: 1 for a velocity, 2 for an acceleration,
    /// otherwise 0.
    #[must_use]
    pub(crate) fn derivative_order(&self, atom: Expr<'_>) -> u32 {
        let View::Symbol(symbol) = atom.view() else { return 0 };
        match motion(&atom.graph().symbol_name(symbol)) {
            Some((JointVariable::Velocity, _)) => 1,
            Some((JointVariable::Acceleration, _)) => 2,
            _ => 0,
        }
    }

    /// The rank of a factor.
    #[must_use]
    pub fn rank(&self, atom: Expr<'_>) -> Rank {
        let View::Symbol(symbol) = atom.view() else {
            return if is_root_of_number(atom) { ROOTS } else { (2 * default_rank(atom), 0, 0) };
        };
        let name = atom.graph().symbol_name(symbol);
        if let Some(rank) = self.parameters.get(name.as_str()) {
            return *rank;
        }
        if let Some(rank) = self.defined.get(&name) {
            return *rank;
        }
        // Motions come last in a term, wrenches come first.
        if let Some((variable, index)) = motion(&name) {
            return (9, variable as u8, index + 1);
        }
        let digits = name.trim_start_matches(|letter: char| !letter.is_ascii_digit());
        (0, 1, digits.parse().unwrap_or_default())
    }
}

/// Whether a parameter is a mass or an inertia, according to its unit.
fn is_inertial(parameter: &Parameter) -> bool {
    let dimension = parameter.unit.as_ref().map(|unit| unit.dimension);
    dimension.is_some_and(|dimension| dimension.mass == 1 && dimension.time == 0)
}

/// Whether a name is that of a joint position, velocity or acceleration: `q1`, `qd2`, `qdd3`.
pub(crate) fn is_motion(name: &str) -> bool {
    motion(name).is_some()
}

/// The variable and index of the name of a joint position, velocity or acceleration.
fn motion(name: &str) -> Option<(JointVariable, usize)> {
    JointVariable::parse(name).filter(|(variable, _)| JointVariable::MOTION.contains(variable))
}

/// Whether a name is that of a joint velocity or acceleration.
pub(crate) fn is_rate(name: &str) -> bool {
    motion(name).is_some_and(|(variable, _)| variable != JointVariable::Position)
}

/// Whether an expression is the root of a number, as in the sines of π/4 and π/6.
pub(crate) fn is_root_of_number(expr: Expr<'_>) -> bool {
    matches!(expr.view(), View::Call(Function::Sqrt, of) if of.as_number().is_some())
}
