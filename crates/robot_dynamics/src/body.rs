//! A rigid body given by its ten inertial parameters, in which joint torques are linear.
//!
//! They are the mass m, the first moment h = m c and the inertia tensor I about the origin of a
//! frame, in the order m, h_x, h_y, h_z, I_xx, I_xy, I_yy, I_xz, I_yz, I_zz.

use robot_model::robot::LINK_PARAMETERS;
use robot_symbolic::{Expr, Graph};

use crate::mechanism::MechanismLink;
use crate::vector::{Matrix, Vector};

/// The index of the first moment's x component among the parameters.
pub(crate) const FIRST_MOMENT: usize = 1;
/// The index of I_xx among the parameters.
pub(crate) const TENSOR: usize = 4;
/// The entries of the tensor in the order of the parameters.
pub(crate) const ENTRIES: [(usize, usize); 6] = [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)];

/// The meaning of the last six of a body's parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Moments {
    /// The inertia tensor I.
    Inertia,
    /// The second moments Σ = ∫ r rᵀ dm, with I = tr(Σ) 1 − Σ. They have the same indices and the same transformation
    /// under rotations as the inertia tensor.
    Second,
}

impl Moments {
    /// The tensor of this kind that corresponds to the given second moments.
    pub(crate) fn of_second<'g>(self, second: Matrix<'g>) -> Matrix<'g> {
        match self {
            Moments::Inertia => Matrix::identity(second.0[0][0].graph()) * second.trace() - second,
            Moments::Second => second,
        }
    }
}

/// A rigid body given by its ten parameters about some origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<'g> {
    /// The mass m, kg.
    pub(crate) mass: Expr<'g>,
    /// The first moment h = m c, kg m.
    pub(crate) first: Vector<'g>,
    /// The inertia tensor I about the origin, kg m².
    pub(crate) tensor: Matrix<'g>,
}

impl<'g> Body<'g> {
    /// The body of a link, about the origin of the link's frame.
    pub(crate) fn of_link(link: &MechanismLink<'g>) -> Body<'g> {
        let center = link.center_of_mass;
        let first = center * link.mass;
        let identity = Matrix::identity(link.mass.graph());
        let tensor = link.inertia + identity * first.dot(center) - Matrix::outer(first, center);
        Body { mass: link.mass, first, tensor }
    }

    /// A body with one parameter equal to 1 and all others equal to 0.
    pub(crate) fn unit(graph: &'g Graph, parameter: usize) -> Body<'g> {
        let one_at = |place: usize| graph.integer(i64::from(parameter == place));
        Body {
            mass: one_at(0),
            first: Vector([0, 1, 2].map(|k| one_at(FIRST_MOMENT + k))),
            tensor: Matrix::from_fn(|row, column| one_at(tensor_place(row, column))),
        }
    }

    /// This body in the axes to which `rotation` transforms components.
    pub(crate) fn turned(self, rotation: Matrix<'g>) -> Body<'g> {
        Body {
            mass: self.mass,
            first: rotation * self.first,
            tensor: rotation * self.tensor * rotation.transpose(),
        }
    }

    /// This body about another origin; `arm` is the position of its own origin relative to that one.
    pub(crate) fn about(self, arm: Vector<'g>) -> Body<'g> {
        let Body { mass, first, tensor } = self;
        let diagonal = Matrix::identity(mass.graph()) * (first.dot(arm) * 2 + arm.dot(arm) * mass);
        let mixed = Matrix::outer(first, arm) + Matrix::outer(arm, first);
        let tensor = tensor + diagonal - mixed - Matrix::outer(arm, arm) * mass;
        Body { mass, first: first + arm * mass, tensor }
    }

    /// The parameters in order.
    pub(crate) fn parameters(&self) -> [Expr<'g>; LINK_PARAMETERS] {
        let (Vector([x, y, z]), Matrix(i)) = (self.first, self.tensor);
        let [xx, xy, yy, xz, yz, zz] = ENTRIES.map(|(row, column)| i[row][column]);
        [self.mass, x, y, z, xx, xy, yy, xz, yz, zz]
    }
}

/// The index of an entry of the tensor among the parameters.
pub(crate) fn tensor_place(row: usize, column: usize) -> usize {
    let (row, column) = (row.min(column), row.max(column));
    TENSOR + row + column * (column + 1) / 2
}
