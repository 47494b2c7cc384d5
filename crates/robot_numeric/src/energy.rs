//! Kinetic and potential energy.

use super::{
    error::{NumericError, check_lengths},
    mechanism::Mechanism,
};
use robot_model::variable::JointVariable::{Position, Velocity};

/// The kinetic and potential energy, J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// The kinetic energy of the links and rotors.
    pub kinetic: f64,
    /// The potential energy −Σ m gᵀ c, with the centers of mass c in the base frame; it is zero at the origin of the
    /// base.
    pub potential: f64,
}

impl Mechanism {
    /// The kinetic and potential energy at positions q and velocities q̇, summed over the links from the velocities of
    /// their centers of mass.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn energies(&self, q: &[f64], qd: &[f64]) -> Result<Energies, NumericError> {
        let n = self.coordinates();
        check_lengths(&[(Position.name(), n, q.len()), (Velocity.name(), n, qd.len())])?;
        let poses = self.forward_kinematics(q)?.links;
        let motions = self.link_dynamics(q, qd, &vec![0.0; n], &[])?;
        let mut energies = Energies { kinetic: 0.0, potential: 0.0 };
        for ((link, pose), motion) in self.links().iter().zip(&poses).zip(&motions) {
            let omega = motion.angular_velocity;
            let velocity = motion.velocity + omega.cross(&link.center_of_mass);
            let twice = link.mass * velocity.norm_squared() + omega.dot(&(link.inertia * omega));
            energies.kinetic += twice / 2.0;
            if let Some(coordinate) = link.joint.driver() {
                energies.kinetic += link.rotor_on_coordinate() * qd[coordinate].powi(2) / 2.0;
            }
            let center = pose.rotation * link.center_of_mass + pose.translation;
            energies.potential -= link.mass * self.gravity().dot(&center);
        }
        Ok(energies)
    }
}
