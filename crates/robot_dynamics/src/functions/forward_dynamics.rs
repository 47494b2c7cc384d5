//! Forward dynamics: accelerations from driving forces.

use robot_symbolic::Expr;

use super::{Derivation, Function, FunctionKind, Output, mass_matrix};
use crate::economical::Solver;

/// Coordinates up to which M is decomposed without a look at articulated bodies: these need fewer
/// operations from some ten joints on, and share nothing with other functions of a bundle.
const FEW: usize = 8;
/// Coordinates beyond which M is not tried: its decomposition grows with their third power.
const MANY: usize = 16;

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

/// q̈ for the symbols τ, by the solver that needs fewer operations.
fn accelerations<'g>(derivation: &Derivation<'_, 'g>, wrench: bool) -> Vec<Expr<'g>> {
    let coordinates = derivation.mechanism.degrees_of_freedom;
    let articulated = match &derivation.recursion {
        Some(recursion) if coordinates > FEW => {
            let tau = derivation.coordinate_symbols("tau");
            recursion.forward_dynamics(&tau, wrench, Solver::ArticulatedBodies)
        }
        _ => None,
    };
    match articulated {
        Some(values) if coordinates > MANY => values,
        Some(values) => {
            let by_matrix = by_matrix(derivation, wrench);
            let cost = |values: &[Expr<'g>]| derivation.operations(values).flops();
            if cost(&values) < cost(&by_matrix) { values } else { by_matrix }
        }
        None => by_matrix(derivation, wrench),
    }
}

/// q̈ for the symbols τ, by the decomposition of M: for what needs that anyway.
pub(super) fn by_matrix<'g>(derivation: &Derivation<'_, 'g>, wrench: bool) -> Vec<Expr<'g>> {
    let tau = derivation.coordinate_symbols("tau");
    let recursion = derivation.recursion.as_ref();
    let by_recursion = recursion
        .and_then(|recursion| recursion.forward_dynamics(&tau, wrench, Solver::MassMatrix));
    by_recursion.unwrap_or_else(|| {
        let bias = derivation.paper_torques(wrench, &["qdd"]);
        let excess = tau.iter().zip(bias).map(|(tau, bias)| *tau - bias).collect();
        mass_matrix::matrix(derivation).solve(excess)
    })
}
