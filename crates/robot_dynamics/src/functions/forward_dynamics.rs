//! Forward dynamics: accelerations from driving forces.

use robot_symbolic::Expr;

use super::{Derivation, Function, FunctionKind, Output, mass_matrix};
use crate::economical::{Recursion, Solver};

/// Joints beyond which the mass matrix is not tried: its decomposition grows with their third power, and
/// articulated bodies need fewer operations from some ten joints on.
const MOST_BY_MATRIX: usize = 16;

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
        return by_recursion(derivation, recursion, &tau, wrench);
    }
    let bias = derivation.paper_torques(wrench, &["qdd"]);
    let excess = tau.iter().zip(bias).map(|(tau, bias)| *tau - bias).collect();
    mass_matrix::matrix(derivation).solve(excess)
}

/// By the solver that needs fewer operations.
fn by_recursion<'g>(
    derivation: &Derivation<'_, 'g>,
    recursion: &Recursion<'g>,
    tau: &[Expr<'g>],
    wrench: bool,
) -> Vec<Expr<'g>> {
    let by = |solver| recursion.forward_dynamics(tau, wrench, solver);
    let articulated = by(Solver::ArticulatedBodies);
    let matrix = match articulated {
        Some(_) if tau.len() > MOST_BY_MATRIX => None,
        _ => by(Solver::MassMatrix),
    };
    let ways = [matrix, articulated].into_iter().flatten();
    let cheapest = ways.min_by_key(|values| derivation.operations(values).flops());
    cheapest.unwrap_or_default()
}
