//! The derivatives of wrenches with respect to the positions of the joints that transmit them.

use robot_model::robot::JointKind;

use super::loads::Loads;
use super::motions::JointMotion;
use crate::economical::composite::inertial_wrench;
use crate::economical::spatial::Wrench;
use crate::economical::spatial::inertia::PseudoInertia;
use crate::vector::{Matrix, Vector};

impl<'g> Loads<'_, 'g> {
    /// The wrench of \[A, Z\] P + 2 Y B of the link, plus the change of the whole wrench because it turns with the
    /// joint.
    pub(super) fn of_shifted_links(&self, index: usize) -> Wrench<'g> {
        let motion = &self.motions.links[index];
        let inertia = &self.composites.inertias[index];
        let shifted = match self.frames.chain.links[index].kind {
            JointKind::Revolute => shifted_about_z(inertia, motion),
            JointKind::Prismatic => inertial_wrench(inertia, &motion.shift),
        };
        let by_turning = self.composites.to_links[index].wrench_of_unit_rate(motion.turning);
        let along = self.composites.whole[index].carried_by(&motion.unit);
        along.plus(&shifted.plus(&by_turning))
    }

    /// The derivative of A P + 2 V B + R, in which A and V belong to the carrier and P, B and R move with the joint.
    pub(super) fn of_moved_links(&self, index: usize) -> Wrench<'g> {
        let motion = &self.motions.links[index];
        let inertia = self.composites.inertias[index].rate(&motion.unit);
        let momentum = self.composites.to_carriers[index].rate(&motion.unit);
        let carrier = &motion.carrier;
        let by_inertia = wrench_of_field(&inertia, &carrier.tensor, carrier.acceleration);
        let by_momentum = momentum.wrench_of_unit_rate(carrier.omega);
        let along = self.composites.beyond[index].carried_by(&motion.unit);
        along.plus(&by_inertia.plus(&by_momentum))
    }
}

/// The wrench of \[A, Z\] P of a revolute joint, with A of the link.
fn shifted_about_z<'g>(inertia: &PseudoInertia<'g>, motion: &JointMotion<'g>) -> Wrench<'g> {
    let Vector([x, y, z]) = motion.omega;
    let Vector([u, v, _]) = motion.shift.angular;
    let linear = motion.shift.linear;
    // U \[z\]× − \[z\]× U. It consists of U₁₂ + U₂₁ and U₂₂ − U₁₁, of U's third column, and of U's third row, which
    // equals the third column except for signs and twice the products of velocities.
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

/// The wrench on masses with the pseudo-inertia `inertia` if the point at r has the acceleration a + U r.
fn wrench_of_field<'g>(
    inertia: &PseudoInertia<'g>,
    tensor: &Matrix<'g>,
    acceleration: Vector<'g>,
) -> Wrench<'g> {
    let (Matrix(s), Matrix(u)) = (inertia.second, tensor);
    let moment = Vector([0, 1, 2].map(|k| {
        let (p, q) = ((k + 1) % 3, (k + 2) % 3);
        (u[q][k] * s[k][p] - u[p][k] * s[k][q])
            + (u[q][p] * s[p][p] - u[p][q] * s[q][q])
            + (u[q][q] - u[p][p]) * s[p][q]
    }));
    Wrench {
        force: acceleration * inertia.mass + *tensor * inertia.first,
        moment: moment + inertia.first.cross(acceleration),
    }
}
