//! Vectors and matrices of numbers in space: only the operations that reading robot files needs.

/// A vector in space.
pub(crate) type Vector = [f64; 3];

/// A 3 × 3 matrix, row by row.
pub(crate) type Matrix = [Vector; 3];

pub(crate) const IDENTITY: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(crate) fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The unit vector in the direction of `a`; NaN for the zero vector.
pub(crate) fn direction(a: &Vector) -> Vector {
    // Division by the largest component first ensures that no square overflows or underflows.
    let largest = a.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
    let scaled = a.map(|component| component / largest);
    let length = dot(&scaled, &scaled).sqrt();
    scaled.map(|component| component / length)
}

pub(crate) fn transpose(a: &Matrix) -> Matrix {
    [0, 1, 2].map(|row| [a[0][row], a[1][row], a[2][row]])
}

/// The product A b of a matrix and a vector.
pub(crate) fn apply(a: &Matrix, b: &Vector) -> Vector {
    a.each_ref().map(|row| dot(row, b))
}

/// The product A B of two matrices.
pub(crate) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transpose(b);
    a.each_ref().map(|row| columns.each_ref().map(|column| dot(row, column)))
}

/// The rotation by `angle` (rad) about the coordinate axis with the given index.
pub(crate) fn rotation_about(axis: usize, angle: f64) -> Matrix {
    let (sine, cosine) = angle.sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut rotation = IDENTITY;
    rotation[next][next] = cosine;
    rotation[next][last] = -sine;
    rotation[last][next] = sine;
    rotation[last][last] = cosine;
    rotation
}

/// The eigenvalues of a symmetric matrix in ascending order, by Jacobi rotations (G. H. Golub, C. F. Van Loan, "Matrix
/// Computations", section 8.5). The entries must be finite and far from overflow.
pub(crate) fn eigenvalues(mut a: Matrix) -> Vector {
    // Convergence is quadratic: five sweeps are enough for 53 bits.
    const SWEEPS: usize = 12;
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] != 0.0 {
                a = without_entry(&a, p, q);
            }
        }
    }
    let mut values = [a[0][0], a[1][1], a[2][2]];
    values.sort_by(f64::total_cmp);
    values
}

/// Jᵀ A J, in which the rotation J makes the entry (p, q) zero.
fn without_entry(a: &Matrix, p: usize, q: usize) -> Matrix {
    let slope = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let tangent = slope.signum() / (slope.abs() + slope.hypot(1.0));
    let cosine = tangent.hypot(1.0).recip();
    let mut rotation = IDENTITY;
    rotation[p][p] = cosine;
    rotation[q][q] = cosine;
    rotation[p][q] = tangent * cosine;
    rotation[q][p] = -tangent * cosine;
    let mut turned = product(&transpose(&rotation), &product(a, &rotation));
    turned[p][q] = 0.0;
    turned[q][p] = 0.0;
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: Vector, expected: Vector) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{found} is not {expected}");
        }
    }

    #[test]
    fn rotations_turn_axis_to_axis() {
        for axis in 0..3 {
            let turn = rotation_about(axis, std::f64::consts::FRAC_PI_2);
            near(apply(&turn, &IDENTITY[(axis + 1) % 3]), IDENTITY[(axis + 2) % 3]);
            near(cross(&IDENTITY[axis], &IDENTITY[(axis + 1) % 3]), IDENTITY[(axis + 2) % 3]);
        }
    }

    #[test]
    fn cross_products_are_orthogonal_to_both_factors() {
        near(cross(&[1.0, 2.0, 3.0], &[-2.0, 5.0, 7.0]), [-1.0, -13.0, 9.0]);
    }

    #[test]
    fn directions_are_of_length_one_whatever_the_length() {
        for scale in [1e-300, 1.0, 1e300] {
            near(direction(&[3.0 * scale, 0.0, -4.0 * scale]), [0.6, 0.0, -0.8]);
        }
        assert!(direction(&[0.0; 3])[0].is_nan());
    }

    #[test]
    fn eigenvalues_of_turned_diagonals_are_the_diagonals() {
        for expected in [[1.0, 2.0, 3.0], [-1.0, 0.0, 0.0], [2.0, 2.0, 2.0], [1e-9, 1e-9, 1.0]] {
            for angle in [0.0, 0.3, 1.1, 2.9] {
                let turn = product(&rotation_about(0, angle), &rotation_about(2, 2.0 * angle));
                let mut diagonal = [[0.0; 3]; 3];
                for (index, value) in expected.iter().enumerate() {
                    diagonal[index][index] = *value;
                }
                near(eigenvalues(product(&turn, &product(&diagonal, &transpose(&turn)))), expected);
            }
        }
    }
}
