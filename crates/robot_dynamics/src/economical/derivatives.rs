//! Derivatives of the joint torques by positions and velocities, and the Coriolis matrix, by
//! composite quantities.
//!
//! Write a joint's unit motion as the 4 × 4 matrix Ẑ, a link's motion as V, its pseudo-inertia as P
//! and ⟨Ẑ, N⟩ for the power of the forces N = ∫ a rᵀ dm. With Ẏ = \[V, Ẑ\], the rate of Ẑ, and
//! X = \[A', Ẑ\] − 2 Ẏ V', all about the joint and before its own motion, a joint j shifts the
//! accelerations of all links k that it carries by (X + 2 Ẏ V_k) dq_j and by
//! (2 Ẏ + 2 Ẑ V_k) dq̇_j. Both X and Ẏ are twists. Summed over the links that a joint carries,
//! P and B = Σ V P are all that is needed:
//!
//! - ∂τᵢ/∂qⱼ = ⟨Ẑᵢ, X P + 2 Ẏ B⟩ and ∂τᵢ/∂q̇ⱼ = ⟨Ẑᵢ, 2 Ẏ P + 2 Ẑⱼ B⟩ with the composites of the
//!   outer of both joints;
//! - if j is the outer one, its whole wrench W turns along as well: + Ẑⱼ ×* W.
//!
//! The Christoffel form of the Coriolis matrix is half of ∂τ/∂q̇.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::Recursion;
use crate::economical::composite::projection::{Propagate, Propagated, projections};
use crate::economical::composite::{composites, gather, inertial_wrench};
use crate::economical::frames::Frames;
use crate::economical::frames::chain::Chain;
use crate::economical::plan::Place;
use crate::economical::recursion::inward::own_wrench;
use crate::economical::recursion::outward::{self, Accelerations, LinkState};
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::momentum::Momentum;
use crate::economical::spatial::{Twist, Wrench};
use crate::matrix::SquareMatrix;
use crate::vector::Vector;

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
        let motions = Motions::new(&frames, &states, chain.graph.integer(2));
        let wrenches = {
            let own = states.iter().enumerate().map(|(index, state)| {
                let (force, moment) = own_wrench(chain, index, state, &self.plans[index]);
                Wrench { force, moment }
            });
            gather(&frames, own.collect())
        };
        let composites = Composites::new(&frames, &motions);
        let n = chain.degrees_of_freedom;
        let mut positions = SquareMatrix::zero(chain.graph, n);
        let mut velocities = SquareMatrix::zero(chain.graph, n);
        self.each_pair(&frames, &motions, &composites, &mut velocities);
        for (index, link) in chain.links.iter().enumerate() {
            let load = composites.of_position(&frames, &motions, index, &wrenches[index]);
            let mut propagated = Propagated::from_home(index, load);
            for projection in projections(&frames, index, self.plans[index].projected_at) {
                propagated.propagate_to(&frames, projection.place);
                let inner = &chain.links[projection.inner];
                let factor = link.ratio * inner.ratio;
                let load = &propagated.load;
                let motion = &motions.links[projection.inner];
                let unit = projection.twist(&frames, &motion.unit);
                let inward = unit.dot(&load.own) * factor;
                positions.add(inner.coordinate, link.coordinate, inward);
                if projection.inner != index {
                    let shift = projection.twist(&frames, &motion.shift);
                    let turning = projection.twist(&frames, &motion.turning);
                    let outward = shift.dot(&load.unit) + turning.angular.dot(load.projected);
                    positions.add(link.coordinate, inner.coordinate, outward * factor);
                }
            }
        }
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
        let mut matrix = SquareMatrix::zero(chain.graph, chain.degrees_of_freedom);
        self.each_pair(&frames, &motions, &composites, &mut matrix);
        Some(matrix)
    }

    /// Adds ⟨Ẑᵢ, Ẏ P + Ẑⱼ B⟩ for all pairs of joints, times the factor of the motions.
    fn each_pair(
        &self,
        frames: &Frames<'_, 'g>,
        motions: &Motions<'g>,
        composites: &Composites<'g>,
        matrix: &mut SquareMatrix<'g>,
    ) {
        let links = &frames.chain.links;
        for (index, link) in links.iter().enumerate() {
            let load = composites.of_velocity(frames, motions, index);
            let mut propagated = Propagated::from_home(index, load);
            for projection in projections(frames, index, self.plans[index].projected_at) {
                propagated.propagate_to(frames, projection.place);
                let inner = &links[projection.inner];
                let factor = link.ratio * inner.ratio;
                let load = &propagated.load;
                let motion = &motions.links[projection.inner];
                let unit = projection.twist(frames, &motion.unit);
                let inward = unit.dot(&load.own) * factor;
                matrix.add(inner.coordinate, link.coordinate, inward);
                if projection.inner != index {
                    let rate = projection.twist(frames, &motion.rate);
                    let outward = rate.dot(&load.unit) + unit.angular.dot(load.projected);
                    matrix.add(link.coordinate, inner.coordinate, outward * factor);
                }
            }
        }
    }
}

/// The motions of a joint in its link's home axes, before its own motion.
#[derive(Clone, Copy, Debug)]
struct JointMotion<'g> {
    /// Z: the motion for a unit rate.
    unit: Twist<'g>,
    /// Y = \[V, Z\], times the factor of the motions.
    rate: Twist<'g>,
    /// The angular part of Y itself.
    turning: Twist<'g>,
    /// X, the shift of the accelerations.
    shift: Twist<'g>,
}

/// The motions of all joints and links.
struct Motions<'g> {
    links: Vec<JointMotion<'g>>,
    /// V of the links, in own axes, times the factor.
    twists: Vec<Twist<'g>>,
}

