//! The Coriolis matrix and the Christoffel symbols from which its entries follow.

use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};
use robot_model::variable::JointVariable::{Position, Velocity};

use super::{
    error::{NumericError, check_lengths},
    kinematics::Configuration,
    mass_matrix::mass_matrix,
    mechanism::Mechanism,
    newton_euler::outward,
    scalar::{derivative, step},
    spatial::{cross_force, cross_motion, cross_on, rigid_body_inertia},
};

/// The contribution of the links outward of a joint, gathered inward.
struct Composite {
    inertia: Matrix6<f64>,
    coriolis: Matrix6<f64>,
}

/// The matrix B with B v = v×* I v for which the sum of Jᵀ (I J̇ + B J) is the Coriolis matrix by Christoffel symbols:
/// ½ ((v×*) I + (I v)×̄* − I (v×)).
fn body_coriolis(inertia: &Matrix6<f64>, velocity: &Vector6<f64>) -> Matrix6<f64> {
    let turning = cross_force(velocity) * inertia - inertia * cross_motion(velocity);
    (turning + cross_on(&(inertia * velocity))) * 0.5
}

impl Mechanism {
    /// The Coriolis matrix C(q, q̇), n × n. C q̇ is the bias without gravity. The entries are those of the Christoffel
    /// symbols, so that Ṁ − 2 C is skew-symmetric.
    ///
    /// The recursion is that of S. Echeandia, P. M. Wensing, "Numerical Methods to Compute the Coriolis Matrix and
    /// Christoffel Symbols for Rigid-Body Systems", J. Comput. Nonlinear Dynam. 16 (2021).
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn coriolis_matrix(&self, q: &[f64], qd: &[f64]) -> Result<DMatrix<f64>, NumericError> {
        let n = self.coordinates();
        check_lengths(&[(Position.name(), n, q.len()), (Velocity.name(), n, qd.len())])?;
        let configuration = Configuration::new(self, q);
        let motions = outward(self, &configuration, qd, &vec![0.0; n], &Vector3::zeros());
        let velocities = &motions.velocities;
        let links = self.links();
        let mut composites: Vec<Composite> = links
            .iter()
            .zip(velocities)
            .map(|(link, velocity)| {
                let inertia = rigid_body_inertia(link);
                Composite { inertia, coriolis: body_coriolis(&inertia, velocity) }
            })
            .collect();
        let mut matrix = DMatrix::zeros(n, n);
        for (index, link) in links.iter().enumerate().rev() {
            let x = &configuration.transforms[index];
            let Composite { inertia, coriolis } = composites[index];
            if let Some(parent) = link.parent {
                composites[parent].inertia += x.transpose() * inertia * x;
                composites[parent].coriolis += x.transpose() * coriolis * x;
            }
            let Some(column) = link.joint.driver() else {
                continue;
            };
            let subspace: Vector6<f64> = link.joint.subspace();
            let rate = cross_motion(&velocities[index]) * subspace;
            let mut along = inertia * rate + coriolis * subspace;
            let mut momentum = inertia * subspace;
            let mut across = coriolis.transpose() * subspace;
            matrix[(column, column)] += subspace.dot(&along);
            let mut here = index;
            while let Some(parent) = links[here].parent {
                let back = configuration.transforms[here].transpose();
                (along, momentum, across) = (back * along, back * momentum, back * across);
                here = parent;
                let Some(row) = links[here].joint.driver() else {
                    continue;
                };
                let subspace: Vector6<f64> = links[here].joint.subspace();
                let rate = cross_motion(&velocities[here]) * subspace;
                matrix[(row, column)] += subspace.dot(&along);
                matrix[(column, row)] += rate.dot(&momentum) + subspace.dot(&across);
            }
        }
        Ok(matrix)
    }

    /// The derivatives ∂M/∂q_k for each coordinate k, exact to within rounding errors (complex step).
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn mass_matrix_derivatives(&self, q: &[f64]) -> Result<Vec<DMatrix<f64>>, NumericError> {
        check_lengths(&[(Position.name(), self.coordinates(), q.len())])?;
        let along = |k| mass_matrix(self, &Configuration::new(self, &step(q, k))).map(derivative);
        Ok((0..self.coordinates()).map(along).collect())
    }

    /// The Christoffel symbols of the first kind: a symmetric matrix Γ_k for each coordinate k. The k-th entry of C
    /// q̇ is q̇ᵀ Γ_k q̇, and C_kj is the j-th entry of Γ_k q̇, with (Γ_k)_ij = ½ (∂M_ki/∂q_j + ∂M_kj/∂q_i −
    /// ∂M_ij/∂q_k). They are exact to within rounding errors.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn christoffel_symbols(&self, q: &[f64]) -> Result<Vec<DMatrix<f64>>, NumericError> {
        let slopes = self.mass_matrix_derivatives(q)?;
        let n = self.coordinates();
        let symbol = |k: usize, i: usize, j: usize| {
            (slopes[j][(k, i)] + slopes[i][(k, j)] - slopes[k][(i, j)]) / 2.0
        };
        Ok((0..n).map(|k| DMatrix::from_fn(n, n, |i, j| symbol(k, i, j))).collect())
    }
}
