//! The subject of a piece of the page: links and parameters by tokens that the page's script matches.
//!
//! `data-is` is on what shows a link or a parameter, `data-of` on what depends on some.

use robot_model::robot::{Body, Drive, Friction, Inertia, Joint, Move};
use robot_model::robot::{Link, Placement, Robot};
use robot_symbolic::Formula;

/// The token of a link, by index.
pub(crate) fn link(index: usize) -> String {
    format!("link-{}", index + 1)
}

/// The token of a parameter, by name.
pub(crate) fn parameter(name: &str) -> String {
    format!("parameter-{name}")
}

/// The links whose values have a parameter in them, by index.
pub(crate) fn links_of_parameter(robot: &Robot, name: &str) -> Vec<usize> {
    let has = |formula: &Formula| formula.symbols().any(|(used, _)| used == name);
    let uses = |(index, link): (usize, &Link)| {
        let frames = robot.frames.iter().filter(|frame| frame.link == Some(index));
        let places = frames.flat_map(|frame| placement(&frame.placement));
        formulas(link).into_iter().chain(places).any(has)
    };
    let links = robot.links.iter().enumerate().filter(|one| uses(*one));
    links.map(|(index, _)| index).collect()
}

/// The formulas of a link.
fn formulas(link: &Link) -> Vec<&Formula> {
    let Joint { axis, ratio, offset, .. } = &link.joint;
    let mut found: Vec<&Formula> = axis.iter().chain([ratio, offset]).collect();
    found.extend(placement(&link.placement));
    for Body { mass, placement: place, inertia, .. } in &link.bodies {
        let Inertia { xx, yy, zz, xy, xz, yz } = inertia;
        found.extend([mass, xx, yy, zz, xy, xz, yz]);
        found.extend(placement(place));
    }
    let Friction {
        viscous,
        coulomb,
        spindle_diameter,
        coulomb_positive,
        coulomb_negative,
        offset,
        smoothing,
    } = &link.friction;
    found.extend([viscous, coulomb, spindle_diameter, coulomb_positive, coulomb_negative, offset]);
    found.extend(smoothing);
    let Drive { armature, rotor_inertia, gear_ratio, .. } = &link.drive;
    found.extend([armature, rotor_inertia, gear_ratio]);
    found
}

fn placement(placement: &Placement) -> Vec<&Formula> {
    placement.0.iter().flat_map(of_move).collect()
}

fn of_move(step: &Move) -> Vec<&Formula> {
    match step {
        Move::Translate(by) => by.iter().collect(),
        Move::Rotate(_, angle) => vec![angle],
    }
}
