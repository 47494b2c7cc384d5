//! Inverse dynamics: the recursive Newton-Euler algorithm in link coordinates, Table 5.1 of
//! R. Featherstone, "Rigid Body Dynamics Algorithms", 2008.

use nalgebra::{DVector, Matrix3, Vector3, Vector6};
use robot_model::variable::JointVariable::{Acceleration, Position, Velocity};

use super::{
    error::{NumericError, check_lengths},
    friction,
    kinematics::Configuration,
    mechanism::{Mechanism, Wrench},
    scalar::Number,
    spatial::{
        angular, cross_force, cross_motion, linear, motion_transform, rigid_body_inertia, spatial,
    },
};

/// The spatial velocities and accelerations of the links, in link coordinates.
pub(super) struct Motions<T: Number> {
    pub(super) velocities: Vec<Vector6<T>>,
    pub(super) accelerations: Vec<Vector6<T>>,
}

/// The outward pass, for a base with the given linear acceleration.
pub(super) fn outward<T: Number>(
    mechanism: &Mechanism,
    configuration: &Configuration<T>,
    qd: &[T],
    qdd: &[T],
    base_acceleration: &Vector3<f64>,
) -> Motions<T> {
    let base = spatial(&Vector3::zeros(), &base_acceleration.map(T::from_real));
    let mut velocities: Vec<Vector6<T>> = Vec::new();
    let mut accelerations: Vec<Vector6<T>> = Vec::new();
    for (link, x) in mechanism.links().iter().zip(&configuration.transforms) {
        let mut velocity = link.parent.map_or(Vector6::zeros(), |parent| x * velocities[parent]);
        let mut acceleration = x * link.parent.map_or(base, |parent| accelerations[parent]);
        if let Some(coordinate) = link.joint.driver() {
            let subspace = link.joint.subspace();
            let joint_velocity = subspace * qd[coordinate];
            velocity += joint_velocity;
            acceleration += subspace * qdd[coordinate] + cross_motion(&velocity) * joint_velocity;
        }
        velocities.push(velocity);
        accelerations.push(acceleration);
    }
    Motions { velocities, accelerations }
}

/// The inward pass: the force that each joint transmits to its link, in link coordinates.
pub(super) fn inward<T: Number>(
    mechanism: &Mechanism,
    configuration: &Configuration<T>,
    motions: &Motions<T>,
    wrenches: &[Wrench],
) -> Vec<Vector6<T>> {
    let mut forces = exerted(mechanism, wrenches);
    for (index, link) in mechanism.links().iter().enumerate().rev() {
        let inertia = rigid_body_inertia(link);
        let velocity = &motions.velocities[index];
        forces[index] +=
            inertia * motions.accelerations[index] + cross_force(velocity) * (inertia * velocity);
        if let Some(parent) = link.parent {
            let passed_on = configuration.transforms[index].transpose() * forces[index];
            forces[parent] += passed_on;
        }
    }
    forces
}

/// The wrench that each link exerts on its surroundings through the frames on it, in link coordinates.
pub(super) fn exerted<T: Number>(mechanism: &Mechanism, wrenches: &[Wrench]) -> Vec<Vector6<T>> {
    let mut forces = vec![Vector6::zeros(); mechanism.links().len()];
    for (frame, wrench) in mechanism.frames().iter().zip(wrenches) {
        if let Some(link) = frame.link {
            let force = spatial(&wrench.moment, &wrench.force);
            let in_link = motion_transform(&frame.placement).transpose() * force;
            forces[link] += in_link.map(T::from_real);
        }
    }
    forces
}

/// The joint torques of the coordinates: the components of the transmitted forces along the joints, plus the torques
/// that accelerate the rotors.
pub(super) fn project<T: Number>(
    mechanism: &Mechanism,
    forces: &[Vector6<T>],
    qdd: &[T],
) -> Vec<T> {
    let mut torques = vec![T::zero(); mechanism.coordinates()];
    for (link, force) in mechanism.links().iter().zip(forces) {
        if let Some(coordinate) = link.joint.driver() {
            torques[coordinate] += link.joint.subspace().dot(force)
                + qdd[coordinate] * T::from_real(link.rotor_on_coordinate());
        }
    }
    torques
}

/// Inverse dynamics for any kind of numbers; the lengths must be right.
pub(super) fn inverse_dynamics<T: Number>(
    mechanism: &Mechanism,
    q: &[T],
    qd: &[T],
    qdd: &[T],
    wrenches: &[Wrench],
) -> Vec<T> {
    let configuration = Configuration::new(mechanism, q);
    let motions = outward(mechanism, &configuration, qd, qdd, &-mechanism.gravity());
    project(mechanism, &inward(mechanism, &configuration, &motions, wrenches), qdd)
}

/// The name, expected length and actual length of the wrenches: there must be one for each frame, or none at all.
pub(super) fn wrench_length(
    mechanism: &Mechanism,
    wrenches: &[Wrench],
) -> (&'static str, usize, usize) {
    let expected = if wrenches.is_empty() { 0 } else { mechanism.frames().len() };
    ("wrenches", expected, wrenches.len())
}

/// What the joint torques include besides inertia and gravity.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loads {
    /// The wrench that each frame exerts on its surroundings: one for each frame, or none at all.
    pub wrenches: Vec<Wrench>,
    /// Whether the friction in the joints is included.
    pub friction: bool,
}

