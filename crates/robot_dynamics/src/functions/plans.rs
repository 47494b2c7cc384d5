//! The search for the plan with the fewest operations for given functions.

use std::cell::OnceCell;

use robot_model::robot::Robot;
use robot_symbolic::Expr;

use super::{Derivation, FunctionKind, derivatives};
use crate::economical::search::{self, Found, Objective, Scope};
use crate::economical::{Recursion, TorqueDerivatives};
use crate::mechanism::MechanismOptions;

/// Searches for the plan with which these functions together need the fewest multiplications and additions; common
/// expressions are counted once.
///
/// `None` if the economical recursion does not apply because a joint axis depends on parameters.
#[must_use]
pub fn search_plan(
    robot: &Robot,
    options: &MechanismOptions,
    kinds: &[FunctionKind],
) -> Option<Found> {
    let scope = Scope {
        motions: kinds.iter().any(|kind| kind.uses_motions()),
        composites: kinds.iter().any(|kind| kind.uses_composites()),
        free: kinds.iter().any(|kind| kind.divides_by_mass_matrix()),
    };
    let small_pivots = OnceCell::new();
    search::search_for(robot, options, scope, &|mechanism, recursion| {
        let derivation = Derivation {
            robot,
            mechanism: mechanism.clone(),
            recursion: Some(recursion.clone()),
            small_pivots: small_pivots.clone(),
        };
        let found = objective(&derivation, recursion, kinds);
        if let Some(small) = derivation.small_pivots.get() {
            small_pivots.get_or_init(|| *small);
        }
        found
    })
}

fn objective<'g>(
    derivation: &Derivation<'_, 'g>,
    recursion: &Recursion<'g>,
    kinds: &[FunctionKind],
) -> Objective<'g> {
    let values = |kind: FunctionKind| -> Vec<Expr<'g>> {
        if kind == FunctionKind::InverseDynamicsDerivatives
            // Alternatives to these forms are tried only once, after the plan has been found.
            && let Some(TorqueDerivatives { positions, velocities }) =
                derivatives::fewest(derivation, recursion.torque_derivatives())
        {
            return [positions.rows(), velocities.rows()].concat();
        }
        let functions = derivation.derived(kind).into_iter();
        functions.flat_map(|function| function.outputs).flat_map(|output| output.values).collect()
    };
    Objective::new(kinds.iter().copied().flat_map(values).collect())
}
