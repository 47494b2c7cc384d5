//! The places in the file of the parts of a robot.

use robot_symbolic::Formula;

use crate::diagnostic::{Diagnostic, Span, code};

/// The places of the parts of a [`crate::robot::Robot`], in the same order. For a part that the file leaves out, `None`
/// or the place of the table in which it would be.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Locations {
    /// The place of the robot's name.
    pub name: Span,
    /// The place of the gravity vector.
    pub gravity: Option<Span>,
    /// The places of [`crate::robot::Robot::parameters`], in the same order.
    pub parameters: Vec<ParameterLocation>,
    /// The places of [`crate::robot::Robot::links`], in the same order.
    pub links: Vec<LinkLocation>,
    /// The places of [`crate::robot::Robot::frames`], in the same order.
    pub frames: Vec<FrameLocation>,
    /// The angles of placements and of the axes of tensors, in the order in which they were read.
    pub angles: Vec<AngleLocation>,
    /// Bodies that are fixed to the base and therefore not part of the robot.
    pub dropped: Vec<DroppedBody>,
}

/// An angle of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleLocation {
    /// The angle, rad.
    pub value: Formula,
    /// Its place in the file.
    pub place: Span,
}

/// A body that has no effect on the motion because it is fixed to the base.
#[derive(Clone, Debug, PartialEq)]
pub struct DroppedBody {
    /// The name of the link that has the body.
    pub link: String,
    /// Its mass, kg.
    pub mass: Formula,
    /// The places of its parts.
    pub place: BodyLocation,
}

impl DroppedBody {
    /// Returns the warning that the body has no effect.
    #[must_use]
    pub fn diagnostic(&self) -> Diagnostic {
        let BodyLocation { name, mass, inertia, .. } = &self.place;
        let place = mass.as_ref().or(inertia.as_ref()).unwrap_or(name);
        let message = format!("the mass of `{}` has no effect", self.link);
        Diagnostic::warning(code::NO_EFFECT, message)
            .at(place, "fixed to the base")
            .help("remove it, or give the link a joint that moves")
    }
}

/// The places of the parts of a parameter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ParameterLocation {
    /// The place of the key.
    pub name: Span,
    /// The place of the nominal value.
    pub value: Option<Span>,
    /// The place of the unit.
    pub unit: Option<Span>,
}

/// The places of the parts of a moving link.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LinkLocation {
    /// The place of the link's name.
    pub name: Span,
    /// The place of the parent's name.
    pub parent: Option<Span>,
    /// The place of the joint's table.
    pub joint: Span,
    /// The place of the joint axis.
    pub axis: Option<Span>,
    /// The place of the joint limits.
    pub limits: Option<Span>,
    /// The place of `origin` or `dh`.
    pub origin: Option<Span>,
    /// The place of the friction table.
    pub friction: Option<Span>,
    /// The place of the drive table.
    pub drive: Option<Span>,
    /// The places of [`crate::robot::Link::bodies`], in the same order.
    pub bodies: Vec<BodyLocation>,
}

/// The places of the parts of a body.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BodyLocation {
    /// The place of the name of the link that has the body.
    pub name: Span,
    /// The place of the mass.
    pub mass: Option<Span>,
    /// The place of the center of mass.
    pub center_of_mass: Option<Span>,
    /// The place of the inertia table.
    pub inertia: Option<Span>,
    /// The place of the angles of the axes in which the inertia is given.
    pub axes: Option<Span>,
    /// Whether the file waives the check of the inertia with `unchecked = true`.
    pub unchecked: bool,
}

/// The places of the parts of a named frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameLocation {
    /// The place of the frame's name; for a frame without a name, the place of its table.
    pub name: Span,
    /// The place of `origin`.
    pub origin: Option<Span>,
    /// The place of the names of the wrench components.
    pub wrench: Option<Span>,
}
