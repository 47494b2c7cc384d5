//! The mechanism: links in a tree, one joint each.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::{
    error::NumericError, friction::Friction, pose::Pose, scalar::Number, spatial, validate,
};

/// The kind of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Not at all: the link is part of its parent.
    Fixed,
    /// A rotation about the axis; the position of the joint is an angle in radians.
    Revolute,
    /// A translation along the axis; the position of the joint is a distance in meters.
    Prismatic,
}

/// The joint between a link and its parent.
///
/// The position of the joint is `ratio * q[coordinate] + offset`. Several joints may have one
/// coordinate (a mimic joint, a spinning rotor with its gyroscopic coupling as a link of its own):
/// the torque of the coordinate then is the sum of the torques of the joints, each times its ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// The kind of the joint.
    pub kind: JointKind,
    /// Unit vector in the link frame, of no account for a fixed joint. The axis passes through the
    /// origin of the link frame.
    pub axis: Vector3<f64>,
    /// Index of the coordinate, of no account for a fixed joint.
    pub coordinate: usize,
    /// Movement of the joint for one unit of the coordinate.
    pub ratio: f64,
    /// Position of the joint where the coordinate is zero (rad or m).
    pub offset: f64,
}

impl Joint {
    /// A rigid connection.
    pub fn fixed() -> Self {
        Self::of(JointKind::Fixed, Vector3::z(), 0)
    }

    /// A rotation about the unit vector `axis` by the coordinate.
    pub fn revolute(axis: Vector3<f64>, coordinate: usize) -> Self {
        Self::of(JointKind::Revolute, axis, coordinate)
    }

    /// A translation along the unit vector `axis` by the coordinate.
    pub fn prismatic(axis: Vector3<f64>, coordinate: usize) -> Self {
        Self::of(JointKind::Prismatic, axis, coordinate)
    }

    fn of(kind: JointKind, axis: Vector3<f64>, coordinate: usize) -> Self {
        Self { kind, axis, coordinate, ratio: 1.0, offset: 0.0 }
    }

    /// The coordinate that moves the joint, if one does.
    pub fn driver(&self) -> Option<usize> {
        (self.kind != JointKind::Fixed).then_some(self.coordinate)
    }

    /// The motion of the link, in its own coordinates, for a unit rate of the coordinate:
    /// Featherstone's motion subspace S (section 4.4), times the ratio.
    pub(super) fn subspace<T: Number>(&self) -> Vector6<T> {
        let axis = (self.axis * self.ratio).map(T::from_real);
        match self.kind {
            JointKind::Fixed => Vector6::zeros(),
            JointKind::Revolute => spatial::spatial(&axis, &Vector3::zeros()),
            JointKind::Prismatic => spatial::spatial(&Vector3::zeros(), &axis),
        }
    }
}

/// A rigid body and the joint that connects it to its parent.
///
/// The link frame is the joint frame `placement`, moved by the joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Index of the parent, smaller than the link's own; `None` for the base.
    pub parent: Option<usize>,
    /// Placement of the joint frame in the link frame of the parent (in the base frame for a child
    /// of the base): the link frame where the joint's position is zero.
    pub placement: Pose,
    /// The joint.
    pub joint: Joint,
    /// Mass in kilograms.
    pub mass: f64,
    /// Center of mass in the link frame, in meters.
    pub center_of_mass: Vector3<f64>,
    /// Inertia tensor about the center of mass in the axes of the link frame, in kg m²; the
    /// elements beside the diagonal are those of the tensor (−∫xy dm).
    pub inertia: Matrix3<f64>,
    /// The inertia that the spinning parts of the drive add at the joint (armature,
    /// N² J), in kg m² or kg: an element of the diagonal of the mass matrix, without gyroscopic
    /// effects.
    pub rotor_inertia: f64,
    /// Friction in the joint, used if it is asked for.
    pub friction: Friction,
}

impl Link {
    /// A link without rotor and friction.
    pub fn new(
        parent: Option<usize>,
        placement: Pose,
        joint: Joint,
        mass: f64,
        center_of_mass: Vector3<f64>,
        inertia: Matrix3<f64>,
    ) -> Self {
        let (rotor_inertia, friction) = (0.0, Friction::default());
        Self { parent, placement, joint, mass, center_of_mass, inertia, rotor_inertia, friction }
    }

    /// First moment m c, in kg m.
    pub fn first_moment(&self) -> Vector3<f64> {
        self.center_of_mass * self.mass
    }

    /// Inertia tensor about the origin of the link frame, in kg m².
    pub fn inertia_about_origin(&self) -> Matrix3<f64> {
        let c = &self.center_of_mass;
        let spread = Matrix3::identity() * c.dot(c) - c * c.transpose();
        self.inertia + spread * self.mass
    }

    /// The reflected inertia of the drive on the side of the coordinate.
    pub(super) fn rotor_on_coordinate(&self) -> f64 {
        self.joint.ratio * self.joint.ratio * self.rotor_inertia
    }
}

/// A frame of interest fixed to a link or to the base: a tip, a sensor, a tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Index of the link that carries it; `None` for the base.
    pub link: Option<usize>,
    /// Placement in the link frame.
    pub placement: Pose,
}

/// The wrench that a frame exerts on its surroundings, in the axes of the frame.
///
/// A hanging mass m, with the z axis of the frame upright, is the force (0, 0, +m g).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Force in newtons.
    pub force: Vector3<f64>,
    /// Moment about the origin of the frame, in newton meters.
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// No load.
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }
}

/// A tree of links on a fixed base, valid by construction.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    gravity: Vector3<f64>,
    links: Vec<Link>,
    frames: Vec<Frame>,
    coordinates: usize,
}

impl Mechanism {
    /// A mechanism, given the acceleration of gravity in the base frame (it points down, m/s²), the
    /// links with parents before children, and frames of interest.
    ///
    /// # Errors
    ///
    /// [`NumericError::Mechanism`] with every fault found: a parent that does not come before its
    /// child, a coordinate that no joint or too large an index for one, an axis that is not a unit
    /// vector, a rotation that is not one, an inertia that is not symmetric, a number that is not
    /// finite. Whether a body can have these masses and inertias is not asked.
    pub fn new(
        gravity: Vector3<f64>,
        links: Vec<Link>,
        frames: Vec<Frame>,
    ) -> Result<Self, NumericError> {
        let faults = validate::faults(&gravity, &links, &frames);
        if !faults.is_empty() {
            return Err(NumericError::Mechanism(faults));
        }
        Ok(Self::assemble(gravity, links, frames))
    }

    /// A mechanism of data that are known to be valid.
    pub(super) fn assemble(gravity: Vector3<f64>, links: Vec<Link>, frames: Vec<Frame>) -> Self {
        let drivers = links.iter().filter_map(|link| link.joint.driver());
        let coordinates = drivers.max().map_or(0, |last| last + 1);
        Self { gravity, links, frames, coordinates }
    }

    /// Acceleration of gravity in the base frame, m/s².
    pub fn gravity(&self) -> &Vector3<f64> {
        &self.gravity
    }

    /// The links, parents before children.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// The frames of interest.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// The number of coordinates n: the length of q, q̇, q̈ and τ.
    pub fn coordinates(&self) -> usize {
        self.coordinates
    }
}
