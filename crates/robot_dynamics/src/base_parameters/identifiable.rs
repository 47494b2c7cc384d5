//! Identifiability conditions: which linear functions of each link's parameters the joint torques determine.
//!
//! Joint torques vanish at all states where the kinetic energy does and the potential energy is
//! constant. A joint's own velocity and position occur in the energies of its link and of the links
//! farther outward alone. From the tips inward, the parameters π of a link, with what its children
//! have passed on to it, therefore have no effect beyond that of a body on the link's carrier exactly
//! where, with the twist Φ of the joint's motion, the twists t and the linear functions of parameters w
//! that the carrier's motions bring (kinetic energy, potential energy), and D the rate of the
//! parameters as the joint moves,
//!
//! - b(Φ, Φ) π + J = 0 and b(Φ, t) π + ρ a · ω(t) = 0: the momentum along the joint vanishes,
//! - w D π = 0, and w D π + o = 0 for the potential energy: no position of the joint is another.
//!
//! Here b(t, t) π is twice the kinetic energy, J the drive's reflected inertia, ρ its rotor's coupling
//! with the carrier and o its offset. All t and w matter by what they span only, and that is found
//! from the base outward: Φ and b(Φ, Φ), b(Φ, t) are added to what the carrier has, and all is closed
//! under the joint's motion. So the conditions are small systems of linear equations, and exact.
//!
//! The spans of motion of P. M. Wensing, G. Niemeyer, J.-J. E. Slotine, "A geometric characterization
//! of observability in inertial parameter identification" (2018), here with drives.

use robot_model::robot::LINK_PARAMETERS;

use super::echelon::{Echelon, Row, closure};
use super::joint::{Joint, energy};
use super::scalar::Scalar;
use super::standard::Quantity;
use crate::mechanism::Mechanism;

/// The drive's quantities in the places after the ten of the link.
pub(super) const DRIVE: [Quantity; 3] =
    [Quantity::Offset, Quantity::RotorCoupling, Quantity::ReflectedInertia];

/// A motion's span at a link.
struct Span<'g> {
    /// Twists about the link's origin, in its axes.
    twists: Vec<Row<'g>>,
    /// Linear functions of the parameters, each a kinetic energy of the motion.
    kinetic: Vec<Row<'g>>,
    /// Linear functions of the parameters, each a potential energy of the motion, and a constant.
    potential: Vec<Row<'g>>,
}

/// Per link, the identifiable linear functions of its parameters: places as in [`Quantity::place`].
pub(super) fn conditions<'g>(mechanism: &Mechanism<'g>, joints: &[Joint<'g>]) -> Vec<Vec<Row<'g>>> {
    let base = at_base(mechanism);
    let mut spans: Vec<Span<'g>> = vec![];
    let mut conditions = vec![];
    for (link, joint) in mechanism.links.iter().zip(joints) {
        let carrier = link.parent.map_or(&base, |parent| &spans[parent]);
        let carried = carrier.carried(joint);
        conditions.push(carried.conditions(joint));
        spans.push(carried.with_own(joint));
    }
    conditions
}

/// The base rests; the potential energy is −g · h.
fn at_base<'g>(mechanism: &Mechanism<'g>) -> Span<'g> {
    let graph = mechanism.graph;
    let zero = Scalar::new(graph.zero());
    let mut potential = vec![zero; LINK_PARAMETERS + 1];
    for (place, component) in mechanism.gravity.0.into_iter().enumerate() {
        potential[1 + place] = Scalar::new(-component);
    }
    potential[LINK_PARAMETERS] = Scalar::integer(zero, 1);
    Span { twists: vec![], kinetic: vec![], potential: vec![potential] }
}

impl<'g> Span<'g> {
    /// The motions of the carrier seen at a link, over all positions of its joint.
    fn carried(&self, joint: &Joint<'g>) -> Span<'g> {
        let functions = |of: &[Row<'g>]| {
            let here = of.iter().map(|row| joint.function_here(row));
            closure(here, |row| joint.rate(row))
        };
        let twists = self.twists.iter().map(|twist| joint.twist_here(twist));
        Span {
            twists: closure(twists, |twist| joint.turned(twist)),
            kinetic: functions(&self.kinetic),
            potential: functions(&self.potential),
        }
    }

    fn conditions(&self, joint: &Joint<'g>) -> Vec<Row<'g>> {
        let zero = Scalar::integer(joint.twist[0], 0);
        let row = |mut row: Row<'g>, quantity: Quantity, amount: Scalar<'g>| {
            row.resize(LINK_PARAMETERS + DRIVE.len(), zero);
            row[quantity.place()] = amount;
            row
        };
        let one = Scalar::integer(zero, 1);
        let own = energy(&joint.twist, &joint.twist);
        let mut conditions = vec![row(own, Quantity::ReflectedInertia, one)];
        conditions.extend(self.twists.iter().map(|twist| {
            let turn = joint.about_axis(twist);
            row(energy(&joint.twist, twist), Quantity::RotorCoupling, turn)
        }));
        let kinetic = self.kinetic.iter();
        conditions
            .extend(kinetic.map(|function| row(joint.rate(function), Quantity::Offset, zero)));
        conditions.extend(self.potential.iter().map(|function| {
            let mut rate = joint.rate(function);
            rate.truncate(LINK_PARAMETERS);
            row(rate, Quantity::Offset, function[LINK_PARAMETERS])
        }));
        conditions
    }

    /// The motions with the joint's own.
    fn with_own(self, joint: &Joint<'g>) -> Span<'g> {
        let own = std::iter::once(&joint.twist).chain(&self.twists);
        let own: Vec<Row<'g>> = own.map(|twist| energy(&joint.twist, twist)).collect();
        let span =
            |own: Vec<Row<'g>>, carried: Vec<Row<'g>>| Echelon::of(own.into_iter().chain(carried));
        Span {
            kinetic: span(own, self.kinetic).into_rows(),
            twists: span(vec![joint.twist.clone()], self.twists).into_rows(),
            potential: self.potential,
        }
    }
}
