//! Detects a base that has mass and carries several branches. Most likely it is free to move, but a robot here has a
//! fixed base.

use std::collections::BTreeSet;

use robot_symbolic::Formula;

use super::locations::{BodyLocation, Locations};
use super::reader::Reader;
use crate::diagnostic::significant;
use crate::diagnostic::{Diagnostic, code};
use crate::robot::Robot;

/// Warns about such a base; returns whether the robot has one.
pub(super) fn check(reader: &mut Reader<'_>, robot: &Robot, locations: &Locations) -> bool {
    let on_base = robot.links.iter().filter(|link| link.parent.is_none());
    // Branches that one coordinate drives are parts of one mechanism, not separate legs.
    let branches: BTreeSet<usize> = on_base.map(|link| link.joint.coordinate).collect();
    let Some(first) = locations.dropped.first().filter(|_| branches.len() > 1) else {
        return false;
    };
    let masses: Vec<&Formula> = locations.dropped.iter().map(|dropped| &dropped.mass).collect();
    let known: Option<f64> = masses.into_iter().map(|mass| reader.known(mass)).sum();
    let mass = known.map_or_else(String::new, |mass| format!(" of {} kg", significant(mass)));
    let BodyLocation { name, mass: of_mass, inertia, .. } = &first.place;
    let place = of_mass.as_ref().or(inertia.as_ref()).unwrap_or(name).clone();
    let message = format!("the base{mass} is fixed, and {} branches move on it", branches.len());
    reader.report(
        Diagnostic::warning(code::FREE_BASE, message)
            .at(&place, "this body has no effect")
            .because(
                "the base is fixed in this model; if it is free, like the trunk of a legged \
                 robot, the torques and accelerations are those of the robot with its trunk held \
                 still",
            )
            .help(
                "ignore this if the base is bolted down; give a free base its own joints to the \
                 ground: three prismatic and three revolute ones, with massless links between \
                 them (and allow massless links)",
            ),
    );
    true
}
