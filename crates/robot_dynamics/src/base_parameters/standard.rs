//! The standard parameters, one for each column of the full regressor.

use robot_model::robot::LINK_PARAMETERS;
use robot_symbolic::Expr;

use crate::body::Body;
use crate::mechanism::{Mechanism, MechanismLink};

/// An inertial parameter of a link, or a quantity of the drive of its joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// One of the ten parameters of a link: m, h_x, h_y, h_z, I_xx, I_xy, I_yy, I_xz, I_yz, I_zz. The first moment h
    /// and the inertia tensor I are about the origin and in the axes of the link's frame; kg, kg m, kg m².
    Link(usize),
    /// One of the ten parameters of a link in Denavit–Hartenberg frames, which base parameters may combine
    /// ([`BaseFrames`](robot_model::robot::BaseFrames)): m, h_x, h_y, h_z, and the second moments Σ_xx = ∫ x² dm, Σ_xy,
    /// Σ_yy, Σ_xz, Σ_yz, Σ_zz.
    Moment(usize),
    /// The inertia of the drive reflected to the joint, kg m² or kg.
    ReflectedInertia,
    /// Viscous friction, N m s/rad or N s/m.
    ViscousFriction,
    /// Constant dry friction at positive velocities, N m or N.
    ForwardFriction,
    /// Constant dry friction at negative velocities, N m or N.
    BackwardFriction,
    /// A constant offset of the joint torque, N m or N.
    Offset,
    /// The coupling of a gyroscopic rotor with the link that carries it: the rotor's inertia times the gear ratio.
    RotorCoupling,
}

/// The names of a link's ten parameters, following Khalil and Dombre.
const NAMES: [&str; LINK_PARAMETERS] = ["M", "MX", "MY", "MZ", "XX", "XY", "YY", "XZ", "YZ", "ZZ"];

/// The names if the last six parameters are second moments.
const MOMENTS: [&str; LINK_PARAMETERS] =
    ["M", "MX", "MY", "MZ", "SXX", "SXY", "SYY", "SXZ", "SYZ", "SZZ"];

impl Quantity {
    /// The quantities of a drive.
    pub const DRIVE: [Quantity; 6] = [
        Quantity::ReflectedInertia,
        Quantity::ViscousFriction,
        Quantity::ForwardFriction,
        Quantity::BackwardFriction,
        Quantity::Offset,
        Quantity::RotorCoupling,
    ];

    /// The name without the number of the link; inertial parameters have the names of Khalil and Dombre.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Quantity::Link(place) => NAMES.get(place).copied().unwrap_or_default(),
            Quantity::Moment(place) => MOMENTS.get(place).copied().unwrap_or_default(),
            Quantity::ReflectedInertia => "IA",
            Quantity::ViscousFriction => "FV",
            Quantity::ForwardFriction => "FP",
            Quantity::BackwardFriction => "FN",
            Quantity::Offset => "FO",
            Quantity::RotorCoupling => "IC",
        }
    }

    /// The quantity in words.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Quantity::Link(0) | Quantity::Moment(0) => "mass",
            Quantity::Link(1..=3) | Quantity::Moment(1..=3) => "first moment",
            Quantity::Link(_) => "moment of inertia",
            Quantity::Moment(_) => "second moment",
            Quantity::ReflectedInertia => "reflected inertia",
            Quantity::ViscousFriction => "viscous friction",
            Quantity::ForwardFriction => "forward friction",
            Quantity::BackwardFriction => "backward friction",
            Quantity::Offset => "offset",
            Quantity::RotorCoupling => "rotor coupling",
        }
    }

    /// The index among the quantities that inertial and position-dependent torques identify.
    pub(super) fn place(self) -> usize {
        match self {
            Quantity::Link(place) | Quantity::Moment(place) => place,
            Quantity::RotorCoupling => LINK_PARAMETERS + 1,
            Quantity::ReflectedInertia => LINK_PARAMETERS + 2,
            _ => LINK_PARAMETERS,
        }
    }
}

/// A parameter in which the joint torques are linear; it corresponds to a column of the full regressor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StandardParameter {
    /// The index, from 0, of the link or of the link that the drive moves.
    pub link: usize,
    /// The quantity.
    pub quantity: Quantity,
}

impl StandardParameter {
    /// The name, such as `ZZ_2`, in which links are numbered from 1.
    #[must_use]
    pub fn name(self) -> String {
        format!("{}_{}", self.quantity.symbol(), self.link + 1)
    }
}

/// The standard parameters, with their values as functions of the file's parameters, in the order of the columns of the
/// full regressor: ten of each link, then those of the drives that the file specifies.
#[must_use]
pub fn standard_parameters<'g>(mechanism: &Mechanism<'g>) -> Vec<(StandardParameter, Expr<'g>)> {
    let links = mechanism.links.iter().enumerate();
    let of_links = links.clone().flat_map(|(link, symbols)| {
        let values = Body::of_link(symbols).parameters().into_iter().enumerate();
        values.map(move |(place, value)| {
            (StandardParameter { link, quantity: Quantity::Link(place) }, value)
        })
    });
    let of_drives = links.flat_map(|(link, symbols)| {
        let entries = Quantity::DRIVE.map(|quantity| (quantity, drive_entry(symbols, quantity)));
        let given = entries.into_iter().filter(|(_, entry)| !entry.is_zero());
        given.map(move |(quantity, entry)| (StandardParameter { link, quantity }, entry))
    });
    of_links.chain(of_drives).collect()
}

/// The value of a quantity of a link's drive.
fn drive_entry<'g>(link: &MechanismLink<'g>, quantity: Quantity) -> Expr<'g> {
    let friction = &link.friction;
    match quantity {
        Quantity::Link(_) | Quantity::Moment(_) => link.mass.graph().zero(),
        Quantity::ReflectedInertia => link.reflected_inertia,
        Quantity::ViscousFriction => friction.viscous,
        Quantity::ForwardFriction => friction.coulomb_positive,
        Quantity::BackwardFriction => friction.coulomb_negative,
        Quantity::Offset => friction.offset,
        Quantity::RotorCoupling => link.rotor_coupling,
    }
}
