//! The wrenches that derivatives project on the motions of inner joints.

use robot_model::robot::JointKind;

use super::composites::Composites;
use super::motions::{JointMotion, Motions};
use super::{Form, Reference};
use crate::economical::composite::inertial_wrench;
use crate::economical::composite::projection::Propagate;
use crate::economical::frames::Frames;
use crate::economical::plan::Place;
use crate::economical::spatial::Wrench;
use crate::economical::spatial::inertia::PseudoInertia;
use crate::vector::{Matrix, Vector};

/// The quantities of an outer joint that are propagated to the inner joints.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load<'m, 'g> {
    /// P Z of the outer joint: the wrench for a unit acceleration.
    pub(super) unit: Wrench<'g>,
    /// The projection of B on the outer joint, for each component of the inner joint's angular motion.
    pub(super) projected: Vector<'g>,
    /// The wrench caused by the outer joint's own motion.
    pub(super) own: Wrench<'g>,
    /// The motions of all joints.
    motions: &'m [JointMotion<'g>],
}

impl<'g> Propagate<'g> for Load<'_, 'g> {
    fn inward(&self, frames: &Frames<'_, 'g>, place: Place) -> Self {
        let unit = self.unit.inward(frames, place);
        let mut projected = self.projected.inward(frames, place);
        if !place.turned {
            projected = projected + self.motions[place.link].passed.cross(unit.force);
        }
        Load { unit, projected, own: self.own.inward(frames, place), ..*self }
    }
}

/// The quantities from which loads are computed.
pub(super) struct Loads<'c, 'g> {
    pub(super) frames: &'c Frames<'c, 'g>,
    pub(super) motions: &'c Motions<'g>,
    pub(super) composites: &'c Composites<'g>,
    pub(super) form: Form,
}

impl<'c, 'g> Loads<'c, 'g> {
    /// The wrench 2 V Z P + 2 Z B, in which V is the motion of the body that B is relative to.
    pub(super) fn of_velocity(&self, index: usize) -> Load<'c, 'g> {
        let motion = &self.motions.links[index];
        let inertia = &self.composites.inertias[index];
        let own = match self.frames.chain.links[index].kind {
            JointKind::Revolute => self.of_turning(index),
            JointKind::Prismatic => inertial_wrench(inertia, &motion.rate),
        };
        Load { own, ..self.common(index) }
    }

    fn of_turning(&self, index: usize) -> Wrench<'g> {
        let motion = &self.motions.links[index];
        let inertia = &self.composites.inertias[index];
        let to_link = &self.composites.to_links[index];
        let of_links = to_link.wrench_of_unit_rate(motion.unit.angular);
        match self.form.velocities {
            Reference::Carrier if !to_link.is_zero() => {
                let momentum = &self.composites.to_carriers[index];
                let mut by_momentum = momentum.wrench_of_unit_rate(motion.unit.angular);
                // The velocity of the joint itself does not affect this component.
                by_momentum.moment.0[2] = of_links.moment.0[2];
                turning_of_turned(inertia, motion.carrier.omega * self.motions.factor)
                    .plus(&by_momentum)
            }
            _ => turning_of_turned(inertia, motion.omega * self.motions.factor).plus(&of_links),
        }
    }

    /// The derivative of the whole wrench with respect to the joint position.
    pub(super) fn of_position(&self, index: usize) -> Load<'c, 'g> {
        let load = self.common(index);
        let own = match self.form.positions {
            Reference::Link => self.of_shifted_links(index),
            Reference::Carrier => {
                let mut own = self.of_moved_links(index);
                match self.frames.chain.links[index].kind {
                    // For the joint's own torque, a rotation of the joint is equivalent to the opposite rotation of the
                    // carrier.
                    JointKind::Revolute => {
                        own.moment.0[2] = self.motions.links[index].by_position(&load);
                    }
                    JointKind::Prismatic => {}
                }
                own
            }
        };
        Load { own, ..load }
    }

    fn common(&self, index: usize) -> Load<'c, 'g> {
        let (inertia, motion) = (&self.composites.inertias[index], &self.motions.links[index]);
        let unit = inertial_wrench(inertia, &motion.unit);
        let relative = self.composites.to_links[index].project(&motion.unit);
        // The part of the link's own motion: (ω × z) · Σ for a revolute joint, (ω × h) × z for a prismatic joint.
        let omega = motion.omega * self.motions.factor;
        let carried = inertia.second * motion.rate.angular
            + omega.cross(inertia.first).cross(motion.unit.linear);
        Load {
            unit,
            projected: carried + relative,
            own: Wrench::zero(inertia.mass.graph()),
            motions: &self.motions.links,
        }
    }
}

/// The wrench of \[ω\]× \[z\]× P.
fn turning_of_turned<'g>(inertia: &PseudoInertia<'g>, omega: Vector<'g>) -> Wrench<'g> {
    let (Vector([x, y, _]), Matrix([first, second, _])) = (inertia.first, inertia.second);
    let zero = inertia.mass.graph().zero();
    Wrench {
        force: omega.cross(Vector([-y, x, zero])),
        moment: Vector([Vector(second).dot(omega), -Vector(first).dot(omega), zero]),
    }
}
