//! Functions under other plans than the given one, which is most often that for inverse dynamics.

use super::{Derivation, Function, FunctionKind};
use crate::economical::Plan;
use crate::economical::plan::{LinkPlan, Origin};

/// Up to this number of coordinates other plans are tried.
const MANY: usize = 32;

impl<'g> Derivation<'_, 'g> {
    /// Functions, by `derive`, under the given plan or the one of a few others under which they need the fewest
    /// operations.
    pub(super) fn cheapest_plan(
        &self,
        kinds: &[FunctionKind],
        derive: impl Fn(&Derivation<'_, 'g>) -> Vec<Function<'g>>,
    ) -> Vec<Function<'g>> {
        let cost = |functions: &[Function<'g>]| {
            let outputs = functions.iter().flat_map(|function| &function.outputs);
            let roots: Vec<_> = outputs.flat_map(|output| output.values.iter().copied()).collect();
            self.operations(&roots).flops()
        };
        let mut best = derive(self);
        let is_long = self.mechanism.degrees_of_freedom > MANY;
        let recursion = self.recursion.as_ref().filter(|_| !is_long && differs(kinds));
        let mut least = recursion.map_or(0, |_| cost(&best));
        for plan in recursion.into_iter().flat_map(|recursion| others(&recursion.plan())) {
            let functions = derive(&self.with_plan(&plan));
            let operations = cost(&functions);
            if operations < least {
                (best, least) = (functions, operations);
            }
        }
        best
    }
}

/// Whether functions of these kinds may want another plan than inverse dynamics: those in which composites take more
/// operations than the recursion over links.
fn differs(kinds: &[FunctionKind]) -> bool {
    kinds.iter().any(|kind| {
        matches!(
            kind,
            FunctionKind::CoriolisMatrix
                | FunctionKind::InverseDynamicsDerivatives
                | FunctionKind::ForwardDynamicsDerivatives
        )
    })
}

/// The plan with all regrouped inertia at the parents, so that composites have no mass behind rotations, and uniform
/// plans.
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
