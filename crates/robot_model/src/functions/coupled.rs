//! The entries of the mass matrix that can be nonzero for the structure of a robot.

use std::collections::BTreeSet;

use crate::robot::Robot;

/// The entries in the lower triangle of the mass matrix that can be nonzero, as row and column counted from 0. They are
/// listed row by row, with the columns ascending to the diagonal.
///
/// An entry couples two coordinates. It is 0 if no joint of one coordinate carries a joint of the other.
#[must_use]
pub fn coupled(robot: &Robot) -> Vec<[usize; 2]> {
    let diagonal = (0..robot.coordinates.len()).map(|coordinate| [coordinate; 2]);
    let mut entries: BTreeSet<[usize; 2]> = diagonal.collect();
    for link in &robot.links {
        let outer = link.joint.coordinate;
        let parent = |index: &usize| robot.links.get(*index)?.parent;
        for index in std::iter::successors(link.parent, parent) {
            let Some(carrier) = robot.links.get(index) else { break };
            let inner = carrier.joint.coordinate;
            entries.insert([outer.max(inner), outer.min(inner)]);
        }
    }
    entries.into_iter().collect()
}
