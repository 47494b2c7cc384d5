//! Mechanisms with link frames other than those of the robot file.

use crate::economical::frames::chain::Limits;
use crate::economical::frames::working::{WorkingFrame, axes_about, between, normal_with_parent};
use crate::mechanism::Mechanism;
use crate::vector::{Matrix, Vector};
use robot_model::robot::JointKind;

/// A mechanism with other link frames than the file's but the same motions.
#[derive(Clone, Debug)]
pub(crate) struct Reframed<'g> {
    /// The mechanism in those frames.
    pub(crate) mechanism: Mechanism<'g>,
    /// The frames, each relative to the file's frame of its link.
    pub(crate) frames: Vec<WorkingFrame<'g>>,
}

impl<'g> Reframed<'g> {
    /// Denavit–Hartenberg frames, which only depend on the geometry. Axis z is the joint axis; the origin is the point
    /// at which the common normal with the axis of the parent's joint meets it; x is as close to the file's as this
    /// allows.
    ///
    /// For prismatic joints and first joints, and if the position of the normal is not well defined, the origin is the
    /// file's. `None` if a joint axis depends on parameters.
    pub(crate) fn denavit_hartenberg(mechanism: &Mechanism<'g>) -> Option<Reframed<'g>> {
        let farthest = Limits::of(mechanism).shift;
        let mut frames: Vec<WorkingFrame<'g>> = vec![];
        for link in &mechanism.links {
            let axes = axes_about(link.axis)?;
            let parent = match link.kind {
                JointKind::Revolute => link.parent.map(|parent| &frames[parent]),
                JointKind::Prismatic => None,
            };
            let along = parent.and_then(|parent| {
                normal_with_parent(link, axes, parent.axes, parent.origin, farthest)
            });
            let origin = match along {
                Some(along) => link.axis * along,
                None => Vector::zero(mechanism.graph),
            };
            frames.push(WorkingFrame { axes, origin, flipped: false });
        }
        Some(Reframed { mechanism: in_frames(mechanism, &frames), frames })
    }
}

fn in_frames<'g>(mechanism: &Mechanism<'g>, frames: &[WorkingFrame<'g>]) -> Mechanism<'g> {
    let mut moved = mechanism.clone();
    let z = Matrix::identity(mechanism.graph).column(2);
    for (link, own) in moved.links.iter_mut().zip(frames) {
        let back = own.axes.transpose();
        let parent = link.parent.map(|parent| &frames[parent]);
        (link.rotation, link.translation) = between(link, own, parent);
        link.center_of_mass = back * (link.center_of_mass - own.origin);
        link.inertia = back * link.inertia * own.axes;
        link.axis = z;
    }
    for frame in &mut moved.frames {
        let Some(own) = frame.link.map(|link| &frames[link]) else { continue };
        let back = own.axes.transpose();
        frame.rotation = back * frame.rotation;
        frame.translation = back * (frame.translation - own.origin);
    }
    moved
}

#[cfg(test)]
mod tests {
    use robot_numeric::random::{Random, Recipe};
    use robot_numeric::robots;
    use robot_symbolic::Graph;

    use super::*;
    use crate::mechanism::MechanismOptions;

    /// The origin of a frame is the point of its axis that is closest to the axis of the parent's joint, and the normal of
    /// parallel axes is that through the parent's origin.
    #[test]
    fn origins_are_the_feet_of_common_normals() {
        let random = (0..8).map(|seed| robots::robot(&mut Random::new(seed), &Recipe::serial(6)));
        let arms = ["planar_2r", "puma560", "panda"].map(robot_testing::robot);
        let (mut skew, mut parallel) = (0, 0);
        for robot in random.chain(arms) {
            let graph = Graph::new();
            let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::ROUNDED);
            let reframed = Reframed::denavit_hartenberg(&mechanism).unwrap();
            for (link, frame) in reframed.mechanism.links.iter().zip(&reframed.frames) {
                let value = |name: &str| robot.nominal_value(name);
                let numbers = |Vector(entries): Vector<'_>| {
                    entries.map(|one| one.evaluate(|id| value(&graph.symbol_name(id))))
                };
                let (origin, axis) = (numbers(link.translation), numbers(link.rotation.column(2)));
                let is_moved = numbers(frame.origin) != [0.0; 3];
                if link.parent.is_none() || link.kind == JointKind::Prismatic {
                    assert!(!is_moved, "{}", robot.name);
                    continue;
                }
                // The derivative of the squared distance from the parent's axis z along the link's axis.
                let slope = origin[0] * axis[0] + origin[1] * axis[1];
                if axis[0].hypot(axis[1]) > 1e-2 && is_moved {
                    assert!(slope.abs() < 1e-9, "{}: {origin:?} {axis:?}", robot.name);
                    skew += 1;
                } else if axis[0].hypot(axis[1]) < 1e-12 {
                    assert!(origin[2].abs() < 1e-9, "{}: {origin:?} {axis:?}", robot.name);
                    parallel += 1;
                }
            }
        }
        assert!(skew > 10 && parallel > 1, "{skew} {parallel}");
    }
}
