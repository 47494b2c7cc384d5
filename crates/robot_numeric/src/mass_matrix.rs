//! The mass matrix: the composite-rigid-body algorithm, Table 6.2 of R. Featherstone, "Rigid Body
//! Dynamics Algorithms", 2008.

use nalgebra::{DMatrix, Matrix6};
use robot_model::variable::JointVariable::Position;

use super::{
    error::{NumericError, check_lengths},
    kinematics::Configuration,
    mechanism::Mechanism,
    scalar::Number,
    spatial::rigid_body_inertia,
};

/// The mass matrix for any kind of numbers.
pub(super) fn mass_matrix<T: Number>(
    mechanism: &Mechanism,
    configuration: &Configuration<T>,
) -> DMatrix<T> {
    let links = mechanism.links();
    let transforms = &configuration.transforms;
    let mut composites: Vec<Matrix6<T>> = links.iter().map(rigid_body_inertia).collect();
    let mut matrix = DMatrix::zeros(mechanism.coordinates(), mechanism.coordinates());
    for (index, link) in links.iter().enumerate().rev() {
        let composite = composites[index];
        if let Some(parent) = link.parent {
            composites[parent] += transforms[index].transpose() * composite * transforms[index];
        }
        let Some(coordinate) = link.joint.driver() else {
            continue;
        };
        let subspace = link.joint.subspace();
        let mut force = composite * subspace;
        matrix[(coordinate, coordinate)] +=
            subspace.dot(&force) + T::from_real(link.rotor_on_coordinate());
        let mut here = index;
        while let Some(parent) = links[here].parent {
            force = transforms[here].transpose() * force;
            here = parent;
            let joint = &links[here].joint;
            if let Some(other) = joint.driver() {
                let element = joint.subspace().dot(&force);
                matrix[(coordinate, other)] += element;
                matrix[(other, coordinate)] += element;
            }
        }
    }
    matrix
}

impl Mechanism {
    /// The mass matrix M(q), n × n, symmetric, including rotors: τ = M q̈ + h.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn mass_matrix(&self, q: &[f64]) -> Result<DMatrix<f64>, NumericError> {
        check_lengths(&[(Position.name(), self.coordinates(), q.len())])?;
        Ok(mass_matrix(self, &Configuration::new(self, q)))
    }
}
