//! Words about a robot for tables and lists, so that all outputs use the same ones.

use robot_model::robot::{Axis, JointKind, Move, Placement, Robot};
use robot_symbolic::Formula;

/// The name of the link with this index, which carries something; `base` if there is none.
#[must_use]
pub fn carrier(robot: &Robot, link: Option<usize>) -> &str {
    link.and_then(|index| robot.links.get(index)).map_or("base", |link| &link.name)
}

/// The name of the kind of a joint: `revolute` or `prismatic`.
#[must_use]
pub const fn motion(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "revolute",
        JointKind::Prismatic => "prismatic",
    }
}

/// The name of an axis: `x`, `y` or `z`.
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

/// A vector such as `(0, 0, l3)`; `text` writes each component.
pub fn vector(components: &[Formula; 3], text: impl FnMut(&Formula) -> String) -> String {
    format!("({})", components.each_ref().map(text).join(", "))
}

/// A pose as its moves in order: `to (l4, 0, l3), rotated about z by pi/2`, or `none`. `text` writes each formula.
pub fn pose(placement: &Placement, mut text: impl FnMut(&Formula) -> String) -> String {
    let one = |step: &Move| match step {
        Move::Translate(by) => format!("to {}", vector(by, &mut text)),
        Move::Rotate(about, angle) => format!("rotated about {} by {}", axis(*about), text(angle)),
    };
    let moves: Vec<String> = moves(placement).map(one).collect();
    if moves.is_empty() { "none".to_owned() } else { moves.join(", ") }
}

/// The moves of a placement, except those by zero.
pub fn moves(placement: &Placement) -> impl Iterator<Item = &Move> {
    placement.0.iter().filter(|step| match step {
        Move::Translate(by) => !by.iter().all(is_zero),
        Move::Rotate(_, angle) => !is_zero(angle),
    })
}

/// The sentence about the columns of a table of masses that are omitted because all their values are 0, with a space
/// before it: coordinates of the centers of mass, and entries of the inertia tensors by the
/// names of [`Inertia`](robot_model::robot::Inertia). It is empty if there are none.
#[must_use]
pub fn zeros(coordinates: &[&str], entries: &[&str]) -> String {
    let (products, moments): (Vec<&str>, Vec<&str>) =
        entries.iter().partition(|name| is_product(name));
    let mut subjects = vec![];
    match coordinates {
        [] => {}
        [_, _, _] => subjects.push("the coordinates of the centers of mass".to_owned()),
        [one] => subjects.push(format!("{one} of the centers of mass")),
        some => subjects.push(format!("{} of the centers of mass", some.join(" and "))),
    }
    match moments.as_slice() {
        [] => {}
        [_, _, _] => subjects.push("the moments of inertia".to_owned()),
        [one] => subjects.push(format!("the moment of inertia {one}")),
        some => subjects.push(format!("the moments of inertia {}", some.join(" and "))),
    }
    match products.as_slice() {
        [] => {}
        [_, _, _] => subjects.push("the products of inertia".to_owned()),
        [one] => subjects.push(format!("the product of inertia {one}")),
        some => subjects.push(format!("the products of inertia {}", some.join(" and "))),
    }
    match subjects.split_last() {
        None => String::new(),
        Some((only, [])) => format!(" Columns of zeros are omitted: {only}."),
        Some((last, others)) => {
            format!(" Columns of zeros are omitted: {} and {last}.", others.join(", "))
        }
    }
}

/// Whether an entry of the inertia tensor, such as `xy`, is a product of inertia.
fn is_product(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next() != letters.next()
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_model::robot::Inertia;

    #[test]
    fn zeros_are_named() {
        assert_eq!(zeros(&[], &[]), "");
        assert_eq!(
            zeros(&[], &["xy", "xz", "yz"]),
            " Columns of zeros are omitted: the products of inertia."
        );
        assert_eq!(
            zeros(&["y", "z"], &["xx", "xz", "yz"]),
            " Columns of zeros are omitted: y and z of the centers of mass, the moment of inertia xx and the \
             products of inertia xz and yz."
        );
        let all = zeros(&["x", "y", "z"], &Inertia::NAMES);
        assert_eq!(
            all,
            " Columns of zeros are omitted: the coordinates of the centers of mass, the moments of inertia and the \
             products of inertia."
        );
    }

    #[test]
    fn poses_leave_out_what_moves_nothing() {
        let formula = |text: &str| Formula::parse(text).unwrap();
        let by = |components: [&str; 3]| Move::Translate(components.map(formula));
        let turn = |about, angle: &str| Move::Rotate(about, formula(angle));
        let shown = |moves: Vec<Move>| pose(&Placement(moves), |part| part.text().to_owned());
        let none = [by(["0", "0.0", "0"]), turn(Axis::X, "0")];
        assert_eq!(shown(none.to_vec()), "none");
        let all = [turn(Axis::Z, "pi/2"), none[0].clone(), by(["l4", "0", "-l3"])];
        assert_eq!(shown(all.to_vec()), "rotated about z by pi/2, to (l4, 0, -l3)");
    }
}
