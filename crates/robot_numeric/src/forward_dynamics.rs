//! Forward dynamics by the mass matrix and by the articulated-body algorithm.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix6, Vector3, Vector6};
use robot_model::variable::JointVariable::Torque;

use super::{
    error::NumericError,
    kinematics::Configuration,
    mechanism::{Link, Mechanism, Wrench},
    newton_euler::{exerted, inverse_dynamics},
    scalar::Number,
    spatial::{cross_force, cross_motion, rigid_body_inertia, spatial},
};

/// A link with everything that it carries: the force that accelerates it by a is `inertia` a + `bias`.
#[derive(Clone, Copy)]
struct Articulated<T: Number> {
    inertia: Matrix6<T>,
    bias: Vector6<T>,
}

/// The results of the inward pass that the outward pass needs.
#[derive(Clone, Copy)]
struct Resistance<T: Number> {
    /// I^A S.
    force: Vector6<T>,
    /// Sᵀ I^A S plus the rotor inertia, and the part of the torque that accelerates the joint.
    inertia: T,
    torque: T,
}

/// Computes the joint accelerations by the articulated-body algorithm for any kind of numbers (R. Featherstone, "Rigid
/// Body Dynamics Algorithms", 2008, Table 7.1). Each slice has one entry per coordinate, and each coordinate drives
/// only one joint. `None` if a joint has no inertia.
pub(super) fn articulated_body<T: Number>(
    mechanism: &Mechanism,
    q: &[T],
    qd: &[T],
    tau: &[T],
    wrenches: &[Wrench],
) -> Option<Vec<T>> {
    let transforms = Configuration::new(mechanism, q).transforms;
    let links = mechanism.links();
    let (mut bodies, drifts) = free_bodies(mechanism, &transforms, qd, wrenches);
    let mut resistances: Vec<Option<Resistance<T>>> = vec![None; links.len()];
    for (index, link) in links.iter().enumerate().rev() {
        let Articulated { mut inertia, bias } = bodies[index];
        let mut passed_on = bias;
        if let Some(coordinate) = link.joint.driver() {
            let resistance = resist(link, &bodies[index], tau[coordinate])?;
            let Resistance { force, inertia: scalar, torque } = resistance;
            inertia -= force * force.transpose() / scalar;
            passed_on += force * (torque / scalar);
            resistances[index] = Some(resistance);
        }
        passed_on += inertia * drifts[index];
        if let Some(parent) = link.parent {
            let x = &transforms[index];
            bodies[parent].inertia += x.transpose() * inertia * x;
            bodies[parent].bias += x.transpose() * passed_on;
        }
    }
    let base = spatial(&Vector3::zeros(), &mechanism.gravity().map(|g| T::from_real(-g)));
    let mut accelerations: Vec<Vector6<T>> = Vec::with_capacity(links.len());
    let mut qdd = vec![T::zero(); mechanism.coordinates()];
    for (index, link) in links.iter().enumerate() {
        let outer = link.parent.map_or(base, |parent| accelerations[parent]);
        let mut acceleration = transforms[index] * outer + drifts[index];
        if let (Some(coordinate), Some(joint)) = (link.joint.driver(), &resistances[index]) {
            qdd[coordinate] = (joint.torque - joint.force.dot(&acceleration)) / joint.inertia;
            acceleration += link.joint.subspace() * qdd[coordinate];
        }
        accelerations.push(acceleration);
    }
    Some(qdd)
}

