//! The wrenches that derivatives project on the motions of inner joints.

use robot_model::robot::JointKind;

use super::motions::{JointMotion, Motions};
use crate::economical::composite::projection::Propagate;
use crate::economical::composite::{Accumulate, composites, gather_across, inertial_wrench};
use crate::economical::frames::Frames;
use crate::economical::plan::Place;
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::momentum::Momentum;
use crate::economical::spatial::{Twist, Wrench};
use crate::vector::{Matrix, Vector};

/// P and B of every link and all that it carries, in home axes; B relative to the link and times the factor of the
/// motions.
pub(super) struct Composites<'g> {
    inertias: Vec<PseudoInertia<'g>>,
    momenta: Vec<Momentum<'g>>,
}

/// The quantities of an outer joint that are propagated to the inner joints.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load<'m, 'g> {
    /// P Z of the outer joint.
    pub(super) unit: Wrench<'g>,
    /// The projection of B on the outer joint, per component of the inner joint's turning.
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

impl<'g> Composites<'g> {
    pub(super) fn new(frames: &Frames<'_, 'g>, motions: &Motions<'g>) -> Composites<'g> {
        let graph = frames.chain.graph;
        let inertias = composites(frames);
        let at_rest = vec![Momentum::zero(graph); frames.chain.links.len()];
        // Relative to the parent, the link and all that it carries move with the joint.
        let momenta = gather_across(frames, at_rest, |index, momentum: &Momentum<'g>| {
            let link = &frames.chain.links[index];
            let along = Vector::along_z(link.motion.velocity * motions.factor);
            let zero = Vector::zero(graph);
            let motion = match link.kind {
                JointKind::Revolute => Twist { angular: along, linear: zero },
                JointKind::Prismatic => Twist { angular: zero, linear: along },
            };
            momentum.plus(&Momentum::of_body(&motion, &inertias[index]))
        });
        Composites { inertias, momenta }
    }

    /// ⟨·, Y P + Z B⟩ = ⟨·, V Z P + Z B'⟩ with B' relative to the link.
    pub(super) fn of_velocity<'m>(
        &self,
        frames: &Frames<'_, 'g>,
        motions: &'m Motions<'g>,
        index: usize,
    ) -> Load<'m, 'g> {
        let (inertia, momentum) = (&self.inertias[index], &self.momenta[index]);
        let motion = &motions.links[index];
        let own = match frames.chain.links[index].kind {
            JointKind::Revolute => {
                let by_turning = turning_of_turned(inertia, motion.scaled_omega);
                by_turning.plus(&momentum.wrench_of_unit_rate(motion.unit.angular))
            }
            JointKind::Prismatic => inertial_wrench(inertia, &motion.rate),
        };
        Load { own, ..self.common(motions, index) }
    }

    /// ⟨·, \[A, Z\] P + 2 Y B'⟩, and the whole wrench turning along with the joint.
    pub(super) fn of_position<'m>(
        &self,
        frames: &Frames<'_, 'g>,
        motions: &'m Motions<'g>,
        index: usize,
        whole: &Wrench<'g>,
    ) -> Load<'m, 'g> {
        let (inertia, momentum) = (&self.inertias[index], &self.momenta[index]);
        let motion = &motions.links[index];
        let shifted = match frames.chain.links[index].kind {
            JointKind::Revolute => shifted_about_z(inertia, motion),
            JointKind::Prismatic => inertial_wrench(inertia, &motion.shift),
        };
        let by_turning = momentum.wrench_of_unit_rate(motion.turning);
        let along = whole.carried_by(&motion.unit);
        let own = along.plus(&shifted.plus(&by_turning));
        Load { own, ..self.common(motions, index) }
    }

    fn common<'m>(&self, motions: &'m Motions<'g>, index: usize) -> Load<'m, 'g> {
        let (inertia, motion) = (&self.inertias[index], &motions.links[index]);
        let unit = inertial_wrench(inertia, &motion.unit);
        let relative = self.momenta[index].project(&motion.unit);
        // Of the link's own motion: (ω × z) · Σ of a rotation, (ω × h) × z of a translation.
        let carried = inertia.second * motion.rate.angular
            + motion.scaled_omega.cross(inertia.first).cross(motion.unit.linear);
        Load {
            unit,
            projected: carried + relative,
            own: Wrench::zero(inertia.mass.graph()),
            motions: &motions.links,
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

/// The wrench of \[A, Z\] P of a rotation, with A of the link.
fn shifted_about_z<'g>(inertia: &PseudoInertia<'g>, motion: &JointMotion<'g>) -> Wrench<'g> {
    let Vector([x, y, z]) = motion.omega;
    let Vector([u, v, _]) = motion.shift.angular;
    let linear = motion.acceleration.cross(motion.unit.angular);
    // U \[z\]× − \[z\]× U: with U₁₂ + U₂₁ and U₂₂ − U₁₁ in the plane, U's third column, and its third row, which is
    // the third column's mirror image but for twice the products of velocities.
    let (mixed, difference) = ((x * y) * 2, y * y - x * x);
    let (u31, u32) = ((x * 2) * z - u, (y * 2) * z - v);
    let Matrix([[xx, xy, xz], [_, yy, yz], [_, _, zz]]) = inertia.second;
    let Vector([hx, hy, hz]) = inertia.first;
    let moment = Vector([
        (u32 * xy - u31 * yy) + (mixed * yz - difference * xz) + u * zz,
        (u31 * xy - u32 * xx) + (mixed * xz + difference * yz) + v * zz,
        difference * (xx - yy) - mixed * (xy * 2) - (u * xz + v * yz),
    ]);
    let force = Vector([
        (mixed * hx + difference * hy) + v * hz,
        (difference * hx - mixed * hy) - u * hz,
        u32 * hx - u31 * hy,
    ]);
    Wrench { force: force + linear * inertia.mass, moment: moment + inertia.first.cross(linear) }
}
