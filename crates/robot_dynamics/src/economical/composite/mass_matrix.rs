//! The mass matrix by composite inertias.

use std::collections::BTreeSet;

use crate::economical::composite::projection::{Propagated, projections};
use crate::economical::composite::{composites, inertial_wrench};
use crate::economical::frames::Frames;
use crate::economical::frames::chain::{Chain, ChainLink};
use crate::economical::plan::LinkPlan;
use crate::economical::spatial::{Twist, Wrench};
use crate::matrix::SymmetricMatrix;
use crate::vector::{Matrix, Vector};
use robot_model::robot::JointKind;
use robot_symbolic::{Expr, SymbolId, operations, walk};

/// The smallest number of coordinates for which forms other than the plan's are tried.
const MANY: usize = 9;

/// M(q), including drives: in the form of the plan or, if there are many coordinates, in the form with the fewest
/// operations.
pub(crate) fn cheapest<'g>(chain: &Chain<'g>, plans: &[LinkPlan]) -> SymmetricMatrix<'g> {
    let planned = mass_matrix(chain, plans);
    if chain.degrees_of_freedom < MANY {
        return planned;
    }
    let joined: Vec<LinkPlan> =
        plans.iter().map(|plan| LinkPlan { composite_sum: true, ..plan.clone() }).collect();
    let positions = chain.links.iter().flat_map(|link| walk::symbols(&[link.motion.position]));
    let positions: BTreeSet<SymbolId> = positions.collect();
    let cost = |matrix: &SymmetricMatrix<'g>| {
        operations(&matrix.rows(), |symbol| !positions.contains(&symbol)).flops()
    };
    let others = [
        mass_matrix(chain, &joined),
        in_common_axes(chain, Arms::InLinks),
        in_common_axes(chain, Arms::InCommonAxes),
    ];
    let forms = [planned].into_iter().chain(others);
    let cheapest = forms.min_by_key(cost);
    cheapest.unwrap_or_else(|| SymmetricMatrix::zero(chain.graph, chain.degrees_of_freedom))
}

/// M(q), including drives.
///
/// An entry couples two joints, of which one is inward of the other. It is the product of the wrench that a unit
/// acceleration of the outer joint requires and the motion of the inner joint at unit velocity. The product is the same
/// wherever it is evaluated: at the inner joint (R. Featherstone's composite-body algorithm, "Rigid Body Dynamics
/// Algorithms", 2008, Table 6.2), at the outer joint, or in between. [`LinkPlan::projected_at`] of the outer link
/// specifies the place.
pub(crate) fn mass_matrix<'g>(chain: &Chain<'g>, plans: &[LinkPlan]) -> SymmetricMatrix<'g> {
    let frames = Frames::new(chain, |index| plans[index].composite_sum);
    let composites = composites(&frames);
    let mut matrix = SymmetricMatrix::zero(chain.graph, chain.degrees_of_freedom);
    for (index, link) in chain.links.iter().enumerate() {
        let mut wrench = inertial_wrench(&composites[index], &frames.joint_twist(index));
        // A gyroscopic rotor acts on the parent; for the joint itself, only the reflected inertia counts.
        wrench.moment.0[2] += link.rotor_coupling;
        let mut propagated = Propagated::from_home(index, wrench);
        for projection in projections(&frames, index, plans[index].projected_at) {
            propagated.propagate_to(&frames, projection.place);
            let other = projection.inner;
            let motion = projection.twist(&frames, &frames.joint_twist(other));
            let element = motion.dot(&propagated.load);
            if other == index {
                let own = element * link.ratio * link.ratio;
                matrix.add(link.coordinate, link.coordinate, own);
            } else {
                add_coupled(&mut matrix, link, &chain.links[other], element);
            }
        }
        let reflected = drive(link) * link.ratio * link.ratio;
        matrix.add(link.coordinate, link.coordinate, reflected);
    }
    matrix
}

/// The axes in which the positions of the links' origins are summed and wrenches and motions are shifted to them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arms {
    /// The links' own axes, in which arms and joint axes have the fewest components.
    InLinks,
    /// The common axes, in which parallel joints have the same direction.
    InCommonAxes,
}

