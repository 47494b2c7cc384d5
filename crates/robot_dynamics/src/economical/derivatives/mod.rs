//! Derivatives of the joint torques with respect to positions and velocities, and the Coriolis matrix, by composite
//! quantities.
//!
//! Let Ẑ be a joint's unit motion as a 4 × 4 matrix, V a link's motion, A = V̇ + V² the matrix with which the link's
//! point r has the acceleration A r, P its pseudo-inertia, and ⟨Ẑ, N⟩ the power of the forces N = ∫ (A r) rᵀ dm = A P.
//! Let Ẏ = \[V, Ẑ\], the time derivative of Ẑ, and X = \[A, Ẑ\] − 2 Ẏ V, with V and A of the joint's link. A joint j
//! then changes the accelerations of every link k that it carries by (X + 2 Ẏ V_k) dq_j and by (2 Ẏ + 2 Ẑ V_k) dq̇_j.
//! Both X and Ẏ are twists. Of the links that a joint carries, only the sums P and B = Σ V P are needed:
//!
//! - ∂τᵢ/∂qⱼ = ⟨Ẑᵢ, X P + 2 Ẏ B⟩ and ∂τᵢ/∂q̇ⱼ = ⟨Ẑᵢ, 2 Ẏ P + 2 Ẑⱼ B⟩ with the composites of the outer of the two
//!   joints;
//! - if j is the outer joint, its whole wrench W also turns with the joint, which adds Ẑⱼ ×* W.
//!
//! The Christoffel form of the Coriolis matrix is half of ∂τ/∂q̇.
//!
//! In the first form, B is taken relative to the link whose composite it is: B = V P + B'. Then B' of a last link is
//! zero, B' of a parent is computed from those of its children and the motions of their joints, and no link's own
//! inertia is multiplied by its motion. Thus X P + 2 Ẏ B = \[A, Ẑ\] P + 2 Ẏ B' and Ẏ P + Ẑ B = V Ẑ P + Ẑ B'. The
//! velocity of the link's origin cancels.
//!
//! In the second form, B and the accelerations are taken relative to the parent, the body that carries the joint, with
//! its V and A. The whole wrench is then that of A P + 2 V B'' plus R, the wrench for a carrier at rest. R is summed
//! like B'', and no link's own inertia is multiplied by its acceleration. P, B'' and R turn with the joint while V and
//! A do not, so the derivative of the whole wrench with respect to qⱼ is the wrench of A P' + 2 V B''' plus R', with P'
//! = Ẑ P + P Ẑᵀ, B''' likewise, and R' = Ẑ ×* R.
//!
//! Which form needs fewer operations depends on the robot: it is the first one if the links have few nonzero moments.

mod composites;
mod loads;
mod motions;
mod positions;

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::Recursion;
use crate::economical::composite::projection::{Propagated, projections};
use crate::economical::frames::Frames;
use crate::economical::frames::chain::Chain;
use crate::economical::recursion::outward::{self, Accelerations};
use crate::matrix::SquareMatrix;
use composites::Composites;
use loads::{Load, Loads};
use motions::Motions;

/// The body relative to which quantities are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reference {
    /// The joint's own link.
    Link,
    /// The link that carries the joint.
    Carrier,
}

/// A choice between the forms of the wrenches that joint motions cause; all forms have the same values.
#[derive(Clone, Copy, Debug)]
struct Form {
    velocities: Reference,
    positions: Reference,
}

impl Form {
    const ALL: [Form; 3] = [
        Form { velocities: Reference::Link, positions: Reference::Link },
        Form { velocities: Reference::Carrier, positions: Reference::Carrier },
        Form { velocities: Reference::Link, positions: Reference::Carrier },
    ];
}

