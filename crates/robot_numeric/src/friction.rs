//! Friction in the joints.

use nalgebra::{DVector, Vector3};

use super::{
    error::NumericError,
    mechanism::{JointKind, Link, Mechanism, Wrench},
    newton_euler::LinkDynamics,
};

/// The form of the sign of a velocity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Sign {
    /// The exact sign sgn q̇, with sgn 0 = 0.
    #[default]
    Exact,
    /// The smooth sign tanh(q̇ / w) with the width w > 0 (rad/s or m/s): at q̇ = w, friction has 0.76 of its full
    /// value.
    Smooth(f64),
}

/// The friction in a joint, as the torque or force that the drive must overcome.
///
/// With the joint velocity q̇, the joint axis k and the force F_l that the joint transmits:
///
/// Q_f = b q̇ + c (d/2) |k × F_l| sgn q̇ + C± sgn q̇ + o for a revolute joint,
/// Q_f = b q̇ + c |k × F_l| sgn q̇ + C± sgn q̇ + o for a prismatic joint.
///
/// The first two terms are equations (4) and (5) of the paper on TRTTR1. The constant friction C± is `constant[0]` for
/// q̇ > 0 and `constant[1]` for q̇ < 0. With a smooth sign s instead of sgn q̇, its term is s (C₊ + C₋)/2 + s² (C₊ −
/// C₋)/2, which is the same for s = ±1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Friction {
    /// The coefficient of viscous friction b, N m s/rad or N s/m.
    pub viscous: f64,
    /// The coefficient of load-dependent dry friction c, without unit.
    pub coulomb: f64,
    /// The journal diameter d of a revolute joint, m.
    pub spindle_diameter: f64,
    /// The constant dry friction, C₊ and C₋, each ≥ 0, N m or N.
    pub constant: [f64; 2],
    /// A constant torque or force o, N m or N.
    pub offset: f64,
    /// The form of the sign of the velocity.
    pub sign: Sign,
}

impl Friction {
    /// All numbers of the friction.
    pub(super) fn numbers(&self) -> [f64; 7] {
        let width = if let Sign::Smooth(width) = self.sign { width } else { 0.0 };
        let [forward, backward] = self.constant;
        [self.viscous, self.coulomb, self.spindle_diameter, forward, backward, self.offset, width]
    }

    /// The sign of a velocity in the form of this friction.
    pub(super) fn sign_of(&self, velocity: f64) -> f64 {
        match self.sign {
            Sign::Smooth(width) => (velocity / width).tanh(),
            Sign::Exact if velocity == 0.0 => 0.0,
            Sign::Exact => velocity.signum(),
        }
    }

    /// The friction Q_f of a joint of the given kind and axis with the given velocity and transmitted force.
    fn torque(
        &self,
        kind: JointKind,
        axis: &Vector3<f64>,
        velocity: f64,
        force: &Vector3<f64>,
    ) -> f64 {
        let lever = match kind {
            JointKind::Revolute => self.spindle_diameter / 2.0,
            JointKind::Prismatic | JointKind::Fixed => 1.0,
        };
        let sign = self.sign_of(velocity);
        let [forward, backward] = self.constant;
        self.viscous * velocity
            + self.coulomb * lever * axis.cross(force).norm() * sign
            + (forward + backward) / 2.0 * sign
            + (forward - backward) / 2.0 * sign * sign
            + self.offset
    }
}

/// The friction Q_f of each coordinate, N m or N, for the given contact forces of the joints.
pub(super) fn torques(mechanism: &Mechanism, qd: &[f64], loads: &[LinkDynamics]) -> DVector<f64> {
    let mut torques = DVector::zeros(mechanism.coordinates());
    for (link, load) in mechanism.links().iter().zip(loads) {
        let Link { joint, friction, .. } = link;
        if let Some(coordinate) = joint.driver() {
            let velocity = joint.ratio * qd[coordinate];
            let torque = friction.torque(joint.kind, &joint.axis, velocity, &load.contact_force);
            torques[coordinate] += joint.ratio * torque;
        }
    }
    torques
}

impl Mechanism {
    /// The friction torques Q_f (N m or N), which the drives must overcome, at positions q, velocities q̇ and
    /// accelerations q̈, with one wrench for each frame (or none at all).
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn friction_torques(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        wrenches: &[Wrench],
    ) -> Result<DVector<f64>, NumericError> {
        Ok(torques(self, qd, &self.link_dynamics(q, qd, qdd, wrenches)?))
    }
}
