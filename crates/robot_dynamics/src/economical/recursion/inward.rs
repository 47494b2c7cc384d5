//! The inward recursion: forces and moments on regrouped inertias from the tips to the base, and the joint torques.
//!
//! Regrouping moves inertia between links, so the forces between links are not those of the robot. Only their
//! projections on the joint axes are.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::frames::chain::{Chain, ChainLink};
use crate::economical::plan::LinkPlan;
use crate::economical::recursion::outward::LinkState;
use crate::vector::{Matrix, Vector};

/// A wrench that a tip exerts, in the working frame of its link and in the chain's unit of length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TipWrench<'g> {
    pub(crate) link: usize,
    pub(crate) force: Vector<'g>,
    pub(crate) moment: Vector<'g>,
}

/// The joint torques, in the order of the coordinates.
pub(crate) fn inward<'g>(
    chain: &Chain<'g>,
    plans: &[LinkPlan],
    states: &[LinkState<'g>],
    tips: &[TipWrench<'g>],
) -> Vec<Expr<'g>> {
    let zero = Vector::zero(chain.graph);
    let count = chain.links.len();
    let mut forces = vec![zero; count];
    // Moments about each link's origin; their z components accumulate along a parallel group.
    let mut moments = vec![zero; count];
    // For each group, at the index of its first link: the sum of its links' moments perpendicular to the axis.
    let mut across = vec![zero; count];
    for tip in tips {
        forces[tip.link] = forces[tip.link] + tip.force;
        moments[tip.link] = moments[tip.link] + tip.moment;
    }
    let mut torques = vec![chain.graph.zero(); chain.degrees_of_freedom];
    for (index, link) in chain.links.iter().enumerate().rev() {
        let state = &states[index];
        let (force, moment) = own_wrench(chain, index, state, &plans[index]);
        forces[index] = force + forces[index];
        moments[index] = moment + moments[index];
        let torque = match link.kind {
            JointKind::Revolute => moments[index].0[2] + link.reflected_inertia * state.rate,
            JointKind::Prismatic => {
                let reflected = link.reflected_inertia * chain.unit * state.rate;
                forces[index].0[2] / chain.unit + reflected
            }
        };
        let (rotor_torque, rotor_moment) = rotor(chain, link, states, state.rate);
        torques[link.coordinate] += (torque + rotor_torque) * link.ratio;

        let joint_frame = &state.joint_frame;
        let turned = joint_frame.group_turn.forward(moments[index]);
        let sum = across[joint_frame.group] + turned;
        across[joint_frame.group] = Vector([sum.0[0], sum.0[1], chain.graph.zero()]);
        let Some(parent) = link.parent else { continue };
        let in_parent = link.rotation.forward(joint_frame.turn.forward(forces[index]));
        forces[parent] = forces[parent] + in_parent;
        moments[parent] = moments[parent] + joint_frame.origin.cross(in_parent) + rotor_moment;
        if joint_frame.group == index {
            let Vector([x, y, _]) = across[index];
            let about_axis = moments[index].0[2];
            moments[parent] = moments[parent] + link.rotation.forward(Vector([x, y, about_axis]));
        } else {
            let about_axis = moments[index].0[2];
            moments[parent].0[2] += about_axis;
        }
    }
    torques
}

/// The torque J N a · ε that a gyroscopic rotor requires at its joint, and the moment J N (q̈ a + q̇ ω × a) that it
/// requires from the link that carries it. ω and ε are those of the carrier.
fn rotor<'g>(
    chain: &Chain<'g>,
    link: &ChainLink<'g>,
    states: &[LinkState<'g>],
    rate: Expr<'g>,
) -> (Expr<'g>, Vector<'g>) {
    let Some(parent) = link.parent.filter(|_| !link.rotor_coupling.is_zero()) else {
        return (chain.graph.zero(), Vector::zero(chain.graph));
    };
    let carrier = &states[parent];
    let torque = link.rotor_coupling * carrier.angular_acceleration.dot(link.axis);
    let momentum = |motion| link.rotor_coupling * chain.in_meters(link, motion);
    let turning = carrier.angular_velocity.cross(link.axis) * momentum(link.motion.velocity);
    (torque, link.axis * momentum(rate) + turning)
}

/// The wrench that a link's own inertia requires: the force F = m a + U h and the moment about the origin.
pub(crate) fn own_wrench<'g>(
    chain: &Chain<'g>,
    index: usize,
    state: &LinkState<'g>,
    plan: &LinkPlan,
) -> (Vector<'g>, Vector<'g>) {
    let inertia = &chain.links[index].inertia;
    let force = state.acceleration * inertia.mass + state.tensor * inertia.first;
    let from_second = Vector([0, 1, 2].map(|k| moment_of_second(state, inertia.second, k, plan)));
    (force, from_second + inertia.first.cross(state.acceleration))
}

/// Component k of ∫ r × U r dm. With the cyclically following components p and q, it is
/// U_qk Σ_kp − U_pk Σ_kq + (U_qp Σ_pp − U_pq Σ_qq) + (U_qq − U_pp) Σ_pq.
fn moment_of_second<'g>(
    state: &LinkState<'g>,
    Matrix(s): Matrix<'g>,
    k: usize,
    plan: &LinkPlan,
) -> Expr<'g> {
    let (p, q) = ((k + 1) % 3, (k + 2) % 3);
    let (Matrix(u), Vector(w)) = (state.tensor, state.angular_velocity);
    let skew = if plan.moment[k] {
        // U_qp = ω_p ω_q + ε_k and U_pq = ω_p ω_q − ε_k
        w[p] * w[q] * (s[p][p] - s[q][q]) + state.angular_acceleration.0[k] * (s[p][p] + s[q][q])
    } else {
        u[q][p] * s[p][p] - u[p][q] * s[q][q]
    };
    // U_qq − U_pp = ω_q² − ω_p²
    let difference = if plan.diagonal { u[q][q] - u[p][p] } else { w[q] * w[q] - w[p] * w[p] };
    (u[q][k] * s[k][p] - u[p][k] * s[k][q]) + skew + difference * s[p][q]
}
