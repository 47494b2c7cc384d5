//! The mechanism: a tree of links, each with one joint.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::{
    error::NumericError, friction::Friction, pose::Pose, scalar::Number, spatial, validate,
};

/// The kind of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// No motion: the link is rigidly connected to its parent.
    Fixed,
    /// Rotation about the axis; the joint position is an angle in radians.
    Revolute,
    /// Translation along the axis; the joint position is a distance in meters.
    Prismatic,
}

/// The joint between a link and its parent.
///
/// The joint position is `ratio * q[coordinate] + offset`. Several joints may share a coordinate: a mimic joint, for
/// example, or a gyroscopic rotor, which is represented by a separate link. The torque of the coordinate is then the
/// sum of the torques of these joints, each times its ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// The kind of the joint.
    pub kind: JointKind,
    /// The unit vector of the axis in the link frame; it has no effect for a fixed joint. The axis passes through the
    /// origin of the link frame.
    pub axis: Vector3<f64>,
    /// The index of the coordinate; it has no effect for a fixed joint.
    pub coordinate: usize,
    /// The motion of the joint for a unit of the coordinate.
    pub ratio: f64,
    /// The joint position if the coordinate is zero (rad or m).
    pub offset: f64,
}

impl Joint {
    /// Creates a fixed joint.
    pub fn fixed() -> Self {
        Self::of(JointKind::Fixed, Vector3::z(), 0)
    }

    /// Creates a revolute joint about the unit vector `axis`, moved by the coordinate with the index `coordinate`.
    pub fn revolute(axis: Vector3<f64>, coordinate: usize) -> Self {
        Self::of(JointKind::Revolute, axis, coordinate)
    }

    /// Creates a prismatic joint along the unit vector `axis`, moved by the coordinate with the index `coordinate`.
    pub fn prismatic(axis: Vector3<f64>, coordinate: usize) -> Self {
        Self::of(JointKind::Prismatic, axis, coordinate)
    }

    fn of(kind: JointKind, axis: Vector3<f64>, coordinate: usize) -> Self {
        Self { kind, axis, coordinate, ratio: 1.0, offset: 0.0 }
    }

    /// The index of the coordinate that moves the joint; `None` for a fixed joint.
    pub fn driver(&self) -> Option<usize> {
        (self.kind != JointKind::Fixed).then_some(self.coordinate)
    }

    /// The motion of the link, in its own axes, at unit velocity of the coordinate: Featherstone's motion subspace S
    /// (section 4.4) times the ratio.
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
    /// The index of the parent, which is smaller than the link's own; `None` for the base.
    pub parent: Option<usize>,
    /// The placement of the joint frame in the link frame of the parent, or in the base frame for a link on the base.
    /// The link frame coincides with it at joint position zero.
    pub placement: Pose,
    /// The joint.
    pub joint: Joint,
    /// The mass, kg.
    pub mass: f64,
    /// The center of mass in the link frame, m.
    pub center_of_mass: Vector3<f64>,
    /// The inertia tensor about the center of mass in the axes of the link frame, kg m². Off-diagonal entries are
    /// entries of the tensor (−∫xy dm).
    pub inertia: Matrix3<f64>,
    /// The inertia that the spinning parts of the drive add at the joint (armature, N² J), kg m² or kg. It is only
    /// added to the diagonal of the mass matrix, without gyroscopic effects.
    pub rotor_inertia: f64,
    /// The friction in the joint, which is only used if it is requested.
    pub friction: Friction,
}

impl Link {
    /// Creates a link without rotor and friction.
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

    /// The first moment m c, kg m.
    pub fn first_moment(&self) -> Vector3<f64> {
        self.center_of_mass * self.mass
    }

    /// The inertia tensor about the origin of the link frame, kg m².
    pub fn inertia_about_origin(&self) -> Matrix3<f64> {
        let c = &self.center_of_mass;
        let spread = Matrix3::identity() * c.dot(c) - c * c.transpose();
        self.inertia + spread * self.mass
    }

    /// The rotor inertia with respect to the coordinate.
    pub(super) fn rotor_on_coordinate(&self) -> f64 {
        self.joint.ratio * self.joint.ratio * self.rotor_inertia
    }
}

/// A frame of interest fixed to a link or to the base: a tip, a sensor, a tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// The index of the link that carries it; `None` for the base.
    pub link: Option<usize>,
    /// The placement in the link frame.
    pub placement: Pose,
}

/// The wrench that a frame exerts on its surroundings, in the axes of the frame.
///
/// For example, a frame with an upright z axis that holds a mass m against gravity exerts the force (0, 0, +m g).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// The force, N.
    pub force: Vector3<f64>,
    /// The moment about the origin of the frame, N m.
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// The zero wrench.
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }
}

/// A tree of links on a fixed base. Its data are checked when it is created.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    gravity: Vector3<f64>,
    links: Vec<Link>,
    frames: Vec<Frame>,
    coordinates: usize,
}

impl Mechanism {
    /// Creates a mechanism from the acceleration of gravity in the base frame (it points down, m/s²), the links with
    /// parents before children, and frames of interest.
    ///
    /// # Errors
    ///
    /// [`NumericError::Mechanism`] with all faults: a parent that does not precede its child, a coordinate without a
    /// joint, a coordinate index that is too large, an axis that is not a unit vector, a rotation matrix that is not a
    /// rotation, an inertia that is not symmetric, or a number that is not finite. It is not checked whether a body can
    /// have these masses and inertias.
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

    /// Creates a mechanism from data that are known to be valid.
    pub(super) fn assemble(gravity: Vector3<f64>, links: Vec<Link>, frames: Vec<Frame>) -> Self {
        let drivers = links.iter().filter_map(|link| link.joint.driver());
        let coordinates = drivers.max().map_or(0, |last| last + 1);
        Self { gravity, links, frames, coordinates }
    }

    /// The acceleration of gravity in the base frame, m/s².
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