/// The derivatives ∂τ/∂q and ∂τ/∂q̇.
#[derive(Clone, Debug)]
pub struct TorqueDerivatives<'g> {
    /// ∂τᵢ/∂qⱼ in row i and column j.
    pub positions: SquareMatrix<'g>,
    /// ∂τᵢ/∂q̇ⱼ in row i and column j.
    pub velocities: SquareMatrix<'g>,
}

impl<'g> Recursion<'g> {
    /// The derivatives of the joint torques at the accelerations q̈, in several forms. The result is empty if a drive
    /// is gyroscopic, because composites do not contain the momentum of its rotor.
    #[must_use]
    pub fn torque_derivatives(&self) -> Vec<TorqueDerivatives<'g>> {
        self.torque_derivatives_of(&self.chain)
    }

    /// The derivatives at the given accelerations, one for each coordinate, instead of the symbols q̈. The result is
    /// empty in the same case as that of [`Recursion::torque_derivatives`].
    #[must_use]
    pub fn torque_derivatives_at(&self, accelerations: &[Expr<'g>]) -> Vec<TorqueDerivatives<'g>> {
        let mut chain = self.chain.clone();
        for link in &mut chain.links {
            let unit = match link.kind {
                JointKind::Revolute => chain.graph.one(),
                JointKind::Prismatic => chain.unit,
            };
            link.motion.acceleration = accelerations[link.coordinate] * link.ratio / unit;
        }
        self.torque_derivatives_of(&chain)
    }

    fn torque_derivatives_of(&self, chain: &Chain<'g>) -> Vec<TorqueDerivatives<'g>> {
        let forms = Form::ALL.into_iter().filter(|_| !chain.is_gyroscopic());
        let chain = &chain.without_idle_turns(&[]);
        let states = outward::outward(chain, &self.plans, Accelerations::Given);
        let frames = &Frames::new(chain, |index| self.plans[index].composite_sum);
        let motions = &Motions::new(frames, &states, chain.graph.integer(2));
        let derivatives = forms.map(|form| {
            let composites = &Composites::new(frames, &self.plans, &states, motions, form);
            let loads = Loads { frames, motions, composites, form };
            TorqueDerivatives {
                positions: matrix(
                    frames,
                    |index| loads.of_position(index),
                    |inner, load| motions.links[inner].by_position(load),
                ),
                velocities: velocities(&loads),
            }
        });
        derivatives.collect()
    }

    /// C(q, q̇) by Christoffel symbols, in several forms: C q̇ are the Coriolis and centrifugal terms, and Ṁ − 2 C is
    /// skew-symmetric. The result is empty in the same case as that of [`Recursion::torque_derivatives`].
    #[must_use]
    pub fn coriolis_matrix(&self) -> Vec<SquareMatrix<'g>> {
        let mut chain = self.chain.without_idle_turns(&[]);
        for link in &mut chain.links {
            link.motion.acceleration = chain.graph.zero();
        }
        let forms = Form::ALL.into_iter().filter(|_| !chain.is_gyroscopic()).take(2);
        let states = outward::outward(&chain, &self.plans, Accelerations::Given);
        let frames = &Frames::new(&chain, |index| self.plans[index].composite_sum);
        let motions = &Motions::new(frames, &states, chain.graph.one());
        let matrices = forms.map(|form| {
            let composites = &Composites::new(frames, &self.plans, &states, motions, form);
            velocities(&Loads { frames, motions, composites, form })
        });
        matrices.collect()
    }
}

/// The matrix ∂τ/∂q̇, or half of it if the factor of the motions is 1.
fn velocities<'g>(loads: &Loads<'_, 'g>) -> SquareMatrix<'g> {
    matrix(
        loads.frames,
        |index| loads.of_velocity(index),
        |inner, load| loads.motions.links[inner].by_velocity(load),
    )
}

/// The matrix over the coordinates. The entries in the rows of inner joints are the projections of an outer joint's
/// load on these joints. The entries in the outer joint's row are computed by `outward` from an inner joint and the
/// load in the home axes of its link.
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
