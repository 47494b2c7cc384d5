//! Kinetic and potential energy.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::Recursion;
use crate::economical::composite::gravity::weight_in_base;
use crate::economical::frames::Frames;
use crate::vector::{Matrix, Vector};

impl<'g> Recursion<'g> {
    /// The kinetic energy, including drives, J. Regrouping does not change it, because inertia is only moved between
    /// links if it moves with both of them.
    #[must_use]
    pub fn kinetic_energy(&self) -> Expr<'g> {
        let chain = &self.chain.without_idle_turns(&[]);
        let frames = Frames::new(chain, |index| self.plans[index].angle_sum);
        // The angular velocity in home axes and own axes, and the velocity of the origin in own axes.
        let (mut home, mut own): (Vec<Vector<'g>>, Vec<Vector<'g>>) = (vec![], vec![]);
        let mut velocities: Vec<Vector<'g>> = vec![];
        let mut twice = chain.graph.zero();
        for (index, link) in chain.links.iter().enumerate() {
            let joint_frame = &frames.joint_frames[index];
            let zero = Vector::zero(chain.graph);
            let (mut at_home, carried) = match link.parent {
                Some(parent) => {
                    let moved = velocities[parent] + own[parent].cross(joint_frame.origin);
                    let omega = if frames.is_joined(index) {
                        home[parent]
                    } else {
                        link.rotation.back(own[parent])
                    };
                    (omega, link.rotation.back(moved))
                }
                None => (zero, zero),
            };
            let mut velocity = joint_frame.turn.back(carried);
            match link.kind {
                JointKind::Revolute => {
                    at_home.0[2] += link.motion.velocity;
                }
                JointKind::Prismatic => {
                    velocity.0[2] += link.motion.velocity;
                }
            }
            let omega = joint_frame.group_turn.back(at_home);
            home.push(at_home);
            own.push(omega);
            velocities.push(velocity);
            let (Vector(h), m) = (link.inertia.first, link.inertia.mass);
            // ∫ (v + ω × r)² dm
            let mixed = omega.cross(Vector(h)).dot(velocity) * 2 + velocity.dot(velocity) * m;
            twice += of_second(link.inertia.second, omega) + mixed;
            let rate = chain.in_meters(link, link.motion.velocity);
            twice += link.reflected_inertia * (rate * rate);
            if let Some(parent) = link.parent {
                // J N q̇ a · ω, with ω of the carrier.
                twice += link.rotor_coupling * rate * own[parent].dot(link.axis) * 2;
            }
        }
        twice / 2
    }

    /// The gravitational potential energy, J; it is 0 if all mass is at the origin of the base frame.
    #[must_use]
    pub fn potential_energy(&self) -> Expr<'g> {
        weight_in_base(&self.chain.without_idle_turns(&[]), &self.plans)
    }
}

/// The quadratic form ωᵀ (tr(Σ) 1 − Σ) ω.
fn of_second<'g>(Matrix(s): Matrix<'g>, Vector([x, y, z]): Vector<'g>) -> Expr<'g> {
    let squares =
        x * x * (s[1][1] + s[2][2]) + y * y * (s[0][0] + s[2][2]) + z * z * (s[0][0] + s[1][1]);
    let mixed = x * (s[0][1] * y + s[0][2] * z) + s[1][2] * (y * z);
    squares - mixed * 2
}