/// The motion of a link and the forces on it, in the notation of the paper on TRTTR1: vectors are in the axes of the
/// link frame, and the base has the acceleration −g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkDynamics {
    /// Angular velocity ω, rad/s.
    pub angular_velocity: Vector3<f64>,
    /// Velocity of the origin of the link frame, m/s.
    pub velocity: Vector3<f64>,
    /// Angular acceleration ε, rad/s².
    pub angular_acceleration: Vector3<f64>,
    /// Acceleration a of the origin of the link frame minus the acceleration of gravity, m/s².
    pub acceleration: Vector3<f64>,
    /// Acceleration of the center of mass minus the acceleration of gravity, m/s²: a_c = a + ε × r_c + ω × (ω × r_c),
    /// equation (8).
    pub center_acceleration: Vector3<f64>,
    /// F = M a_c, N, equations (14)-(19).
    pub inertial_force: Vector3<f64>,
    /// M_c = J ε + ω × J ω about the center of mass, N m, equations (20)-(24).
    pub inertial_moment: Vector3<f64>,
    /// F_l: the force that the joint transmits from the parent to the link, N, equations (26)-(35).
    pub contact_force: Vector3<f64>,
    /// M_l: the moment that the joint transmits, about the origin of the link frame, N m, equations (36)-(51).
    pub contact_moment: Vector3<f64>,
}

impl LinkDynamics {
    fn new(
        (mass, center, inertia): (f64, &Vector3<f64>, &Matrix3<f64>),
        velocity: &Vector6<f64>,
        acceleration: &Vector6<f64>,
        force: &Vector6<f64>,
    ) -> Self {
        let (omega, epsilon) = (angular(velocity), angular(acceleration));
        let of_origin = linear(acceleration) + omega.cross(&linear(velocity));
        let of_center = of_origin + epsilon.cross(center) + omega.cross(&omega.cross(center));
        Self {
            angular_velocity: omega,
            velocity: linear(velocity),
            angular_acceleration: epsilon,
            acceleration: of_origin,
            center_acceleration: of_center,
            inertial_force: of_center * mass,
            inertial_moment: inertia * epsilon + omega.cross(&(inertia * omega)),
            contact_force: linear(force),
            contact_moment: angular(force),
        }
    }
}

impl Mechanism {
    /// The joint torques τ (N m or N) that cause the accelerations q̈ at positions q and velocities q̇, without
    /// wrenches and friction.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn inverse_dynamics(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
    ) -> Result<DVector<f64>, NumericError> {
        self.inverse_dynamics_with(q, qd, qdd, &Loads::default())
    }

    /// Inverse dynamics with wrenches at the frames and with friction.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn inverse_dynamics_with(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        loads: &Loads,
    ) -> Result<DVector<f64>, NumericError> {
        let wrenches = &loads.wrenches;
        self.check_state(q, qd, (Acceleration.name(), qdd), wrenches)?;
        let torques = DVector::from_vec(inverse_dynamics(self, q, qd, qdd, wrenches));
        if loads.friction {
            let links = self.link_dynamics(q, qd, qdd, wrenches)?;
            return Ok(torques + friction::torques(self, qd, &links));
        }
        Ok(torques)
    }

    /// The joint torques g(q) that hold the mechanism at rest against gravity.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn gravity_torques(&self, q: &[f64]) -> Result<DVector<f64>, NumericError> {
        check_lengths(&[(Position.name(), self.coordinates(), q.len())])?;
        let still = vec![0.0; q.len()];
        self.inverse_dynamics(q, &still, &still)
    }

    /// The bias torques h = C(q, q̇) q̇ + g(q): the joint torques at zero acceleration.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn bias(&self, q: &[f64], qd: &[f64]) -> Result<DVector<f64>, NumericError> {
        let n = self.coordinates();
        check_lengths(&[(Position.name(), n, q.len()), (Velocity.name(), n, qd.len())])?;
        self.inverse_dynamics(q, qd, &vec![0.0; n])
    }

    /// The motion of every link and the forces on it, with one wrench for each frame (or none at all), without
    /// friction: ω, ε, a, a_c, F, M_c, F_l and M_l of the paper.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn link_dynamics(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        wrenches: &[Wrench],
    ) -> Result<Vec<LinkDynamics>, NumericError> {
        self.check_state(q, qd, (Acceleration.name(), qdd), wrenches)?;
        let configuration = Configuration::new(self, q);
        let motions = outward(self, &configuration, qd, qdd, &-self.gravity());
        let forces = inward(self, &configuration, &motions, wrenches);
        let of_link = |(index, force): (usize, &Vector6<f64>)| {
            let link = &self.links()[index];
            LinkDynamics::new(
                (link.mass, &link.center_of_mass, &link.inertia),
                &motions.velocities[index],
                &motions.accelerations[index],
                force,
            )
        };
        Ok(forces.iter().enumerate().map(of_link).collect())
    }

    /// Checks the lengths of the arguments that most functions have in common; the third is q̈ or τ.
    pub(super) fn check_state(
        &self,
        q: &[f64],
        qd: &[f64],
        (name, third): (&'static str, &[f64]),
        wrenches: &[Wrench],
    ) -> Result<(), NumericError> {
        let n = self.coordinates();
        check_lengths(&[
            (Position.name(), n, q.len()),
            (Velocity.name(), n, qd.len()),
            (name, n, third.len()),
            wrench_length(self, wrenches),
        ])
    }
}
