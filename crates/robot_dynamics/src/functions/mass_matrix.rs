//! The mass matrix.

use robot_model::functions::coupled;
use robot_model::variable::JointVariable;
use robot_symbolic::walk;

use super::{Derivation, Function, FunctionKind, Output};
use crate::matrix::SymmetricMatrix;

/// The function for M(q).
pub(super) fn mass_matrix<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let matrix = matrix(derivation);
    let order = matrix.order();
    let output = Output::new(
        "mass_matrix",
        "The mass matrix, row by row, both triangles",
        &derivation.matrix_unit("kg m²", "kg m", "kg"),
        vec![order, order],
        matrix.rows(),
    );
    derivation.of_kind(
        FunctionKind::MassMatrix,
        &["The mass matrix M(q), including the drives' reflected inertias: symmetric, positive \
            definite; the joint torques for the accelerations `qdd` are M q̈ + C q̇ + g and the \
            kinetic energy is ½ q̇ᵀ M q̇."],
        vec![output],
    )
}

/// The function for the entries in the lower triangle of M that can be nonzero for the robot's structure.
pub(super) fn mass_matrix_lower<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let matrix = matrix(derivation);
    let entries = coupled(derivation.robot).into_iter();
    let values: Vec<_> = entries.map(|[row, column]| matrix.at(row, column)).collect();
    let output = Output::new(
        FunctionKind::MassMatrixLower.name(),
        "The lower triangle of the mass matrix row by row, each row to its diagonal entry, without \
         those of joints of which neither carries the other",
        &derivation.matrix_unit("kg m²", "kg m", "kg"),
        vec![values.len()],
        values,
    );
    derivation.of_kind(
        FunctionKind::MassMatrixLower,
        &["The lower triangle of the mass matrix M(q), of which the upper one is the mirror image. An \
            entry is left out if no joint of one coordinate carries a joint of the other: it is \
            always 0."],
        vec![output],
    )
}

/// M by composite inertias or, if the recursion does not apply, as ∂Q/∂q̈.
pub(super) fn matrix<'g>(derivation: &Derivation<'_, 'g>) -> SymmetricMatrix<'g> {
    if let Some(recursion) = &derivation.recursion {
        return recursion.mass_matrix();
    }
    let graph = derivation.mechanism.graph;
    let order = derivation.mechanism.degrees_of_freedom;
    let torques = derivation.paper_torques(false, &[]);
    let mut matrix = SymmetricMatrix::zero(graph, order);
    for column in 0..order {
        let slopes =
            walk::derivatives(&torques, graph.symbol(&JointVariable::Acceleration.symbol(column)));
        for (row, slope) in slopes.into_iter().enumerate().skip(column) {
            matrix.set(row, column, slope);
        }
    }
    matrix
}
