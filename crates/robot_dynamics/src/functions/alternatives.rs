//! Functions with other plans than the given one, which is usually that of inverse dynamics.

use super::{Derivation, Function, FunctionKind};
use crate::economical::Plan;
use crate::economical::plan::{LinkPlan, Origin};

/// The maximum number of coordinates for which other plans are tried. For the mass matrix they always are, because its
/// derivation is short.
const MANY: usize = 32;

impl<'g> Derivation<'_, 'g> {
    /// The number of operations of functions that are computed in one call.
    pub(super) fn cost(&self, functions: &[Function<'g>]) -> usize {
        let outputs = functions.iter().flat_map(|function| &function.outputs);
        let roots: Vec<_> = outputs.flat_map(|output| output.values.iter().copied()).collect();
        self.operations(&roots).flops()
    }

    /// Derives functions with `derive`, for the given plan and for a few others; returns those with the fewest
    /// operations.
    pub(super) fn cheapest_plan(
        &self,
        kinds: &[FunctionKind],
        derive: impl Fn(&Derivation<'_, 'g>) -> Vec<Function<'g>>,
    ) -> Vec<Function<'g>> {
        let mut best = derive(self);
        let count = self.mechanism.degrees_of_freedom;
        let apply = kinds.iter().any(|kind| depends(*kind, count));
        let recursion = self.recursion.as_ref().filter(|_| apply);
        let mut least = recursion.map_or(0, |_| self.cost(&best));
        for plan in recursion.into_iter().flat_map(|recursion| others(&recursion.plan())) {
            let functions = derive(&self.with_plan(&plan));
            let operations = self.cost(&functions);
            if operations < least {
                (best, least) = (functions, operations);
            }
        }
        best
    }
}

/// Whether a function may need fewer operations with another plan than inverse dynamics. This is the case if many of
/// its operations belong to composite inertias.
fn depends(kind: FunctionKind, coordinates: usize) -> bool {
    match kind {
        FunctionKind::MassMatrix | FunctionKind::MassMatrixLower => true,
        FunctionKind::CoriolisMatrix
        | FunctionKind::InverseDynamicsDerivatives
        | FunctionKind::ForwardDynamicsDerivatives => coordinates <= MANY,
        // Load-dependent friction is computed in iterations, each of which is as long as the function.
        FunctionKind::ForwardDynamics(effects) => !effects.friction && coordinates <= MANY,
        _ => false,
    }
}

/// The given plan with all regrouped inertia at the parents, so that composites of links on revolute joints have no
/// mass, and uniform plans.
fn others(plan: &Plan) -> Vec<Plan> {
    let bare = plan.links.iter().map(|link| LinkPlan {
        residual: [None; 3],
        composite_sum: true,
        ..link.clone()
    });
    let bare = Plan { links: bare.collect(), ..plan.clone() };
    let uniform = [Origin::NextNormal, Origin::PreviousNormal].map(|origin| {
        let link = LinkPlan { origin, composite_sum: true, ..LinkPlan::DEFAULT };
        Plan { unit_length: plan.unit_length, ..Plan::uniform(plan.links.len(), &link) }
    });
    let others = [bare].into_iter().chain(uniform).filter(|other| other != plan);
    others.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_model::functions::Effects;

    /// The other plans regroup fully or are uniform, keep the unit of length, and differ from the given plan and from
    /// each other.
    #[test]
    fn other_plans_keep_the_unit_of_length() {
        let link = LinkPlan { angle_sum: true, composite_sum: true, ..LinkPlan::BASIC };
        for unit_length in [None, Some((1, 2))] {
            let own = Plan { unit_length, ..Plan::uniform(3, &link) };
            let found = others(&own);
            assert_eq!(found.len(), 2, "{found:?}");
            let mut held = own.clone();
            held.links[1].residual[0] = Some(crate::economical::plan::Entry::ALL[0]);
            let with_bare = others(&held);
            assert_eq!(with_bare[0], own);
            assert_eq!(with_bare[1..], found);
            for other in found.iter().chain(&with_bare) {
                assert_eq!((other.unit_length, other.links.len()), (unit_length, 3));
                let is_bare = |link: &LinkPlan| link.composite_sum && link.residual == [None; 3];
                assert!(other.links.iter().all(is_bare), "{other:?}");
            }
            assert_ne!(found[0], found[1]);
        }
    }

    /// Functions with composites are tried with other plans; for robots with many coordinates, only the mass matrix is.
    #[test]
    fn composites_are_tried_under_other_plans() {
        let tried = |coordinates: usize| {
            let kinds = FunctionKind::ALL.iter().copied();
            kinds.filter(|kind| depends(*kind, coordinates)).collect::<Vec<FunctionKind>>()
        };
        let (few, many) = (tried(MANY), tried(MANY + 1));
        assert_eq!(many, [FunctionKind::MassMatrix, FunctionKind::MassMatrixLower]);
        for kind in [FunctionKind::CoriolisMatrix, FunctionKind::ForwardDynamics(Effects::NONE)] {
            assert!(few.contains(&kind));
        }
        for kind in [
            FunctionKind::ForwardDynamics(Effects::FRICTION),
            FunctionKind::InverseDynamics(Effects::NONE),
        ] {
            assert!(!few.contains(&kind));
        }
    }
}
