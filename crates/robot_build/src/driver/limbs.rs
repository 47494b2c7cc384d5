//! Functions of robots with limbs that are alike, which are computed in lanes.

use robot_codegen::{LimbKind, Module};
use robot_dynamics::economical::Plan;
use robot_dynamics::economical::plan::Place;
use robot_dynamics::functions::Derivation;
use robot_dynamics::limbs::{LikeLimbs, like_limbs};
use robot_model::functions::{Bundle, FunctionKind};
use robot_model::robot::Robot;
use robot_symbolic::Graph;

use crate::driver::options::{Limbs, Options};
use crate::driver::programs::MAX_NODES;
use crate::driver::specification;

/// Adds programs of single limbs to the module's functions, if the robot has limbs that are alike and the options
/// choose to compute them side by side.
pub(crate) fn set_limbs(
    module: &mut Module,
    robot: &Robot,
    options: &Options,
    (functions, bundles): (&[FunctionKind], &[Bundle]),
    plan: Option<&Plan>,
) {
    let functions: Vec<FunctionKind> =
        functions.iter().copied().filter(|kind| is_of_limbs(*kind)).collect();
    let mut bundles = bundles.to_vec();
    bundles.retain(|bundle| bundle.functions.iter().all(|kind| is_of_limbs(*kind)));
    if options.limbs == Limbs::Apart || functions.is_empty() && bundles.is_empty() {
        return;
    }
    let Some(like) = like_limbs(robot) else { return };
    let kinds = like.into_iter().map(|like| kind(like, options, (&functions, &bundles), plan));
    let Some(kinds) = kinds.collect::<Option<Vec<LimbKind>>>() else { return };
    let names = functions.iter().map(|kind| kind.name().to_owned());
    let names: Vec<String> = names.chain(bundles.into_iter().map(|bundle| bundle.name)).collect();
    module.set_limbs(&kinds, &names, options.trigonometry);
}

/// Whether each result of a function is a result of one limb. This holds for functions with a result for each
/// coordinate, or for each pair of coordinates.
fn is_of_limbs(kind: FunctionKind) -> bool {
    match kind {
        FunctionKind::InverseDynamics(effects) | FunctionKind::ForwardDynamics(effects) => {
            !effects.wrench
        }
        FunctionKind::Bias
        | FunctionKind::Gravity
        | FunctionKind::MassMatrix
        | FunctionKind::CoriolisMatrix
        | FunctionKind::InverseDynamicsDerivatives
        | FunctionKind::ForwardDynamicsDerivatives => true,
        _ => false,
    }
}

/// Derives the programs of one limb; `None` if its functions cannot be derived independently of its numbers.
fn kind(
    like: LikeLimbs,
    options: &Options,
    (functions, bundles): (&[FunctionKind], &[Bundle]),
    plan: Option<&Plan>,
) -> Option<LimbKind> {
    let LikeLimbs { robot, limbs } = like;
    let graph = Graph::limited(MAX_NODES);
    let plan = plan.map(|plan| of_links(plan, &limbs[0].links));
    let derivation = Derivation::new(&robot, &graph, &options.mechanism(&robot), plan);
    derivation.recursion.as_ref()?;
    let specification = specification::module(&derivation, functions, bundles, &[]);
    if graph.is_full() {
        return None;
    }
    let module = Module::compile(&specification, &options.codegen()).ok()?;
    let (coordinates, values) =
        limbs.into_iter().map(|limb| (limb.coordinates, limb.values)).unzip();
    Some(LimbKind { module, coordinates, values })
}

/// Restricts a plan to some links.
fn of_links(plan: &Plan, links: &[usize]) -> Plan {
    let among = |link: usize| links.iter().position(|other| *other == link);
    let of_link = |index: &usize| {
        let mut link = plan.links[*index].clone();
        let place = |place: Place| Some(Place { link: among(place.link)?, ..place });
        link.projected_at = link.projected_at.and_then(place);
        link
    };
    let unit_length =
        plan.unit_length.and_then(|(link, component)| Some((among(link)?, component)));
    Plan { links: links.iter().map(of_link).collect(), unit_length }
}

#[cfg(test)]
mod tests {
    use robot_dynamics::economical::plan::LinkPlan;

    use super::*;

    /// The plan of a limb counts the links of the limb, and keeps nothing that refers to links outside of it.
    #[test]
    fn the_plan_of_a_limb_has_the_places_of_its_links() {
        let mut whole = Plan::uniform(4, &LinkPlan::DEFAULT);
        let place = |link| Some(Place { link, turned: true });
        whole.links[2].projected_at = place(3);
        whole.links[3].projected_at = place(0);
        whole.unit_length = Some((3, 1));
        let limb = of_links(&whole, &[2, 3]);
        assert_eq!(limb.links.len(), 2);
        assert_eq!([limb.links[0].projected_at, limb.links[1].projected_at], [place(1), None]);
        assert_eq!(limb.unit_length, Some((1, 1)));
        assert_eq!(of_links(&whole, &[0, 1]).unit_length, None);
    }
}
