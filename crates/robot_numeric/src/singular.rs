//! Singular mass matrices: which accelerations no joint torques determine.

use nalgebra::{DMatrix, SymmetricEigen};

use super::error::NumericError;
use super::mechanism::Mechanism;

/// A motion with less than this part of the largest inertia has none: rounding is a thousand times smaller.
const NOTHING: f64 = 1e-13;
/// A coordinate with less than this part in a motion has none in it.
const SHARE: f64 = 1e-4;

impl Mechanism {
    /// The coordinates, from 0, whose accelerations the joint torques do not determine at q, as the mass
    /// matrix is singular there; none if it is not.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if q has the wrong length.
    pub fn undetermined(&self, q: &[f64]) -> Result<Vec<usize>, NumericError> {
        let matrix = self.mass_matrix(q)?;
        let most = matrix.diagonal().iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        // Rotations and translations differ in their units: each by its own inertia.
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
