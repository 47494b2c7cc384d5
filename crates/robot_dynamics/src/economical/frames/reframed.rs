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
