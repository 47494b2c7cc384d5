//! Bounds on the errors of the pivots from the mass matrix itself.

use robot_codegen::Rounded;

/// The number of joints above which a chain is long: up to it, the bounds that follow each operation of M are realistic.
const LONG: usize = 16;
/// A limit for the rounding errors, in units of u times the largest entry of M, that each joint adds to an entry.
const ROTATION: f64 = 64.0;

/// The unit roundoff u of `f64`: half the distance from 1 to the next number.
const UNIT: f64 = f64::EPSILON / 2.0;

/// Bounds, to first order, on the errors of the pivots D of M = Lᵀ D L, from the entries of M row by row with their own
/// bounds; `None` if a pivot is not positive.
///
/// The pivot k is the smallest xᵀ M x for x_k = 1 and x_i = 0 in the rows before k, so that an error E of M changes it
/// by xᵀ E x with the same x. The result of a decomposition is exact for an n × n matrix with the errors
/// (n + 1) u √(M_ii M_jj) (N. Higham, "Accuracy and Stability of Numerical Algorithms", 2002, theorem 10.5). The
/// articulated-body algorithm does not subtract what it has not added, and is taken to be as accurate.
///
/// The bounds grow with n and with the largest x, whereas those that follow each operation grow by about one digit with
/// each joint of a chain. For the same reason, the bounds on the entries of M of long chains are limited to an estimate of
/// the rounding errors of a product of n rotations.
pub(super) fn errors(matrix: &[Rounded]) -> Option<Vec<f64>> {
    let order = matrix.len().isqrt();
    let at = |row: usize, column: usize| matrix[row * order + column];
    let size: Vec<f64> = (0..order).map(|row| at(row, row).value.abs().sqrt()).collect();
    let unit = (order as f64 + 1.0) * UNIT;
    let factor = lower_factor(matrix, order)?;
    let largest = size.iter().fold(0.0_f64, |largest, size| largest.max(size * size));
    let limit = if order > LONG { ROTATION * unit * largest } else { f64::INFINITY };
    let error = |pivot: usize| {
        let x = minimum(&factor, pivot);
        let rows = (pivot..order).flat_map(|row| (pivot..order).map(move |column| (row, column)));
        let terms = rows.map(|(row, column)| {
            let own = at(row, column).error.min(limit) + unit * size[row] * size[column];
            (x[row] * x[column]).abs() * own
        });
        terms.sum()
    };
    Some((0..order).map(error).collect())
}

/// L of M = Lᵀ D L, row by row, without the ones on its diagonal; `None` if a pivot is not positive.
fn lower_factor(matrix: &[Rounded], order: usize) -> Option<Vec<Vec<f64>>> {
    let mut rows: Vec<Vec<f64>> = (0..order)
        .map(|row| (0..=row).map(|column| matrix[row * order + column].value).collect())
        .collect();
    for pivot in (0..order).rev() {
        let (others, last) = rows.split_at_mut(pivot);
        let last = &mut last[0];
        let value = last.pop().filter(|value| *value > 0.0)?;
        for (row, entries) in others.iter_mut().enumerate() {
            let factor = last[row] / value;
            for (entry, own) in entries.iter_mut().zip(last.iter()) {
                *entry -= factor * own;
            }
        }
        last.iter_mut().for_each(|entry| *entry /= value);
    }
    Some(rows)
}

/// The x with x_k = 1 at which xᵀ M x is smallest: L x has no entries after row k.
fn minimum(factor: &[Vec<f64>], pivot: usize) -> Vec<f64> {
    let mut x = vec![0.0; factor.len()];
    x[pivot] = 1.0;
    for row in pivot + 1..factor.len() {
        x[row] = -factor[row].iter().zip(&x).skip(pivot).map(|(own, x)| own * x).sum::<f64>();
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(entries: &[f64]) -> Vec<Rounded> {
        entries.iter().map(|value| Rounded { value: *value, error: 0.0 }).collect()
    }

    #[test]
    fn a_pivot_is_the_least_value_of_the_quadratic_form() {
        let matrix = exact(&[11.0, 3.0, 2.0, 3.0, 3.5, 1.0, 2.0, 1.0, 1.0]);
        let factor = lower_factor(&matrix, 3).unwrap();
        assert_eq!(factor, [vec![], vec![1.0 / 2.5], vec![2.0, 1.0]]);
        // M x has no other entry than the pivot in its row: 11 − 4 − 1/2.5.
        let x = minimum(&factor, 0);
        let product = |row: usize| -> f64 {
            x.iter().enumerate().map(|(column, x)| matrix[3 * row + column].value * x).sum()
        };
        assert!((product(0) - (7.0 - 1.0 / 2.5)).abs() < 1e-15);
        assert!(product(1).abs() < 1e-15 && product(2).abs() < 1e-15, "{x:?}");
    }

    #[test]
    fn errors_are_those_of_the_entries_and_of_the_decomposition() {
        let unit = 3.0 * 2.0_f64.powi(-53);
        // x = (1, −1) for the first pivot.
        let errors = errors(&exact(&[5.0, 4.0, 4.0, 4.0])).unwrap();
        let expected = unit * (5.0 + 4.0 + 2.0 * 20.0_f64.sqrt());
        assert!((errors[0] / expected - 1.0).abs() < 1e-15 && errors[1] == unit * 4.0);
        let mut inexact = exact(&[1.0, 0.0, 0.0, 1.0]);
        inexact[3].error = 0.25;
        assert_eq!(super::errors(&inexact).unwrap(), [unit, 0.25 + unit]);
    }

    #[test]
    fn what_is_not_positive_definite_has_no_bounds() {
        for wrong in [0.0, -1.0, f64::NAN] {
            assert_eq!(errors(&exact(&[1.0, 0.0, 0.0, wrong])), None);
        }
        assert_eq!(errors(&exact(&[1.0, 2.0, 2.0, 1.0])), None);
    }

    #[test]
    fn errors_of_entries_are_limited_in_long_chains_alone() {
        for (order, own) in [(LONG, 1.0), (LONG + 1, ROTATION * 18.0 * UNIT * 4.0)] {
            let mut matrix = vec![Rounded { value: 0.0, error: 1.0 }; order * order];
            for row in 0..order {
                matrix[row * order + row].value = 4.0;
            }
            let decomposition = (order as f64 + 1.0) * UNIT * 4.0;
            let errors = errors(&matrix).unwrap();
            assert!(
                errors.iter().all(|error| *error == own + decomposition),
                "{order}: {errors:?}"
            );
        }
    }
}
