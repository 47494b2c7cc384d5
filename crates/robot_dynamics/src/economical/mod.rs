//! The economical recursion: the same torques as the paper's iterations with the fewest operations.
//!
//! Links are pseudo-inertias ([`inertia`](self)); accelerations of a link's points go by the tensor
//! U = \[ε\]× + \[ω\]×²; each link has a working frame with z along its joint axis; inertial
//! parameters that a joint cannot tell from its parent's are regrouped there, so that a link behind a
//! rotation keeps seven of its ten. Within this one recursion, a [`Plan`] chooses among equivalent
//! forms per link; [`search`] finds the cheapest plan for a robot by trying and counting.
//!
//! Sources: Khalil and Kleinfinger 1987 (regrouping, modified Denavit–Hartenberg frames), Balafoutis
//! and Patel 1991 (the tensor U), with further options of this project's own, named in [`plan`].

mod chain;
mod frames;
mod inertia;
mod inward;
mod outward;
pub mod plan;
mod rotation;
pub mod search;

use robot_symbolic::Expr;

use crate::mechanism::Mechanism;
use crate::vector::Vector;
use chain::Base;
use inward::TipWrench;
pub use plan::Plan;

/// The generalised driving forces Q by the economical recursion, with the tips' wrenches where
/// `wrench` asks for them; friction is not part of it.
///
/// `None` where a joint axis depends on parameters, for which working frames cannot be chosen.
#[must_use]
pub fn inverse_dynamics<'g>(
    mechanism: &Mechanism<'g>,
    plan: &Plan,
    wrench: bool,
) -> Option<Vec<Expr<'g>>> {
    let base = Base::new(mechanism)?;
    Some(inverse_dynamics_from(mechanism, &base, plan, wrench))
}

/// The same from what does not depend on the plan.
fn inverse_dynamics_from<'g>(
    mechanism: &Mechanism<'g>,
    base: &Base<'g>,
    plan: &Plan,
    wrench: bool,
) -> Vec<Expr<'g>> {
    let chain = chain::prepare(mechanism, base, plan);
    let states = outward::outward(&chain, &plan.links);
    let tips = if wrench { tip_wrenches(mechanism, &chain) } else { vec![] };
    inward::inward(&chain, &plan.links, &states, &tips)
}

/// The tips' wrenches in working frames.
fn tip_wrenches<'g>(mechanism: &Mechanism<'g>, chain: &chain::Chain<'g>) -> Vec<TipWrench<'g>> {
    let tips = mechanism.frames.iter().filter_map(|frame| {
        let (link, (force, moment)) = (frame.link?, frame.wrench?);
        let working = &chain.frames[link];
        let back = working.axes.transpose();
        let force = back * (frame.rotation * force);
        let arm = back * (frame.translation - working.origin);
        let moment: Vector<'g> = back * (frame.rotation * moment) + arm.cross(force);
        // In the chain's unit of length a force is measured by the torque at one unit.
        Some(TipWrench { link, force: force * chain.unit, moment })
    });
    tips.collect()
}
