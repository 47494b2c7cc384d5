//! Forward dynamics: accelerations from driving forces.

use robot_symbolic::Expr;

use super::{Derivation, Function, FunctionKind, Output, mass_matrix};
use crate::economical::Solver;
use crate::matrix::Pivots;

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
    let doc = "Forward dynamics: the accelerations that the driving forces `tau` bring about, the \
               solution of M q̈ = τ − C q̇ − g. Friction is not part of it: take it from `tau`.";
    let mut function = derivation.of_kind(kind, &[doc], inputs, vec![output]);
    function.doc.extend(method(derivation));
    function
}

/// How the functions of a robot solve M q̈ = b, how many digits that may cost, and what a wrong pivot does.
pub(super) fn method(derivation: &Derivation<'_, '_>) -> Vec<String> {
    let way = if derivation.recursion_for_small_pivots().is_some() {
        "By articulated bodies: at the nominal parameters there are postures in which the mass matrix is \
         nearly singular, and there these keep digits that a decomposition of it loses."
    } else {
        "Digits are lost where a pivot of the mass matrix, the inertia that a joint shows where the joints \
         farther out are free, is much smaller than the joint's entry on the diagonal: as many as their \
         quotient has zeros."
    };
    let wrong = match derivation.pivots_known() {
        Pivots::Checked => {
            "No branch: where a pivot is not above 0 and finite (a coordinate that moves no mass in that \
             posture, an inertia below 0), the accelerations that depend on it are NaN."
        }
        Pivots::Positive => {
            "No posture of this robot was found in which a pivot is small, and none is checked."
        }
    };
    vec![way.to_owned(), wrong.to_owned()]
}

/// q̈ for the symbols τ, by the solver that needs fewer operations.
fn accelerations<'g>(derivation: &Derivation<'_, 'g>, wrench: bool) -> Vec<Expr<'g>> {
    let coordinates = derivation.mechanism.degrees_of_freedom;
    if let Some(values) = by_small_pivots(derivation, wrench) {
        return values;
    }
    let articulated = match &derivation.recursion {
        Some(recursion) if coordinates > FEW => {
            let tau = derivation.coordinate_symbols("tau");
            recursion.forward_dynamics(
                &tau,
                wrench,
                Solver::ArticulatedBodies,
                derivation.pivots_known(),
            )
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

/// q̈ for the symbols τ, where pivots of M may be small.
fn by_small_pivots<'g>(derivation: &Derivation<'_, 'g>, wrench: bool) -> Option<Vec<Expr<'g>>> {
    let recursion = derivation.recursion_for_small_pivots()?;
    recursion.forward_dynamics(
        &derivation.coordinate_symbols("tau"),
        wrench,
        Solver::SmallPivots,
        Pivots::Checked,
    )
}

/// q̈ for the symbols τ in derivatives, which solve M x = b for many b: by the decomposition of M, but
/// where pivots may be small.
pub(super) fn for_derivatives<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Expr<'g>> {
    let careful = by_small_pivots(derivation, false);
    careful.unwrap_or_else(|| by_matrix(derivation, false))
}

/// x of M x = b, for each b by coordinates.
pub(super) fn solve_all<'g>(
    derivation: &Derivation<'_, 'g>,
    right: Vec<Vec<Expr<'g>>>,
) -> Vec<Vec<Expr<'g>>> {
    match derivation.recursion_for_small_pivots() {
        Some(recursion) => right.iter().map(|side| recursion.solve_articulated(side)).collect(),
        None => mass_matrix::matrix(derivation).solve_all(right, derivation.pivots_known()),
    }
}

/// D of M = Lᵀ D L by coordinates, as the accelerations have it.
pub(super) fn pivots<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Expr<'g>> {
    let small = derivation.recursion_for_small_pivots();
    let small = small.and_then(|recursion| recursion.pivots(Solver::SmallPivots));
    let long = || {
        let is_long = derivation.mechanism.degrees_of_freedom > MANY;
        let recursion = derivation.recursion.as_ref().filter(|_| is_long);
        recursion.and_then(|recursion| recursion.pivots(Solver::ArticulatedBodies))
    };
    small.or_else(long).unwrap_or_else(|| mass_matrix::matrix(derivation).pivots(Pivots::Checked))
}

/// q̈ for the symbols τ, by the decomposition of M.
fn by_matrix<'g>(derivation: &Derivation<'_, 'g>, wrench: bool) -> Vec<Expr<'g>> {
    let tau = derivation.coordinate_symbols("tau");
    let pivots = derivation.pivots_known();
    let recursion = derivation.recursion.as_ref();
    let by_recursion = recursion
        .and_then(|recursion| recursion.forward_dynamics(&tau, wrench, Solver::MassMatrix, pivots));
    by_recursion.unwrap_or_else(|| {
        let bias = derivation.paper_torques(wrench, &["qdd"]);
        let excess = tau.iter().zip(bias).map(|(tau, bias)| *tau - bias).collect();
        mass_matrix::matrix(derivation).solve(excess, pivots)
    })
}
