//! Sums over each link and everything that it carries, in the forms that derivatives need.

use robot_model::robot::JointKind;

use super::motions::Motions;
use super::{Form, Reference};
use crate::economical::composite::{
    Accumulate, composites, gather, gather_across, inertial_wrench,
};
use crate::economical::frames::Frames;
use crate::economical::frames::chain::ChainLink;
use crate::economical::plan::LinkPlan;
use crate::economical::recursion::inward::own_wrench;
use crate::economical::recursion::outward::LinkState;
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::momentum::Momentum;
use crate::economical::spatial::{Twist, Wrench};
use crate::vector::Vector;
use robot_symbolic::Expr;

/// The sums for every link and everything that it carries, in home axes about the link's origin.
pub(super) struct Composites<'g> {
    /// The pseudo-inertias P.
    pub(super) inertias: Vec<PseudoInertia<'g>>,
    /// The momenta B relative to the link, times the factor of the motions.
    pub(super) to_links: Vec<Momentum<'g>>,
    /// The momenta B relative to the body that carries the link's joint, times the factor of the motions.
    pub(super) to_carriers: Vec<Momentum<'g>>,
    /// The whole wrenches, which accelerate these bodies.
    pub(super) whole: Vec<Wrench<'g>>,
    /// The wrenches R: the parts of the whole wrenches beyond A P + 2 V B. If the carrier is at rest, these are the
    /// whole wrenches.
    pub(super) beyond: Vec<Wrench<'g>>,
}

impl<'g> Composites<'g> {
    pub(super) fn new(
        frames: &Frames<'_, 'g>,
        plans: &[LinkPlan],
        states: &[LinkState<'g>],
        motions: &Motions<'g>,
        form: Form,
    ) -> Composites<'g> {
        let links = &frames.chain.links;
        let inertias = composites(frames);
        let steps: Vec<Step<'g>> =
            links.iter().map(|link| Step::of(link, motions.factor, form)).collect();
        let at_rest = vec![Momentum::zero(frames.chain.graph); links.len()];
        let crossed = |index: usize, momentum: &Momentum<'g>| {
            steps[index].crossed(momentum, &inertias[index])
        };
        let to_links = gather_across(frames, at_rest, |index, momentum| crossed(index, momentum).1);
        let crossings: Vec<_> =
            to_links.iter().enumerate().map(|(index, momentum)| crossed(index, momentum)).collect();
        let transmitted = |index: usize, wrench: &Wrench<'g>| {
            let step = &steps[index];
            let by_acceleration = inertial_wrench(&inertias[index], &step.acceleration);
            let by_velocity = crossings[index].0.wrench_of_unit_rate(step.velocity.angular);
            wrench.plus(&by_acceleration.plus(&by_velocity))
        };
        let at_rest = vec![Wrench::zero(frames.chain.graph); links.len()];
        let beyond = gather_across(frames, at_rest, transmitted);
        let beyond =
            beyond.iter().enumerate().map(|(index, wrench)| transmitted(index, wrench)).collect();
        let own = states.iter().enumerate().map(|(index, state)| {
            let (force, moment) = own_wrench(frames.chain, index, state, &plans[index]);
            Wrench { force, moment }
        });
        Composites {
            whole: gather(frames, own.collect()),
            to_carriers: crossings.into_iter().map(|(_, momentum)| momentum).collect(),
            inertias,
            to_links,
            beyond,
        }
    }
}

/// The motion of a joint, which is the difference between the motion relative to the joint's carrier and that relative
/// to the link.
struct Step<'g> {
    velocity: Twist<'g>,
    /// The velocity times the factor of the motions.
    scaled: Twist<'g>,
    /// Whether doubled products with the velocity itself are needed in any case.
    adds_twice: bool,
    acceleration: Twist<'g>,
}

impl<'g> Step<'g> {
    fn of(link: &ChainLink<'g>, factor: Expr<'g>, form: Form) -> Step<'g> {
        let zero = Vector::zero(factor.graph());
        let along = |length| match link.kind {
            JointKind::Revolute => Twist { angular: Vector::along_z(length), linear: zero },
            JointKind::Prismatic => Twist { angular: zero, linear: Vector::along_z(length) },
        };
        Step {
            velocity: along(link.motion.velocity),
            scaled: along(link.motion.velocity * factor),
            adds_twice: !factor.is_one() && form.positions == Reference::Carrier,
            acceleration: along(link.motion.acceleration),
        }
    }

    /// Converts B relative to the link to B relative to the carrier, both times the factor. The first result is B with
    /// the joint's velocity added only once, which the velocity of the joint turns: with the factor 2, this is 2 (V B +
    /// V V P / 2).
    fn crossed(
        &self,
        momentum: &Momentum<'g>,
        inertia: &PseudoInertia<'g>,
    ) -> (Momentum<'g>, Momentum<'g>) {
        let once = Momentum::of_body(&self.velocity, inertia);
        let with_once = momentum.plus(&once);
        let mut crossed = momentum.plus(&Momentum::of_body(&self.scaled, inertia));
        if self.adds_twice {
            // These entries also occur in the wrench of a rotation about z.
            let twice = with_once.plus(&once);
            crossed.linear = twice.linear;
            for (row, from) in crossed.second.0.iter_mut().zip(twice.second.0) {
                row[2] = from[2];
            }
        }
        (with_once, crossed)
    }
}
