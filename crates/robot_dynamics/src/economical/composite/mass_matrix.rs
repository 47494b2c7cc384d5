//! The mass matrix by composite inertias.

use crate::economical::composite::projection::{Propagated, projections};
use crate::economical::composite::{composites, inertial_wrench};
use crate::economical::frames::Frames;
use crate::economical::frames::chain::Chain;
use crate::economical::plan::LinkPlan;
use crate::matrix::SymmetricMatrix;
use robot_model::robot::JointKind;

/// M(q), drives included.
///
/// An element couples two joints, one inward of the other: the wrench that a unit acceleration of
/// the outer joint requires, and the motion that a unit rate of the inner joint makes. Their
/// product is the same wherever it is taken: at the inner joint (R. Featherstone's composite-body
/// algorithm, "Rigid Body Dynamics Algorithms", 2008, Table 6.2), at the outer one or between, as
/// [`LinkPlan::projected_at`] of the outer link says.
pub(crate) fn mass_matrix<'g>(chain: &Chain<'g>, plans: &[LinkPlan]) -> SymmetricMatrix<'g> {
    let frames = Frames::new(chain, |index| plans[index].composite_sum);
    let composites = composites(&frames);
    let mut matrix = SymmetricMatrix::zero(chain.graph, chain.degrees_of_freedom);
    for (index, link) in chain.links.iter().enumerate() {
        let mut wrench = inertial_wrench(&composites[index], &frames.joint_twist(index));
        // The parent feels a gyroscopic rotor; the joint itself has its reflected inertia alone.
        wrench.moment.0[2] += link.rotor_coupling;
        let own_coupling = match link.kind {
            JointKind::Revolute => link.rotor_coupling,
            JointKind::Prismatic => chain.graph.zero(),
        };
        let mut propagated = Propagated::from_home(index, wrench);
        for projection in projections(&frames, index, plans[index].projected_at) {
            propagated.propagate_to(&frames, projection.place);
            let other = projection.inner;
            let motion = projection.twist(&frames, &frames.joint_twist(other));
            let element = motion.dot(&propagated.load);
            let inner = &chain.links[other];
            let coupled = element * link.ratio * inner.ratio;
            // Two joints of one coordinate contribute to its diagonal entry twice, in either order.
            let twice = other != index && inner.coordinate == link.coordinate;
            let coupled = if twice { coupled * 2 } else { coupled };
            matrix.add(link.coordinate, inner.coordinate, coupled);
        }
        let reflected = (link.reflected_inertia - own_coupling) * link.ratio * link.ratio;
        matrix.add(link.coordinate, link.coordinate, reflected);
    }
    matrix
}
