//! Vectors and matrices of expressions in three dimensions.

use std::ops::{Add, Mul, Neg, Sub};

use robot_symbolic::{Expr, Graph};

/// A vector of three components in some frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vector<'g>(pub [Expr<'g>; 3]);

/// A 3 × 3 matrix, row by row. A rotation matrix `R` transforms components in the rotated frame into components in
/// the original frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Matrix<'g>(pub [[Expr<'g>; 3]; 3]);

impl<'g> Vector<'g> {
    /// The zero vector.
    #[must_use]
    pub fn zero(graph: &'g Graph) -> Vector<'g> {
        Vector([graph.zero(); 3])
    }

    /// The vector with the given component along z.
    #[must_use]
    pub fn along_z(component: Expr<'g>) -> Vector<'g> {
        let zero = component.graph().zero();
        Vector([zero, zero, component])
    }

    /// The cross product `self × other`.
    #[must_use]
    pub fn cross(self, other: Vector<'g>) -> Vector<'g> {
        let (Vector([a, b, c]), Vector([x, y, z])) = (self, other);
        Vector([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// The scalar product.
    #[must_use]
    pub fn dot(self, other: Vector<'g>) -> Expr<'g> {
        let (Vector([a, b, c]), Vector([x, y, z])) = (self, other);
        a * x + b * y + c * z
    }

    /// The Euclidean norm.
    #[must_use]
    pub fn norm(self) -> Expr<'g> {
        self.dot(self).sqrt()
    }

    /// Whether every component is the constant 0.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.0.iter().all(|component| component.is_zero())
    }

    /// Applies a function to each component.
    #[must_use]
    pub fn map(self, function: impl FnMut(Expr<'g>) -> Expr<'g>) -> Vector<'g> {
        Vector(self.0.map(function))
    }
}

impl<'g> Matrix<'g> {
    /// The identity matrix.
    #[must_use]
    pub fn identity(graph: &'g Graph) -> Matrix<'g> {
        let (one, zero) = (graph.one(), graph.zero());
        Matrix([[one, zero, zero], [zero, one, zero], [zero, zero, one]])
    }

    /// The zero matrix.
    #[must_use]
    pub fn zero(graph: &'g Graph) -> Matrix<'g> {
        Matrix([[graph.zero(); 3]; 3])
    }

    /// The matrix whose entry in each row and column is given by a function.
    #[must_use]
    pub fn from_fn(mut entry: impl FnMut(usize, usize) -> Expr<'g>) -> Matrix<'g> {
        Matrix([0, 1, 2].map(|row| [0, 1, 2].map(|column| entry(row, column))))
    }

    /// The matrix of the cross product: `skew(a) b = a × b`.
    #[must_use]
    pub fn skew(Vector([x, y, z]): Vector<'g>) -> Matrix<'g> {
        let zero = x.graph().zero();
        Matrix([[zero, -z, y], [z, zero, -x], [-y, x, zero]])
    }

    /// The product `a bᵀ`.
    #[must_use]
    pub fn outer(a: Vector<'g>, b: Vector<'g>) -> Matrix<'g> {
        Matrix::from_fn(|row, column| a.0[row] * b.0[column])
    }

    /// The transposed matrix.
    #[must_use]
    pub fn transpose(self) -> Matrix<'g> {
        Matrix::from_fn(|row, column| self.0[column][row])
    }

    /// The sum of the diagonal.
    #[must_use]
    pub fn trace(self) -> Expr<'g> {
        self.0[0][0] + self.0[1][1] + self.0[2][2]
    }

    /// The column with this index, from 0.
    #[must_use]
    pub fn column(self, column: usize) -> Vector<'g> {
        Vector(self.0.map(|row| row[column]))
    }

    /// Applies a function to each entry.
    #[must_use]
    pub fn map(self, mut function: impl FnMut(Expr<'g>) -> Expr<'g>) -> Matrix<'g> {
        Matrix(self.0.map(|row| row.map(&mut function)))
    }

    /// The rotation by an angle with the given sine and cosine about a unit axis (Rodrigues' formula):
    /// R = 1 + s \[k\]× + (1 − c) \[k\]×².
    #[must_use]
    pub fn rotation(axis: Vector<'g>, sine: Expr<'g>, cosine: Expr<'g>) -> Matrix<'g> {
        let graph = sine.graph();
        let Vector(k) = axis;
        let cross = Matrix::skew(axis);
        Matrix::from_fn(|row, column| {
            // cos δᵢⱼ + (1 − cos) kᵢ kⱼ + sin [k]× is the same rotation with fewer operations. For a coordinate axis,
            // its own diagonal entry is exactly 1.
            let along = k[row] * k[column];
            let even = match (row == column, along.is_one()) {
                (true, true) => graph.one(),
                (true, false) => cosine + (graph.one() - cosine) * along,
                (false, _) => (graph.one() - cosine) * along,
            };
            even + sine * cross.0[row][column]
        })
    }
}

impl<'g> Add for Vector<'g> {
    type Output = Vector<'g>;
    fn add(self, other: Vector<'g>) -> Vector<'g> {
        Vector([0, 1, 2].map(|i| self.0[i] + other.0[i]))
    }
}

impl<'g> Sub for Vector<'g> {
    type Output = Vector<'g>;
    fn sub(self, other: Vector<'g>) -> Vector<'g> {
        Vector([0, 1, 2].map(|i| self.0[i] - other.0[i]))
    }
}

impl<'g> Neg for Vector<'g> {
    type Output = Vector<'g>;
    fn neg(self) -> Vector<'g> {
        self.map(|component| -component)
    }
}

impl<'g> Mul<Expr<'g>> for Vector<'g> {
    type Output = Vector<'g>;
    fn mul(self, factor: Expr<'g>) -> Vector<'g> {
        self.map(|component| component * factor)
    }
}

impl<'g> Add for Matrix<'g> {
    type Output = Matrix<'g>;
    fn add(self, other: Matrix<'g>) -> Matrix<'g> {
        Matrix::from_fn(|row, column| self.0[row][column] + other.0[row][column])
    }
}

impl<'g> Sub for Matrix<'g> {
    type Output = Matrix<'g>;
    fn sub(self, other: Matrix<'g>) -> Matrix<'g> {
        Matrix::from_fn(|row, column| self.0[row][column] - other.0[row][column])
    }
}

impl<'g> Mul for Matrix<'g> {
    type Output = Matrix<'g>;
    fn mul(self, other: Matrix<'g>) -> Matrix<'g> {
        Matrix::from_fn(|row, column| Vector(self.0[row]).dot(other.column(column)))
    }
}

impl<'g> Mul<Vector<'g>> for Matrix<'g> {
    type Output = Vector<'g>;
    fn mul(self, vector: Vector<'g>) -> Vector<'g> {
        Vector(self.0.map(|row| Vector(row).dot(vector)))
    }
}

impl<'g> Mul<Expr<'g>> for Matrix<'g> {
    type Output = Matrix<'g>;
    fn mul(self, factor: Expr<'g>) -> Matrix<'g> {
        self.map(|entry| entry * factor)
    }
}