/// The first pass: the inertia and bias of each link alone, and its velocity-product acceleration.
fn free_bodies<T: Number>(
    mechanism: &Mechanism,
    transforms: &[Matrix6<T>],
    qd: &[T],
    wrenches: &[Wrench],
) -> (Vec<Articulated<T>>, Vec<Vector6<T>>) {
    let mut velocities: Vec<Vector6<T>> = Vec::with_capacity(transforms.len());
    let (mut bodies, mut drifts) = (Vec::new(), Vec::new());
    for ((link, x), load) in
        mechanism.links().iter().zip(transforms).zip(exerted(mechanism, wrenches))
    {
        let mut velocity = link.parent.map_or(Vector6::zeros(), |parent| x * velocities[parent]);
        let mut drift = Vector6::zeros();
        if let Some(coordinate) = link.joint.driver() {
            let joint_velocity = link.joint.subspace() * qd[coordinate];
            velocity += joint_velocity;
            drift = cross_motion(&velocity) * joint_velocity;
        }
        let inertia = rigid_body_inertia(link);
        let bias = cross_force(&velocity) * (inertia * velocity) + load;
        bodies.push(Articulated { inertia, bias });
        drifts.push(drift);
        velocities.push(velocity);
    }
    (bodies, drifts)
}

fn resist<T: Number>(link: &Link, body: &Articulated<T>, tau: T) -> Option<Resistance<T>> {
    let subspace = link.joint.subspace();
    let force = body.inertia * subspace;
    let inertia = subspace.dot(&force) + T::from_real(link.rotor_on_coordinate());
    let resists = inertia.real() > 0.0;
    resists.then(|| Resistance { force, inertia, torque: tau - subspace.dot(&body.bias) })
}

impl Mechanism {
    /// The accelerations q̈ that the joint torques τ cause at positions q and velocities q̇, with one wrench for each
    /// frame (or none at all) and without friction (subtract friction from τ to include it): the solution of M q̈ = τ −
    /// h by a Cholesky decomposition of M.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length,
    /// [`NumericError::NotPositiveDefinite`] if M is not positive definite.
    pub fn forward_dynamics(
        &self,
        q: &[f64],
        qd: &[f64],
        tau: &[f64],
        wrenches: &[Wrench],
    ) -> Result<DVector<f64>, NumericError> {
        self.check_state(q, qd, (Torque.name(), tau), wrenches)?;
        let bias = inverse_dynamics(self, q, qd, &vec![0.0; q.len()], wrenches);
        let excess = DVector::from_column_slice(tau) - DVector::from_vec(bias);
        Ok(self.decomposed_mass_matrix(q)?.solve(&excess))
    }

    /// The accelerations by the articulated-body algorithm, which does not compute the mass matrix.
    ///
    /// # Errors
    ///
    /// The errors of [`Mechanism::forward_dynamics`], and [`NumericError::SharedCoordinate`] if a coordinate
    /// moves several joints.
    pub fn articulated_body(
        &self,
        q: &[f64],
        qd: &[f64],
        tau: &[f64],
        wrenches: &[Wrench],
    ) -> Result<DVector<f64>, NumericError> {
        self.check_state(q, qd, (Torque.name(), tau), wrenches)?;
        let mut joints = vec![0; self.coordinates()];
        for coordinate in self.links().iter().filter_map(|link| link.joint.driver()) {
            joints[coordinate] += 1;
            if joints[coordinate] > 1 {
                return Err(NumericError::SharedCoordinate { coordinate });
            }
        }
        articulated_body(self, q, qd, tau, wrenches)
            .map(DVector::from_vec)
            .ok_or(NumericError::NotPositiveDefinite)
    }

    /// The inverse mass matrix M⁻¹(q), n × n: its columns are the accelerations for unit torques.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length,
    /// [`NumericError::NotPositiveDefinite`] if M is not positive definite.
    pub fn inverse_mass_matrix(&self, q: &[f64]) -> Result<DMatrix<f64>, NumericError> {
        Ok(self.decomposed_mass_matrix(q)?.inverse())
    }

    pub(super) fn decomposed_mass_matrix(
        &self,
        q: &[f64],
    ) -> Result<Cholesky<f64, Dyn>, NumericError> {
        Cholesky::new(self.mass_matrix(q)?).ok_or(NumericError::NotPositiveDefinite)
    }
}
