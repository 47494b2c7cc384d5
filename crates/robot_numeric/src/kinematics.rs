//! The placements of links and frames.

use nalgebra::{Matrix6, Vector3};
use robot_model::variable::JointVariable::Position;

use super::{
    error::{NumericError, check_lengths},
    mechanism::{JointKind, Link, Mechanism},
    pose::{Pose, rotation_about},
    scalar::Number,
    spatial::motion_transform,
};

/// The mechanism in one configuration.
pub(super) struct Configuration<T: Number> {
    /// The placement of each link frame in that of its parent.
    pub(super) in_parent: Vec<Pose<T>>,
    /// The transform X of motion vectors from the parent to the link, for each link.
    pub(super) transforms: Vec<Matrix6<T>>,
}

impl<T: Number> Configuration<T> {
    pub(super) fn new(mechanism: &Mechanism, q: &[T]) -> Self {
        let in_parent: Vec<Pose<T>> = mechanism.links().iter().map(|link| place(link, q)).collect();
        let transforms = in_parent.iter().map(motion_transform).collect();
        Self { in_parent, transforms }
    }

    /// The placement of each link frame in the base frame.
    pub(super) fn in_base(&self, mechanism: &Mechanism) -> Vec<Pose<T>> {
        let mut poses: Vec<Pose<T>> = Vec::with_capacity(self.in_parent.len());
        for (link, pose) in mechanism.links().iter().zip(&self.in_parent) {
            poses.push(link.parent.map_or(*pose, |parent| poses[parent].then(pose)));
        }
        poses
    }
}

/// The placement of a link frame in its parent's: the joint frame, moved by the joint.
fn place<T: Number>(link: &Link, q: &[T]) -> Pose<T> {
    let joint = &link.joint;
    let mut motion = Pose::identity();
    if let Some(coordinate) = joint.driver() {
        let position = q[coordinate] * T::from_real(joint.ratio) + T::from_real(joint.offset);
        match joint.kind {
            JointKind::Fixed => {}
            JointKind::Revolute => motion.rotation = rotation_about(&joint.axis, position),
            JointKind::Prismatic => motion.translation = joint.axis.map(T::from_real) * position,
        }
    }
    link.placement.cast().then(&motion)
}

/// The poses of all links and frames, in the base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Placements {
    /// The placement of each link frame.
    pub links: Vec<Pose>,
    /// The placement of each frame of interest.
    pub frames: Vec<Pose>,
}

impl Mechanism {
    /// The poses of all link frames and named frames at joint positions q (rad or m).
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn forward_kinematics(&self, q: &[f64]) -> Result<Placements, NumericError> {
        check_lengths(&[(Position.name(), self.coordinates(), q.len())])?;
        let links = Configuration::new(self, q).in_base(self);
        let frames = self
            .frames()
            .iter()
            .map(|frame| {
                frame.link.map_or(frame.placement, |link| links[link].then(&frame.placement))
            })
            .collect();
        Ok(Placements { links, frames })
    }

    /// The center of mass of all links in the base frame, m; NaN if the sum of the masses is zero.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn center_of_mass(&self, q: &[f64]) -> Result<Vector3<f64>, NumericError> {
        let placements = self.forward_kinematics(q)?;
        let moment: Vector3<f64> = self
            .links()
            .iter()
            .zip(&placements.links)
            .map(|(link, pose)| pose.rotation * link.first_moment() + pose.translation * link.mass)
            .sum();
        let mass: f64 = self.links().iter().map(|link| link.mass).sum();
        Ok(moment / mass)
    }
}
