//! Accelerations that the joint torques do not determine because the mass matrix is singular in every configuration.

use robot_model::robot::Robot;
use robot_symbolic::Random;

use super::sampled::{Rows, SampledMassMatrix};

/// Entries below this fraction of the largest entry are taken as rounding errors.
const NOTHING: f64 = 1e-13;
/// A coordinate takes part in a motion if its component exceeds this fraction of the motion.
const SHARE: f64 = 1e-4;
/// The number of configurations to try, because a mass matrix may be singular in a single configuration by chance.
const CONFIGURATIONS: usize = 3;
const SEED: u64 = 1;

/// The indices, from 0, of the coordinates whose accelerations the joint torques do not determine in any configuration,
/// at the nominal parameters. Empty if the mass matrix is nonsingular in some configuration, or if a parameter has no
/// nominal value.
#[must_use]
pub fn undetermined(robot: &Robot) -> Vec<usize> {
    if robot.parameters.iter().any(|parameter| parameter.value.is_none()) {
        return Vec::new();
    }
    let matrix = SampledMassMatrix::new(robot);
    let mut random = Random::new(SEED);
    let mut found: Vec<usize> = (0..matrix.order()).collect();
    for _ in 0..CONFIGURATIONS {
        let here = of_matrix(&matrix.at(&matrix.configuration(&mut random)));
        found.retain(|coordinate| here.contains(coordinate));
        // One configuration with a nonsingular mass matrix is enough. It is important to stop here, because every build
        // calls this function.
        if found.is_empty() {
            break;
        }
    }
    found
}

/// The coordinates that take part in the null space of a symmetric matrix.
fn of_matrix(matrix: &Rows) -> Vec<usize> {
    let order = matrix.len();
    let most = (0..order).fold(0.0_f64, |most, row| most.max(matrix[row][row].abs()));
    if matrix.iter().flatten().any(|entry| !entry.is_finite()) {
        return Vec::new();
    }
    if most == 0.0 {
        return (0..order).collect();
    }
    // The units of rotations and translations differ, so each row is scaled by its own inertia.
    let scale: Vec<f64> =
        (0..order).map(|row| matrix[row][row].abs().max(NOTHING * most).sqrt().recip()).collect();
    let vanishes = |row: &usize| matrix[*row][*row].abs() <= NOTHING * most;
    let vanishing: Vec<usize> = (0..order).filter(vanishes).collect();
    let scaled = matrix.iter().enumerate().map(|(row, entries)| {
        let entries = entries.iter().enumerate();
        entries.map(|(column, entry)| entry * scale[row] * scale[column]).collect()
    });
    let (rows, pivots) = reduced(scaled.collect());
    let is_free = |column: &usize| !pivots.contains(column);
    let moves = |coordinate: &usize| {
        let Some(row) = pivots.iter().position(|pivot| pivot == coordinate) else { return true };
        (0..order).filter(is_free).any(|free| rows[row][free].abs() > SHARE)
    };
    (0..order).filter(|one| vanishing.contains(one) || moves(one)).collect()
}

/// The matrix after Gauss–Jordan elimination with full pivoting: rows whose pivots are 1, and the columns of the
/// pivots.
fn reduced(mut matrix: Rows) -> (Rows, Vec<usize>) {
    let order = matrix.len();
    let mut pivots: Vec<usize> = vec![];
    while pivots.len() < order {
        let rank = pivots.len();
        let left = (rank..order).flat_map(|row| (0..order).map(move |column| (row, column)));
        let size = |(row, column): &(usize, usize)| matrix[*row][*column].abs();
        let largest = left.max_by(|a, b| size(a).total_cmp(&size(b)));
        let Some((row, column)) = largest.filter(|at| size(at) > NOTHING * order as f64) else {
            break;
        };
        matrix.swap(rank, row);
        let pivot = matrix[rank][column];
        matrix[rank].iter_mut().for_each(|entry| *entry /= pivot);
        let of_pivot = matrix[rank].clone();
        for (other, entries) in matrix.iter_mut().enumerate() {
            let factor = entries[column];
            if other != rank && factor != 0.0 {
                let pairs = entries.iter_mut().zip(&of_pivot);
                pairs.for_each(|(entry, pivot)| *entry -= factor * pivot);
            }
        }
        pivots.push(column);
    }
    (matrix, pivots)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_null_motion_names_the_coordinates_that_take_part() {
        // The first two coordinates move the same link, so the difference of their motions moves nothing.
        let alike = vec![vec![2.0, 2.0, 0.5], vec![2.0, 2.0, 0.5], vec![0.5, 0.5, 1.0]];
        assert_eq!(of_matrix(&alike), [0, 1]);
        let regular = vec![vec![2.0, 1.0], vec![1.0, 2.0]];
        assert_eq!(of_matrix(&regular), Vec::<usize>::new());
        let none = vec![vec![1.0, 0.0, 0.0], vec![0.0, 0.0, 0.0], vec![0.0, 0.0, 1e-6]];
        assert_eq!(of_matrix(&none), [1]);
        assert_eq!(of_matrix(&vec![vec![0.0; 2]; 2]), [0, 1]);
        assert_eq!(of_matrix(&vec![vec![f64::NAN; 2]; 2]), Vec::<usize>::new());
    }
}
