//! Identifiability conditions: the linear functions of each link's parameters that the joint torques determine.
//!
//! The joint torques are zero in all states if and only if the kinetic energy is zero and the potential energy is
//! constant. The velocity and position of a joint occur only in the energies of its link and of the links farther
//! outward. The links are therefore treated from the tips inward. Let π be the parameters of a link, including those
//! that its children have passed on to it; Φ the twist of the joint's unit motion; t the twists that the motions of the
//! carrier produce at the link, and w the linear functions of parameters that are kinetic or potential energies of
//! these motions; and D the derivative of the parameters with respect to the joint position. Then π has no effect
//! beyond that of a body on the link's carrier if and only if
//!
//! - b(Φ, Φ) π + J = 0 and b(Φ, t) π + ρ a · ω(t) = 0: the momentum along the joint vanishes;
//! - w D π = 0, and w D π + o = 0 for the potential energy: the energies do not depend on the joint position.
//!
//! Here b(t, t) π is twice the kinetic energy, J the drive's reflected inertia, ρ the coupling of its rotor with the
//! carrier, o the drive's offset, a the joint axis, and ω(t) the angular velocity of the twist t. Only the spans of t
//! and w matter. They are found from the base outward: Φ, b(Φ, Φ) and b(Φ, t) are added to the spans of the carrier,
//! and the result is closed under the motion of the joint. The conditions are thus small systems of linear equations,
//! and they are exact.
//!
//! These are the spans of motion of P. M. Wensing, G. Niemeyer, J.-J. E. Slotine, "A geometric characterization of
//! observability in inertial parameter identification" (2018), extended here to drives.

use robot_model::robot::LINK_PARAMETERS;

use super::echelon::{Echelon, Row, closure};
use super::joint::{Joint, energy};
use super::scalar::{Points, Scalar};
use super::standard::Quantity;
use crate::mechanism::Mechanism;

/// The quantities of a drive that follow the ten parameters of the link.
pub(super) const DRIVE: [Quantity; 3] =
    [Quantity::Offset, Quantity::RotorCoupling, Quantity::ReflectedInertia];

/// The span of the possible motions at a link.
struct Span<'g> {
    /// Twists about the link's origin, in its axes.
    twists: Vec<Row<'g>>,
    /// Linear functions of the parameters that are kinetic energies of these motions.
    kinetic: Vec<Row<'g>>,
    /// Linear functions of the parameters, with a constant, that are potential energies in these motions.
    potential: Vec<Row<'g>>,
}

/// The identifiable linear functions of each link's parameters, which are ordered as in [`Quantity::place`].
pub(super) fn conditions<'g>(
    mechanism: &Mechanism<'g>,
    joints: &[Joint<'g>],
    points: &Points<'_>,
) -> Vec<Vec<Row<'g>>> {
    let base = at_base(mechanism, points);
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

/// The span at the base, which is at rest: there are no twists, and the potential energy is −g · h plus a constant,
/// with the first moment h.
fn at_base<'g>(mechanism: &Mechanism<'g>, points: &Points<'_>) -> Span<'g> {
    let graph = mechanism.graph;
    let zero = Scalar::new(graph.zero());
    let mut potential = vec![zero; LINK_PARAMETERS + 1];
    for (place, component) in mechanism.gravity.0.into_iter().enumerate() {
        potential[1 + place] = Scalar::of(-component, points);
    }
    potential[LINK_PARAMETERS] = Scalar::integer(zero, 1);
    Span { twists: vec![], kinetic: vec![], potential: vec![potential] }
}

impl<'g> Span<'g> {
    /// The motions of the carrier as seen at a link, at all positions of the link's joint.
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

    /// The motions of the carrier together with the motion of the joint itself.
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
