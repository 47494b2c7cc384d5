//! The entries of the mass matrix that a robot's structure lets be different from 0.

use std::collections::BTreeSet;

use crate::robot::Robot;

/// Row and column, from 0, of the entries of the mass matrix's lower triangle that are not 0 by structure: row by row, the
/// columns ascending to the diagonal.
///
/// An entry couples two coordinates. It is 0 if no joint of one carries a joint of the other.
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
