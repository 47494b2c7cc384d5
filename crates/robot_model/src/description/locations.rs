//! Places of the parts of a robot in the file.

use robot_symbolic::Formula;

use crate::diagnostic::{Diagnostic, Span, code};

/// The places of the parts of a [`crate::robot::Robot`], index by index; for a part that the file leaves out, `None`
/// or the place of the table that lacks it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Locations {
    /// The robot's name.
    pub name: Span,
    /// Gravity.
    pub gravity: Option<Span>,
    /// One for each of [`crate::robot::Robot::parameters`].
    pub parameters: Vec<ParameterLocation>,
    /// One for each of [`crate::robot::Robot::links`].
    pub links: Vec<LinkLocation>,
    /// One for each of [`crate::robot::Robot::frames`].
    pub frames: Vec<FrameLocation>,
    /// The angles of placements and of tensors' axes, in the order of reading.
    pub angles: Vec<AngleLocation>,
    /// Bodies that are fixed to the base and therefore not part of the robot.
    pub dropped: Vec<DroppedBody>,
}

/// An angle of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleLocation {
    /// The angle, rad.
    pub value: Formula,
    /// Its place.
    pub place: Span,
}

/// A body that has no effect on the motion because it is fixed to the base.
#[derive(Clone, Debug, PartialEq)]
pub struct DroppedBody {
    /// The link that has it.
    pub link: String,
    /// Its mass, kg.
    pub mass: Formula,
    /// Its places.
    pub place: BodyLocation,
}

impl DroppedBody {
    /// The warning that the body has no effect.
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

/// Places of a parameter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ParameterLocation {
    /// The key.
    pub name: Span,
    /// The nominal value.
    pub value: Option<Span>,
    /// The unit.
    pub unit: Option<Span>,
}

/// Places of a moving link.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LinkLocation {
    /// The name.
    pub name: Span,
    /// The parent's name.
    pub parent: Option<Span>,
    /// The joint's table.
    pub joint: Span,
    /// The joint's axis.
    pub axis: Option<Span>,
    /// The joint's limits.
    pub limits: Option<Span>,
    /// `origin` or `dh`.
    pub origin: Option<Span>,
    /// The friction's table.
    pub friction: Option<Span>,
    /// The drive's table.
    pub drive: Option<Span>,
    /// One for each of [`crate::robot::Link::bodies`].
    pub bodies: Vec<BodyLocation>,
}

/// Places of a body.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BodyLocation {
    /// The name of the link that has the body.
    pub name: Span,
    /// The mass.
    pub mass: Option<Span>,
    /// The center of mass.
    pub center_of_mass: Option<Span>,
    /// The inertia's table.
    pub inertia: Option<Span>,
    /// Whether the file waives the check of the inertia (`unchecked = true`).
    pub unchecked: bool,
}

/// Places of a named frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameLocation {
    /// The name, or the table that has none.
    pub name: Span,
    /// `origin`.
    pub origin: Option<Span>,
    /// The wrench's names.
    pub wrench: Option<Span>,
}
