//! Derivatives of the joint torques by positions and velocities, and the Coriolis matrix, by
//! composite quantities.
//!
//! Write a joint's unit motion as the 4 × 4 matrix Ẑ, a link's motion as V, its pseudo-inertia as P
//! and ⟨Ẑ, N⟩ for the power of the forces N = ∫ a rᵀ dm. With Ẏ = \[V, Ẑ\], the rate of Ẑ, and
//! X = \[A, Ẑ\] − 2 Ẏ V, with V and A of the joint's link, a joint j shifts the accelerations of all links k that it
//! carries by (X + 2 Ẏ V_k) dq_j and by (2 Ẏ + 2 Ẑ V_k) dq̇_j. Both X and Ẏ are twists. Summed over the links that a
//! joint carries, P and B = Σ V P are all that is needed:
//!
//! - ∂τᵢ/∂qⱼ = ⟨Ẑᵢ, X P + 2 Ẏ B⟩ and ∂τᵢ/∂q̇ⱼ = ⟨Ẑᵢ, 2 Ẏ P + 2 Ẑⱼ B⟩ with the composites of the
//!   outer of both joints;
//! - if j is the outer one, its whole wrench W turns along as well: + Ẑⱼ ×* W.
//!
//! The Christoffel form of the Coriolis matrix is half of ∂τ/∂q̇.
//!
//! B is taken relative to the link whose composite it is, B = V P + B': the last link then has none, a parent's is that
//! of its children and of their joints' motions, and no link's own inertia is multiplied by its motion. Thus
//! X P + 2 Ẏ B = \[A, Ẑ\] P + 2 Ẏ B' and Ẏ P + Ẑ B = V Ẑ P + Ẑ B'. The velocity of the link's origin drops out.

mod loads;
mod motions;

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::Recursion;
use crate::economical::composite::gather;
use crate::economical::composite::projection::{Propagated, projections};
use crate::economical::frames::Frames;
use crate::economical::frames::chain::Chain;
use crate::economical::recursion::inward::own_wrench;
use crate::economical::recursion::outward::{self, Accelerations};
use crate::economical::spatial::Wrench;
use crate::matrix::SquareMatrix;
use loads::{Composites, Load};
use motions::Motions;

/// ∂τ/∂q and ∂τ/∂q̇.
#[derive(Clone, Debug)]
pub struct TorqueDerivatives<'g> {
    /// ∂τᵢ/∂qⱼ in row i and column j.
    pub positions: SquareMatrix<'g>,
    /// ∂τᵢ/∂q̇ⱼ in row i and column j.
    pub velocities: SquareMatrix<'g>,
}

impl<'g> Recursion<'g> {
    /// The derivatives of the joint torques at the accelerations q̈; `None` if a drive is
    /// gyroscopic: composites do not include its momentum.
    #[must_use]
    pub fn torque_derivatives(&self) -> Option<TorqueDerivatives<'g>> {
        let holds = !self.chain.is_gyroscopic();
        holds.then(|| self.torque_derivatives_of(&self.chain))
    }

    /// The derivatives at accelerations other than the symbols q̈, one per coordinate; `None` under the condition of
    /// [`Recursion::torque_derivatives`].
    #[must_use]
    pub fn torque_derivatives_at(
        &self,
        accelerations: &[Expr<'g>],
    ) -> Option<TorqueDerivatives<'g>> {
        if self.chain.is_gyroscopic() {
            return None;
        }
        let mut chain = self.chain.clone();
        for link in &mut chain.links {
            let unit = match link.kind {
                JointKind::Revolute => chain.graph.one(),
                JointKind::Prismatic => chain.unit,
            };
            link.motion.acceleration = accelerations[link.coordinate] * link.ratio / unit;
        }
        Some(self.torque_derivatives_of(&chain))
    }

    fn torque_derivatives_of(&self, chain: &Chain<'g>) -> TorqueDerivatives<'g> {
        let chain = &chain.without_idle_turns(&[]);
        let states = outward::outward(chain, &self.plans, Accelerations::Given);
        let frames = Frames::new(chain, |index| self.plans[index].composite_sum);
        let own = states.iter().enumerate().map(|(index, state)| {
            let (force, moment) = own_wrench(chain, index, state, &self.plans[index]);
            Wrench { force, moment }
        });
        let wrenches = gather(&frames, own.collect());
        let motions = Motions::new(&frames, &states, chain.graph.integer(2));
        let composites = Composites::new(&frames, &motions);
        let by_velocity = |index| composites.of_velocity(&frames, &motions, index);
        let velocities = matrix(&frames, by_velocity, |inner, load| {
            let motion = &motions.links[inner];
            motion.rate.dot(&load.unit) + motion.unit.angular.dot(load.projected)
        });
        let by_position =
            |index| composites.of_position(&frames, &motions, index, &wrenches[index]);
        let positions = matrix(&frames, by_position, |inner, load| {
            let motion = &motions.links[inner];
            motion.shift.dot(&load.unit) + motion.turning.dot(load.projected)
        });
        TorqueDerivatives { positions, velocities }
    }

    /// C(q, q̇) by Christoffel symbols: C q̇ are the Coriolis and centrifugal terms, and Ṁ − 2 C is skew-symmetric.
    /// `None` under the condition of [`Recursion::torque_derivatives`].
    #[must_use]
    pub fn coriolis_matrix(&self) -> Option<SquareMatrix<'g>> {
        if self.chain.is_gyroscopic() {
            return None;
        }
        let mut chain = self.chain.without_idle_turns(&[]);
        for link in &mut chain.links {
            link.motion.acceleration = chain.graph.zero();
        }
        let states = outward::outward(&chain, &self.plans, Accelerations::Given);
        let frames = Frames::new(&chain, |index| self.plans[index].composite_sum);
        let motions = Motions::new(&frames, &states, chain.graph.one());
        let composites = Composites::new(&frames, &motions);
        let load = |index| composites.of_velocity(&frames, &motions, index);
        Some(matrix(&frames, load, |inner, load| {
            let motion = &motions.links[inner];
            motion.rate.dot(&load.unit) + motion.unit.angular.dot(load.projected)
        }))
    }
}

/// The matrix over the coordinates of an outer joint's loads on inner joints, in the rows of the inner ones, and of
/// what inner joints cause at the outer one, `outward` of an inner joint and the load in its link's home axes.
fn matrix<'m, 'g: 'm>(
    frames: &Frames<'_, 'g>,
    load: impl Fn(usize) -> Load<'m, 'g>,
    outward: impl Fn(usize, &Load<'m, 'g>) -> Expr<'g>,
) -> SquareMatrix<'g> {
    let chain = frames.chain;
    let mut matrix = SquareMatrix::zero(chain.graph, chain.degrees_of_freedom);
    for (index, link) in chain.links.iter().enumerate() {
        let mut propagated = Propagated::from_home(index, load(index));
        for projection in projections(frames, index, None) {
            propagated.propagate_to(frames, projection.place);
            let inner = &chain.links[projection.inner];
            let factor = link.ratio * inner.ratio;
            let load = &propagated.load;
            let inward = frames.joint_twist(projection.inner).dot(&load.own) * factor;
            matrix.add(inner.coordinate, link.coordinate, inward);
            if projection.inner != index {
                let outward = outward(projection.inner, load) * factor;
                matrix.add(link.coordinate, inner.coordinate, outward);
            }
        }
    }
    matrix
}
