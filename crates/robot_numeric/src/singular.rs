//! Singular mass matrices: the accelerations that the joint torques do not determine.

use nalgebra::{DMatrix, SymmetricEigen};

use super::error::NumericError;
use super::mechanism::Mechanism;

/// The fraction of the largest inertia below which a motion counts as having no inertia; rounding errors are a thousand
/// times smaller.
const NOTHING: f64 = 1e-13;
/// A coordinate takes part in a motion if its component exceeds this fraction of the motion.
const SHARE: f64 = 1e-4;

impl Mechanism {
    /// The indices, from 0, of the coordinates whose accelerations the joint torques do not determine at q because the
    /// mass matrix is singular; empty if it is nonsingular.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn undetermined(&self, q: &[f64]) -> Result<Vec<usize>, NumericError> {
        let matrix = self.mass_matrix(q)?;
        let most = matrix.diagonal().iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        // The units of rotations and translations differ, so each row is scaled by its own inertia.
        let scale = |index: usize| matrix[(index, index)].abs().max(NOTHING * most).sqrt().recip();
        let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| {
            matrix[(row, column)] * scale(row) * scale(column)
        });
        if most == 0.0 {
            return Ok((0..q.len()).collect());
        }
        if scaled.iter().any(|entry| !entry.is_finite()) {
            return Ok(Vec::new());
        }
        let eigen = SymmetricEigen::new(scaled);
        let mut found: Vec<usize> = (0..q.len())
            .filter(|index| {
                let is_null = |value: f64| value.abs() <= NOTHING * q.len() as f64;
                let of_null = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
                let mut of_null = of_null.filter(|(value, _)| is_null(**value));
                matrix[(*index, *index)].abs() <= NOTHING * most
                    || of_null.any(|(_, vector)| vector[*index].abs() > SHARE)
            })
            .collect();
        found.sort_unstable();
        Ok(found)
    }
}
