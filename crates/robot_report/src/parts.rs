//! The subjects of pieces of the page: tokens of links and parameters, which the page's script matches.
//!
//! `data-is` marks an element that shows a link or a parameter, `data-of` one that depends on some.

use robot_model::robot::{Body, Drive, Inertia, Joint, Move};
use robot_model::robot::{Link, Placement, Robot};
use robot_symbolic::Formula;

/// The token of a link, given by its index.
pub(crate) fn link(index: usize) -> String {
    format!("link-{}", index + 1)
}

/// The token of a parameter, given by its name.
pub(crate) fn parameter(name: &str) -> String {
    format!("parameter-{name}")
}

/// The indices of the links whose values contain a parameter.
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

/// The formulas in the description of a link.
fn formulas(link: &Link) -> Vec<&Formula> {
    let Joint { axis, ratio, offset, .. } = &link.joint;
    let mut found: Vec<&Formula> = axis.iter().chain([ratio, offset]).collect();
    found.extend(placement(&link.placement));
    for Body { mass, placement: place, inertia, .. } in &link.bodies {
        let Inertia { xx, yy, zz, xy, xz, yz } = inertia;
        found.extend([mass, xx, yy, zz, xy, xz, yz]);
        found.extend(placement(place));
    }
    found.extend(link.friction.formulas());
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