impl<'g> Motions<'g> {
    /// `factor` is 1 or 2: V and Y come in pairs of equal terms in the derivatives, and doubling
    /// them once is cheaper than doubling the products.
    fn new(frames: &Frames<'_, 'g>, states: &[LinkState<'g>], factor: Expr<'g>) -> Motions<'g> {
        let chain = frames.chain;
        let zero = Vector::zero(chain.graph);
        let (mut links, mut twists): (Vec<JointMotion<'g>>, Vec<Twist<'g>>) = (vec![], vec![]);
        for (index, link) in chain.links.iter().enumerate() {
            let joint_frame = &frames.joint_frames[index];
            let home = |vector| frames.parent_to_home(index, vector);
            let at_rest = Twist { angular: zero, linear: zero };
            let carrier = link.parent.map_or(at_rest, |parent| twists[parent]);
            let carried = carrier.linear + carrier.angular.cross(joint_frame.origin);
            let (omega, column, acceleration) = match link.parent {
                Some(parent) => {
                    let state = &states[parent];
                    let acceleration = state.acceleration + state.tensor * joint_frame.origin;
                    (state.angular_velocity, state.tensor * link.axis, acceleration)
                }
                None => (zero, zero, -chain.gravity),
            };
            let unit = frames.joint_twist(index);
            links.push(JointMotion::new(
                &unit,
                factor,
                home(omega),
                home(carried),
                home(column),
                home(acceleration),
            ));
            let mut velocity = joint_frame.turn.back(link.rotation.back(carried));
            match link.kind {
                JointKind::Revolute => {}
                JointKind::Prismatic => velocity.0[2] += link.motion.velocity * factor,
            }
            let angular = states[index].angular_velocity * factor;
            twists.push(Twist { angular, linear: velocity });
        }
        Motions { links, twists }
    }
}

impl<'g> JointMotion<'g> {
    /// From the parent's angular velocity ω, the velocity of the link's origin as a point of the
    /// parent times the factor, U z, and the acceleration of the link's origin.
    fn new(
        unit: &Twist<'g>,
        factor: Expr<'g>,
        omega: Vector<'g>,
        velocity: Vector<'g>,
        column: Vector<'g>,
        acceleration: Vector<'g>,
    ) -> JointMotion<'g> {
        let zero = Vector::zero(omega.0[0].graph());
        let turning = Twist { angular: omega.cross(unit.angular), linear: zero };
        // \[V, Z\] = (ω × z, ω × z_v + v × z)
        let rate = Twist {
            angular: turning.angular * factor,
            linear: omega.cross(unit.linear) * factor + velocity.cross(unit.angular),
        };
        // Of a rotation (U z, a × z + 2 v × (ω × z)), of a translation (0, U z).
        let shift = if unit.angular.is_zero() {
            Twist { angular: zero, linear: column * unit.linear.0[2] }
        } else {
            Twist {
                angular: column,
                linear: acceleration.cross(unit.angular) + velocity.cross(turning.angular),
            }
        };
        JointMotion { unit: *unit, rate, turning, shift }
    }
}

/// P and B of every link and all that it carries, in home axes; B times the factor of the motions.
struct Composites<'g> {
    inertias: Vec<PseudoInertia<'g>>,
    momenta: Vec<Momentum<'g>>,
}

/// The quantities of an outer joint that are propagated to the inner joints.
#[derive(Clone, Copy, Debug)]
struct Load<'g> {
    /// P Z of the outer joint.
    unit: Wrench<'g>,
    /// The projection of B on the outer joint, per component of the inner joint's turning.
    projected: Vector<'g>,
    /// The wrench caused by the outer joint's own motion.
    own: Wrench<'g>,
}

impl<'g> Propagate<'g> for Load<'g> {
    fn inward(&self, frames: &Frames<'_, 'g>, place: Place) -> Self {
        Load {
            unit: self.unit.inward(frames, place),
            projected: self.projected.inward(frames, place),
            own: self.own.inward(frames, place),
        }
    }
}

impl<'g> Composites<'g> {
    fn new(frames: &Frames<'_, 'g>, motions: &Motions<'g>) -> Composites<'g> {
        let links = frames.chain.links.iter().zip(&motions.twists);
        let own = links.map(|(link, twist)| Momentum::of_link(twist, &link.inertia)).collect();
        Composites { inertias: composites(frames), momenta: gather(frames, own) }
    }

    fn of_velocity(
        &self,
        frames: &Frames<'_, 'g>,
        motions: &Motions<'g>,
        index: usize,
    ) -> Load<'g> {
        let (motion, momentum) = (&motions.links[index], &self.momenta[index]);
        let by_rate = inertial_wrench(&self.inertias[index], &motion.rate);
        Load {
            own: by_rate.plus(&momentum.wrench_of_unit_rate(&motion.unit)),
            ..self.common(frames, index)
        }
    }

    fn of_position(
        &self,
        frames: &Frames<'_, 'g>,
        motions: &Motions<'g>,
        index: usize,
        whole: &Wrench<'g>,
    ) -> Load<'g> {
        let (motion, momentum) = (&motions.links[index], &self.momenta[index]);
        let by_shift = inertial_wrench(&self.inertias[index], &motion.shift);
        let by_turning = momentum.wrench_of_unit_rate(&motion.turning);
        let along = whole.carried_by(&motion.unit);
        Load { own: along.plus(&by_shift.plus(&by_turning)), ..self.common(frames, index) }
    }

    fn common(&self, frames: &Frames<'_, 'g>, index: usize) -> Load<'g> {
        let unit = frames.joint_twist(index);
        Load {
            unit: inertial_wrench(&self.inertias[index], &unit),
            projected: self.momenta[index].project(&unit),
            own: Wrench::zero(frames.chain.graph),
        }
    }
}
