//! Rotations as sequences of plane rotations, the form with the fewest operations.

use robot_symbolic::{Expr, Number};

use crate::vector::{Matrix, Vector};

/// A rotation in a coordinate plane by an angle with the given sine and cosine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane<'g> {
    /// The two axes of the plane; the first turns toward the second.
    axes: (usize, usize),
    sine: Expr<'g>,
    cosine: Expr<'g>,
}

impl<'g> Plane<'g> {
    /// A rotation about x.
    pub(crate) fn x(sine: Expr<'g>, cosine: Expr<'g>) -> Plane<'g> {
        Plane { axes: (1, 2), sine, cosine }
    }

    /// A rotation about y.
    pub(crate) fn y(sine: Expr<'g>, cosine: Expr<'g>) -> Plane<'g> {
        Plane { axes: (2, 0), sine, cosine }
    }

    /// A rotation about z.
    pub(crate) fn z(sine: Expr<'g>, cosine: Expr<'g>) -> Plane<'g> {
        Plane { axes: (0, 1), sine, cosine }
    }

    /// Transforms components in the turned axes to the unturned axes: R v.
    pub(crate) fn forward(&self, mut vector: Vector<'g>) -> Vector<'g> {
        let (i, j) = self.axes;
        let (a, b) = (vector.0[i], vector.0[j]);
        vector.0[i] = self.cosine * a - self.sine * b;
        vector.0[j] = self.sine * a + self.cosine * b;
        vector
    }

    /// Transforms a symmetric tensor from the turned to the unturned axes, R S Rᵀ, with five products in the plane.
    pub(crate) fn forward_symmetric(&self, Matrix(s): Matrix<'g>) -> Matrix<'g> {
        let (i, j) = self.axes;
        let k = 3 - i - j;
        let (sine, cosine) = (self.sine, self.cosine);
        let u = cosine * (s[i][i] - s[j][j]) - sine * (s[i][j] * 2);
        let first = s[j][j] + cosine * u;
        // The trace is invariant.
        let second = (s[i][i] + s[j][j]) - first;
        let mixed = s[i][j] + sine * u;
        let (a, b) = (s[i][k], s[j][k]);
        let out = (cosine * a - sine * b, sine * a + cosine * b);
        let mut turned = s;
        (turned[i][i], turned[j][j]) = (first, second);
        (turned[i][j], turned[j][i]) = (mixed, mixed);
        (turned[i][k], turned[k][i]) = (out.0, out.0);
        (turned[j][k], turned[k][j]) = (out.1, out.1);
        Matrix(turned)
    }

    /// Transforms an arbitrary tensor from the turned to the unturned axes: R T Rᵀ.
    pub(crate) fn forward_tensor(&self, Matrix(t): Matrix<'g>) -> Matrix<'g> {
        let (i, j) = self.axes;
        let k = 3 - i - j;
        let (sine, cosine) = (self.sine, self.cosine);
        let u = cosine * (t[i][i] - t[j][j]) - sine * (t[i][j] + t[j][i]);
        let first = t[j][j] + cosine * u;
        let mut turned = t;
        // The trace and the skew-symmetric part are invariant.
        (turned[i][i], turned[j][j]) = (first, (t[i][i] + t[j][j]) - first);
        (turned[i][j], turned[j][i]) = (t[i][j] + sine * u, t[j][i] + sine * u);
        let turn = |a, b| (cosine * a - sine * b, sine * a + cosine * b);
        (turned[i][k], turned[j][k]) = turn(t[i][k], t[j][k]);
        (turned[k][i], turned[k][j]) = turn(t[k][i], t[k][j]);
        Matrix(turned)
    }

    /// Transforms an arbitrary tensor from the turned to the unturned axes, R T Rᵀ, by columns and rows, without use of
    /// its trace. A moment that vanishes with an angle therefore keeps its digits, which it would lose as the trace
    /// minus another moment, as in [`Plane::forward_symmetric`].
    pub(crate) fn forward_entries(&self, tensor: Matrix<'g>) -> Matrix<'g> {
        let turned_columns = |Matrix(t): Matrix<'g>| {
            let columns = Matrix(t).transpose().0.map(|column| self.forward(Vector(column)).0);
            Matrix(columns).transpose()
        };
        turned_columns(turned_columns(tensor).transpose()).transpose()
    }

    /// Transforms components in the unturned axes to the turned axes: Rᵀ v.
    pub(crate) fn back(&self, mut vector: Vector<'g>) -> Vector<'g> {
        let (i, j) = self.axes;
        let (a, b) = (vector.0[i], vector.0[j]);
        vector.0[i] = self.cosine * a + self.sine * b;
        vector.0[j] = self.cosine * b - self.sine * a;
        vector
    }
}

/// A constant rotation R = before · Rz(θ), split into its last rotation about z and the part before it.
#[derive(Clone, Debug)]
pub(crate) struct ConstantRotation<'g> {
    /// The part before the last rotation; plane rotations are applied to parent components in this order.
    before: Before<'g>,
    /// The sine and cosine of θ.
    pub(crate) turn: (Expr<'g>, Expr<'g>),
}

#[derive(Clone, Debug)]
enum Before<'g> {
    Planes(Vec<Plane<'g>>),
    Full(Box<Matrix<'g>>),
}

impl<'g> ConstantRotation<'g> {
    /// The sequence of plane rotations with the fewest operations whose product is the matrix.
    pub(crate) fn new(matrix: Matrix<'g>) -> ConstantRotation<'g> {
        let Matrix(r) = matrix;
        let graph = r[0][0].graph();
        let (zero, one) = (graph.zero(), graph.one());
        let z = matrix.column(2);
        // The third column of Rx(α) Rz(θ) is (0, −sin α, cos α), and its first row is (cos θ, −sin θ, 0).
        if z.0[0].is_zero() {
            let plane = Plane::x(-z.0[1], z.0[2]);
            return ConstantRotation { before: planes(&[plane]), turn: (-r[0][1], r[0][0]) };
        }
        // The third column of Ry(β) Rz(θ) is (sin β, 0, cos β), and its second row is (sin θ, cos θ, 0).
        if z.0[1].is_zero() {
            let plane = Plane::y(z.0[0], z.0[2]);
            return ConstantRotation { before: planes(&[plane]), turn: (r[1][0], r[1][1]) };
        }
        if r.iter().flatten().any(|entry| entry.as_number().is_none()) {
            let before = Before::Full(Box::new(matrix));
            return ConstantRotation { before, turn: (zero, one) };
        }
        // The third column of Rz(φ) Rx(α) Rz(θ) is (sin φ sin α, −cos φ sin α, cos α).
        let sine = constant_root(z.0[0] * z.0[0] + z.0[1] * z.0[1]);
        let (sin_phi, cos_phi) = (z.0[0] / sine, -z.0[1] / sine);
        let outer = Plane::z(sin_phi, cos_phi);
        let x = outer.back(matrix.column(0));
        let y = outer.back(matrix.column(1));
        ConstantRotation {
            before: planes(&[outer, Plane::x(sine, z.0[2])]),
            turn: (-y.0[0], x.0[0]),
        }
    }

    /// Transforms parent components to the axes before the last rotation.
    pub(crate) fn back(&self, vector: Vector<'g>) -> Vector<'g> {
        match &self.before {
            Before::Planes(planes) => planes.iter().fold(vector, |v, plane| plane.back(v)),
            Before::Full(matrix) => matrix.transpose() * vector,
        }
    }

    /// Transforms components in the axes before the last rotation to parent components.
    pub(crate) fn forward(&self, vector: Vector<'g>) -> Vector<'g> {
        match &self.before {
            Before::Planes(planes) => planes.iter().rev().fold(vector, |v, plane| plane.forward(v)),
            Before::Full(matrix) => **matrix * vector,
        }
    }

    /// The axes before the last rotation, in the components in which the columns of `axes` are the parent's axes.
    pub(crate) fn forward_axes(&self, axes: &Matrix<'g>) -> Matrix<'g> {
        let Matrix(rows) = *axes;
        Matrix(rows.map(|row| self.back(Vector(row)).0))
    }

    /// Transforms a symmetric tensor from the axes before the last rotation to parent components.
    pub(crate) fn forward_symmetric(&self, tensor: Matrix<'g>) -> Matrix<'g> {
        match &self.before {
            Before::Planes(planes) => {
                planes.iter().rev().fold(tensor, |t, plane| plane.forward_symmetric(t))
            }
            Before::Full(matrix) => **matrix * tensor * matrix.transpose(),
        }
    }

    /// Transforms an arbitrary tensor from the axes before the last rotation to parent components.
    pub(crate) fn forward_tensor(&self, tensor: Matrix<'g>) -> Matrix<'g> {
        match &self.before {
            Before::Planes(planes) => {
                planes.iter().rev().fold(tensor, |t, plane| plane.forward_tensor(t))
            }
            Before::Full(matrix) => **matrix * tensor * matrix.transpose(),
        }
    }

    /// Transforms a tensor like [`ConstantRotation::forward_tensor`], with [`Plane::forward_entries`].
    pub(crate) fn forward_entries(&self, tensor: Matrix<'g>) -> Matrix<'g> {
        match &self.before {
            Before::Planes(planes) => {
                planes.iter().rev().fold(tensor, |t, plane| plane.forward_entries(t))
            }
            Before::Full(matrix) => **matrix * tensor * matrix.transpose(),
        }
    }

    /// The z axis in parent components.
    pub(crate) fn axis(&self) -> Vector<'g> {
        let graph = self.turn.0.graph();
        self.forward(Matrix::identity(graph).column(2))
    }
}

fn planes<'g>(planes: &[Plane<'g>]) -> Before<'g> {
    Before::Planes(planes.to_vec())
}

/// The square root of a constant: exact if it is rational, otherwise a floating-point number.
pub(crate) fn constant_root(constant: Expr<'_>) -> Expr<'_> {
    let root = constant.sqrt();
    if root.as_number().is_some() {
        return root;
    }
    constant.graph().number(Number::real(root.evaluate(|_| f64::NAN)))
}
