//! The mass matrix by composite inertias.

use robot_symbolic::Expr;

use super::chain::Chain;
use super::composite::{composites, unit_wrench};
use super::plan::{LinkPlan, Place};
use super::spatial::{Ways, Wrench};
use crate::matrix::SymmetricMatrix;

/// M(q), drives included.
///
/// An element couples two joints, one inward of the other: the wrench that a unit acceleration of
/// the outer joint asks for, and the motion that a unit rate of the inner joint gives. Their
/// product is the same wherever they meet: at the inner joint (R. Featherstone's composite-body
/// algorithm, "Rigid Body Dynamics Algorithms", 2008, Table 6.2), at the outer one or between, as
/// [`LinkPlan::meeting`] of the outer link says.
pub(crate) fn mass_matrix<'g>(chain: &Chain<'g>, plans: &[LinkPlan]) -> SymmetricMatrix<'g> {
    let ways = Ways::new(chain, |index| plans[index].composite_sum);
    let composites = composites(&ways);
    let mut matrix = SymmetricMatrix::zero(chain.graph, chain.degrees_of_freedom);
    for (index, link) in chain.links.iter().enumerate() {
        let wrench = unit_wrench(&ways, index, &composites[index]);
        for (other, element) in elements(&ways, index, wrench, plans[index].meeting) {
            let inner = &chain.links[other];
            let coupled = element * link.ratio * inner.ratio;
            // Joints of one coordinate meet on its diagonal twice, in either order.
            let twice = other != index && inner.coordinate == link.coordinate;
            let coupled = if twice { coupled * 2 } else { coupled };
            matrix.add(link.coordinate, inner.coordinate, coupled);
        }
        let reflected = link.reflected_inertia * link.ratio * link.ratio;
        matrix.add(link.coordinate, link.coordinate, reflected);
    }
    matrix
}

/// The power of a link's wrench for unit rates of its own joint and of all inward of it.
fn elements<'g>(
    ways: &Ways<'_, 'g>,
    link: usize,
    wrench: Wrench<'g>,
    meeting: Option<Place>,
) -> Vec<(usize, Expr<'g>)> {
    let mut place = Place { link, turned: false };
    let mut wrench = wrench;
    let mut elements = vec![(link, ways.project(link, &wrench))];
    // The wrench goes inward to the meeting place …
    while Some(place) != meeting
        && let Some(next) = ways.inward(place)
    {
        wrench = ways.wrench_inward(place, &wrench);
        if next.link != place.link {
            elements.push((next.link, ways.project(next.link, &wrench)));
        }
        place = next;
    }
    // … and the motions of the joints inward of it come outward.
    let mut route = vec![place];
    while let Some(next) = ways.inward(place) {
        if next.link != place.link {
            let mut twist = ways.joint_twist(next.link);
            for step in route.iter().rev() {
                twist = ways.twist_outward(*step, &twist);
            }
            elements.push((next.link, twist.dot(&wrench)));
        }
        route.push(next);
        place = next;
    }
    elements
}
