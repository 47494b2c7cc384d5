//! Named expressions and their meanings.

use robot_symbolic::Expr;

use robot_model::unit::Dimension;

/// A scalar quantity of a robot's dynamics, or one component of a vector.
#[derive(Clone, Debug)]
pub struct Quantity<'g> {
    /// The symbol of the quantity.
    pub symbol: Symbol,
    /// The value of the quantity.
    pub value: Expr<'g>,
    /// The dimension of the quantity.
    pub dimension: Dimension,
}

/// The quantities that the paper names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// a_c: acceleration of the center of mass, equation (8).
    CenterOfMassAcceleration,
    /// F = M a_c, equation (14).
    Force,
    /// M_c = J ε + ω × J ω, equation (20).
    Moment,
    /// F_l: the force that the joint transmits, equation (26).
    LinkForce,
    /// M_l: the moment that the joint transmits, about the origin of the frame, equation (36).
    LinkMoment,
    /// Q: the joint torque or force, equation (3).
    JointTorque,
}

impl Kind {
    /// All kinds, in the order in which the paper derives them.
    pub const ALL: [Kind; 6] = [
        Kind::CenterOfMassAcceleration,
        Kind::Force,
        Kind::Moment,
        Kind::LinkForce,
        Kind::LinkMoment,
        Kind::JointTorque,
    ];

    /// The name in text: `a_c`, `F`, `M_c`, `F_l`, `M_l`, `Q`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Kind::CenterOfMassAcceleration => "a_c",
            Kind::Force => "F",
            Kind::Moment => "M_c",
            Kind::LinkForce => "F_l",
            Kind::LinkMoment => "M_l",
            Kind::JointTorque => "Q",
        }
    }

    /// The kind with the given name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether the quantity is a vector of three components in its link's frame.
    #[must_use]
    pub const fn is_vector(self) -> bool {
        !matches!(self, Kind::JointTorque)
    }
}

/// A quantity of one link or joint, such as `F_l5.x` or `Q2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol {
    /// The kind of quantity.
    pub kind: Kind,
    /// The number of the link or coordinate, from 1.
    pub number: usize,
    /// The component, 0, 1 or 2 for x, y or z; `None` for scalars.
    pub component: Option<usize>,
}

impl std::fmt::Display for Symbol {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}{}", self.kind.name(), self.number)?;
        match self.component {
            Some(component) => write!(formatter, ".{}", ["x", "y", "z"][component.min(2)]),
            None => Ok(()),
        }
    }
}
