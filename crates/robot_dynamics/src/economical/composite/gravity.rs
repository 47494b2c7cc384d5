//! The gravity terms of the joint torques.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::composite::composites;
use crate::economical::frames::Frames;
use crate::economical::frames::chain::Chain;
use crate::economical::plan::LinkPlan;
use crate::vector::Vector;

/// g(q): for each joint, the moment or force along its axis that supports everything that its link carries.
///
/// Only first moments are summed toward the base, because the weight acts on each joint as if concentrated in one
/// point.
pub(crate) fn gravity<'g>(chain: &Chain<'g>, plans: &[LinkPlan]) -> Vec<Expr<'g>> {
    let frames = Frames::new(chain, |index| plans[index].composite_sum);
    let composites = composites(&frames);
    // The acceleration of the base that is equivalent to gravity, in each link's own axes and home axes.
    let mut rising: Vec<Vector<'g>> = vec![];
    let mut home: Vec<Vector<'g>> = vec![];
    let mut torques = vec![chain.graph.zero(); chain.degrees_of_freedom];
    for (index, link) in chain.links.iter().enumerate() {
        let at_home = match link.parent {
            Some(parent) if frames.is_joined(index) => home[parent],
            Some(parent) => link.rotation.back(rising[parent]),
            None => link.rotation.back(-chain.gravity),
        };
        home.push(at_home);
        rising.push(frames.joint_frames[index].group_turn.back(at_home));
        let (mass, first) = (composites[index].mass, composites[index].first);
        let torque = match link.kind {
            JointKind::Revolute => first.cross(at_home).0[2],
            JointKind::Prismatic => mass * at_home.0[2] / chain.unit,
        };
        torques[link.coordinate] += torque * link.ratio;
    }
    torques
}

/// The potential energy −g · ∫ r dm of the robot, with r from the origin of the base frame.
pub(crate) fn weight_in_base<'g>(chain: &Chain<'g>, plans: &[LinkPlan]) -> Expr<'g> {
    let frames = Frames::new(chain, |index| plans[index].composite_sum);
    let mut energy = -(chain.gravity.dot(chain.fixed_moment));
    for (index, composite) in composites(&frames).into_iter().enumerate() {
        let (link, mass, first) = (&chain.links[index], composite.mass, composite.first);
        if link.parent.is_none() {
            let first = link.rotation.forward(first) + frames.joint_frames[index].origin * mass;
            energy -= chain.gravity.dot(first);
        }
    }
    energy
}
