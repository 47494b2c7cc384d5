//! The Coriolis matrix.

use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, differentiate};

use super::{Derivation, Function, FunctionKind, Output, inverse_dynamics};
use crate::economical::Recursion;
use crate::matrix::SquareMatrix;

/// C(q, q̇) by Christoffel symbols.
pub(super) fn coriolis_matrix<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let forms = derivation.recursion.as_ref().map(Recursion::coriolis_matrix).unwrap_or_default();
    let composite =
        forms.into_iter().min_by_key(|form| derivation.operations(&form.rows()).flops());
    let matrix = composite.unwrap_or_else(|| half_velocity_slopes(derivation));
    let output = Output::new(
        "coriolis_matrix",
        "The Coriolis matrix, row by row",
        &derivation.matrix_unit("kg m²/s", "kg m/s", "kg/s"),
        vec![matrix.order(), matrix.order()],
        matrix.rows(),
    );
    derivation.of_kind(
        FunctionKind::CoriolisMatrix,
        &["The Coriolis matrix C(q, q̇), from the Christoffel symbols of the mass matrix: C q̇ \
            are the Coriolis and centrifugal terms, Ṁ = C + Cᵀ, and Ṁ − 2 C is skew-symmetric."],
        vec![output],
    )
}

/// ½ ∂τ/∂q̇. This is a Coriolis matrix, because C q̇ is a quadratic form in q̇ whose coefficients are the Christoffel
/// symbols.
fn half_velocity_slopes<'g>(derivation: &Derivation<'_, 'g>) -> SquareMatrix<'g> {
    let bias = inverse_dynamics::bias_torques(derivation);
    let slopes =
        differentiate::forward(&bias, &derivation.coordinate_symbols(JointVariable::Velocity));
    let halves: Vec<Expr<'g>> = slopes.into_iter().flatten().map(|slope| slope / 2).collect();
    SquareMatrix::from_rows(halves, bias.len())
}
