//! The numbers that describe links, such as angles, lengths and masses, in a fixed order.

use robot_model::robot::{Body, Drive, Friction, Inertia, Joint, Link, Move, Placement};
use robot_symbolic::Formula;

/// The meaning of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    /// An angle or a component that determines the direction of a joint axis; the form of the equations depends on it.
    Shape,
    /// Any other number, such as a length or a mass.
    Size,
}

/// All numbers that describe the links; the order is the same for links with the same pattern.
pub(super) fn numbers(links: &mut [Link]) -> Vec<(Number, &mut Formula)> {
    links.iter_mut().flat_map(of_link).collect()
}

fn of_link(link: &mut Link) -> Vec<(Number, &mut Formula)> {
    let Link { name: _, parent: _, placement, joint, bodies, friction, drive } = link;
    let Joint { name: _, kind: _, axis, coordinate: _, ratio, offset } = joint;
    let mut found = of_placement(placement, Number::Shape);
    found.extend(axis.iter_mut().chain([ratio, offset]).map(|formula| (Number::Shape, formula)));
    found.extend(bodies.iter_mut().flat_map(of_body));
    let Friction {
        viscous,
        coulomb,
        spindle_diameter,
        coulomb_positive,
        coulomb_negative,
        offset,
        smoothing,
    } = friction;
    let sizes = [viscous, coulomb, spindle_diameter, coulomb_positive, coulomb_negative, offset];
    let Drive { armature, rotor_inertia, gear_ratio, gyroscopic: _ } = drive;
    let drive = [armature, rotor_inertia, gear_ratio];
    let sizes = sizes.into_iter().chain(smoothing).chain(drive);
    found.extend(sizes.map(|formula| (Number::Size, formula)));
    found
}

fn of_body(body: &mut Body) -> Vec<(Number, &mut Formula)> {
    let Body { name: _, mass, placement, inertia } = body;
    let Inertia { xx, yy, zz, xy, xz, yz } = inertia;
    let mut found = of_placement(placement, Number::Size);
    found.extend([mass, xx, yy, zz, xy, xz, yz].map(|formula| (Number::Size, formula)));
    found
}

/// The distances and angles of a placement; the angles are of the kind `angles`.
fn of_placement(placement: &mut Placement, angles: Number) -> Vec<(Number, &mut Formula)> {
    let moves = placement.0.iter_mut().flat_map(|step| match step {
        Move::Translate(by) => by.iter_mut().map(|length| (Number::Size, length)).collect(),
        Move::Rotate(_, angle) => vec![(angles, angle)],
    });
    moves.collect()
}
