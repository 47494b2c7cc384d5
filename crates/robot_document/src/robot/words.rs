//! Words about a robot in tables and lists, the same everywhere.

use robot_model::robot::{Axis, JointKind, Move, Placement, Robot};
use robot_symbolic::Formula;

/// The name of the link that carries something, by its index; `base` if no link does.
#[must_use]
pub fn carrier(robot: &Robot, link: Option<usize>) -> &str {
    link.and_then(|index| robot.links.get(index)).map_or("base", |link| &link.name)
}

/// The kind of a joint: `revolute` or `prismatic`.
#[must_use]
pub const fn motion(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "revolute",
        JointKind::Prismatic => "prismatic",
    }
}

/// `x`, `y` or `z`.
#[must_use]
pub const fn axis(axis: Axis) -> char {
    match axis {
        Axis::X => 'x',
        Axis::Y => 'y',
        Axis::Z => 'z',
    }
}

/// Whether a formula is the number 0.
#[must_use]
pub fn is_zero(formula: &Formula) -> bool {
    formula.as_number().is_some_and(|number| number.is_zero())
}

/// The moves of a placement but for those by nothing.
pub fn moves(placement: &Placement) -> impl Iterator<Item = &Move> {
    placement.0.iter().filter(|step| match step {
        Move::Translate(by) => !by.iter().all(is_zero),
        Move::Rotate(_, angle) => !is_zero(angle),
    })
}