/// M(q) with all wrenches and motions in the axes of the innermost link, for long chains with skew axes. An entry takes
/// six products, however far apart the joints are, and a joint takes about a hundred operations.
pub(crate) fn in_common_axes<'g>(chain: &Chain<'g>, arms: Arms) -> SymmetricMatrix<'g> {
    let frames = Frames::new(chain, |_| false);
    let composites = composites(&frames);
    let mut matrix = SymmetricMatrix::zero(chain.graph, chain.degrees_of_freedom);
    // For each link: its own axes in the common axes, its origin, and the motion of its joint in the common axes.
    let mut axes: Vec<Matrix<'g>> = vec![];
    let mut origins: Vec<Vector<'g>> = vec![];
    let mut motions: Vec<Twist<'g>> = vec![];
    for (index, link) in chain.links.iter().enumerate() {
        let joint_frame = &frames.joint_frames[index];
        let motion = frames.joint_twist(index);
        let mut wrench = inertial_wrench(&composites[index], &motion);
        wrench.moment.0[2] += link.rotor_coupling;
        let own = motion.dot(&wrench);
        let own = (own + drive(link)) * link.ratio * link.ratio;
        matrix.add(link.coordinate, link.coordinate, own);
        let Some(parent) = link.parent else {
            axes.push(Matrix::identity(chain.graph));
            origins.push(Vector::zero(chain.graph));
            motions.push(motion);
            continue;
        };
        let home = link.rotation.forward_axes(&axes[parent]);
        let Matrix(rows) = home;
        axes.push(Matrix(rows.map(|row| joint_frame.turn.back(Vector(row)).0)));
        let turned = |wrench: Wrench<'g>, motion: Twist<'g>| {
            let wrench = Wrench { force: home * wrench.force, moment: home * wrench.moment };
            let motion = Twist { angular: home * motion.angular, linear: home * motion.linear };
            (wrench, motion)
        };
        let (wrench, motion) = match arms {
            Arms::InLinks => {
                let origin = link.rotation.back(origins[parent] + joint_frame.origin);
                origins.push(joint_frame.turn.back(origin));
                turned(wrench.about(origin), motion.about(-origin))
            }
            Arms::InCommonAxes => {
                let origin = origins[parent] + axes[parent] * joint_frame.origin;
                origins.push(origin);
                let (wrench, motion) = turned(wrench, motion);
                (wrench.about(origin), motion.about(-origin))
            }
        };
        motions.push(motion);
        let carriers = std::iter::successors(Some(parent), |link| chain.links[*link].parent);
        for inner in carriers {
            let element = motions[inner].dot(&wrench);
            add_coupled(&mut matrix, link, &chain.links[inner], element);
        }
    }
    matrix
}

/// Adds the coupling of two joints to the entry of their coordinates.
fn add_coupled<'g>(
    matrix: &mut SymmetricMatrix<'g>,
    link: &ChainLink<'g>,
    inner: &ChainLink<'g>,
    element: Expr<'g>,
) {
    let coupled = element * link.ratio * inner.ratio;
    // Two joints of one coordinate contribute twice to its diagonal entry, once in either order.
    let coupled = if inner.coordinate == link.coordinate { coupled * 2 } else { coupled };
    matrix.add(link.coordinate, inner.coordinate, coupled);
}

/// The inertia of a joint's drive, without the part that acts on its parent.
fn drive<'g>(link: &ChainLink<'g>) -> Expr<'g> {
    let own_coupling = match link.kind {
        JointKind::Revolute => link.rotor_coupling,
        JointKind::Prismatic => link.ratio.graph().zero(),
    };
    link.reflected_inertia - own_coupling
}

#[cfg(test)]
mod tests {
    use robot_numeric::random::{Random, Recipe};
    use robot_numeric::robots;
    use robot_symbolic::Graph;

    use super::*;
    use crate::economical::{Plan, Recursion};
    use crate::mechanism::{Mechanism, MechanismOptions};

    /// With fewer than nine coordinates, the mass matrix has the form of the plan. With nine or more, it has the
    /// cheapest form, which is another one for chains with joints about arbitrary axes.
    #[test]
    fn other_forms_are_tried_from_nine_coordinates_on() {
        for joints in 6..=11 {
            let robot = robots::robot(&mut Random::new(7), &Recipe::serial(joints));
            let graph = Graph::new();
            let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::ROUNDED);
            let plan = Plan::uniform(joints, &LinkPlan::BASIC);
            let chain = Recursion::new(&mechanism, &plan).unwrap().chain;
            let cost = |matrix: &SymmetricMatrix<'_>| {
                let rows = matrix.rows();
                operations(&rows, |symbol| !graph.symbol_name(symbol).starts_with('q')).flops()
            };
            let planned = mass_matrix(&chain, &plan.links);
            let others =
                [Arms::InLinks, Arms::InCommonAxes].map(|arms| in_common_axes(&chain, arms));
            let found = cheapest(&chain, &plan.links);
            let least = others.iter().map(cost).min().unwrap();
            if joints < 9 {
                assert_eq!(found.rows(), planned.rows(), "{joints}");
            } else {
                assert_eq!(cost(&found), least, "{joints}");
                assert!(least < cost(&planned), "{joints}");
            }
        }
    }
}
