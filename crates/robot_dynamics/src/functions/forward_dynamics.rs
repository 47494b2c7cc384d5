//! Forward dynamics: accelerations from driving forces.

use robot_symbolic::Expr;

use super::{Derivation, Function, FunctionKind, Output, mass_matrix};

/// q̈ of M q̈ = τ − C q̇ − g.
pub(super) fn forward_dynamics<'g>(
    derivation: &Derivation<'_, 'g>,
    kind: FunctionKind,
) -> Function<'g> {
    let wrench = kind == FunctionKind::ForwardDynamicsWrench;
    let mut inputs = derivation.coordinate_inputs(["q", "qd", "tau"]);
    if wrench {
        inputs.extend(derivation.wrench_inputs());
    }
    let values = accelerations(derivation, wrench);
    let output = Output::new(
        "qdd",
        "Joint accelerations",
        &derivation.coordinate_unit("rad/s²", "m/s²"),
        vec![values.len()],
        values,
    );
    derivation.of_kind(
        kind,
        &[
            "Forward dynamics: the accelerations that the driving forces `tau` bring about, the \
             solution of M q̈ = τ − C q̇ − g. Friction is not part of it: take it from `tau`.",
            "By the decomposition M = Lᵀ D L without pivots or branches: where M is not positive \
             definite (a coordinate that moves no mass), the result is not finite or meaningless.",
        ],
        inputs,
        vec![output],
    )
}

/// q̈ for the symbols τ.
pub(super) fn accelerations<'g>(derivation: &Derivation<'_, 'g>, wrench: bool) -> Vec<Expr<'g>> {
    let tau = derivation.coordinate_symbols("tau");
    if let Some(recursion) = &derivation.recursion {
        return recursion.forward_dynamics(&tau, wrench);
    }
    let bias = derivation.paper_torques(wrench, &["qdd"]);
    let excess = tau.iter().zip(bias).map(|(tau, bias)| *tau - bias).collect();
    mass_matrix::matrix(derivation).solve(excess)
}
