//! The economical recursion: a second form of the Newton–Euler recursion, meant for code. It computes the same joint
//! torques as the paper's iterations with the fewest operations; its internal forces have no physical meaning.
//!
//! Links are represented by pseudo-inertias ([`spatial::inertia`](self)), and the accelerations of a link's points by
//! the tensor U = \[ε\]× + \[ω\]×². Each link has a working frame whose z axis is the joint axis. Inertial parameters
//! that a joint cannot distinguish from its parent's are regrouped to the parent, so that a link on a revolute joint
//! keeps seven of its ten. Within this recursion, a [`Plan`] chooses among equivalent forms for each link; [`search`]
//! finds the cheapest plan for a robot by generating candidates and counting their operations.
//!
//! The modules follow the flow: [`plan`] chooses the forms; `frames` prepares the mechanism in working frames;
//! `spatial` contains the algebra of twists, wrenches and inertias; `recursion` proceeds outward and inward; and
//! `composite`, `articulated`, `derivatives` and `regressor` derive the other functions.
//!
//! Sources: Khalil and Kleinfinger 1987 (regrouping, modified Denavit–Hartenberg frames); Balafoutis and Patel 1991
//! (the tensor U). Options that are original to this project are described in [`plan`].

mod articulated;
mod composite;
mod derivatives;
mod frames;
pub mod plan;
mod recursion;
mod regressor;
mod spatial;

use robot_model::robot::JointKind;
use robot_symbolic::{Expr, Graph};

use crate::matrix::{Pivots, SymmetricMatrix};
use crate::mechanism::Mechanism;
use crate::vector::Vector;
use articulated::{Method, Turns};
use composite::{gravity, mass_matrix};
pub use derivatives::TorqueDerivatives;
use frames::chain::{self, Base, Chain};
pub(crate) use frames::reframed::Reframed;
pub(crate) use frames::working::WorkingFrame;
use plan::LinkPlan;
pub use plan::mechanics::mechanics;
pub use plan::{Plan, pin, search};
use recursion::inward::{self, TipWrench};
pub use recursion::kinematics::Pose;
use recursion::outward::{self, Accelerations, LinkState};
pub use regressor::{Column, RegressorColumns};
pub(crate) use regressor::{regressor, unit_rotor, unit_wrenches};
pub(crate) use spatial::Wrench;

/// The method by which forward dynamics solves M q̈ = b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Decomposition of the mass matrix, for few joints.
    MassMatrix,
    /// Elimination of the joints one by one, without the mass matrix, for many joints. It applies if each coordinate
    /// moves exactly one joint.
    ArticulatedBodies,
    /// Elimination of the joints one by one, with additional operations that preserve the digits of small pivots. It is
    /// for robots with links that have almost no inertia about their joint axes.
    SmallPivots,
}

/// The economical recursion of a mechanism for a plan: its links in working frames, with regrouped inertias.
#[derive(Clone, Debug)]
pub struct Recursion<'g> {
    chain: Chain<'g>,
    plans: Vec<LinkPlan>,
    unit_length: Option<(usize, usize)>,
    tips: Vec<TipWrench<'g>>,
}

impl<'g> Recursion<'g> {
    /// Prepares the recursion; `None` if a joint axis depends on parameters, because working frames cannot be chosen in
    /// this case.
    #[must_use]
    pub fn new(mechanism: &Mechanism<'g>, plan: &Plan) -> Option<Recursion<'g>> {
        Some(Recursion::from_base(mechanism, &Base::new(mechanism)?, plan))
    }

    /// Prepares the recursion from the part that does not depend on the plan.
    fn from_base(mechanism: &Mechanism<'g>, base: &Base<'g>, plan: &Plan) -> Recursion<'g> {
        let chain = chain::prepare(mechanism, base, plan);
        let tips = tip_wrenches(mechanism, &chain);
        Recursion { chain, plans: plan.links.clone(), unit_length: plan.unit_length, tips }
    }

    /// The plan that the recursion follows.
    #[must_use]
    pub fn plan(&self) -> Plan {
        Plan { links: self.plans.clone(), unit_length: self.unit_length }
    }

    /// The graph of the recursion's expressions.
    #[must_use]
    pub fn graph(&self) -> &'g Graph {
        self.chain.graph
    }

    /// The number of coordinates.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.chain.degrees_of_freedom
    }

    /// The joint torques Q, N m or N, including the effect of the tips' wrenches if `wrench` is true; friction is not
    /// included.
    #[must_use]
    pub fn inverse_dynamics(&self, wrench: bool) -> Vec<Expr<'g>> {
        self.torques(&self.chain, Accelerations::Given, wrench).0
    }

    /// The bias torques C(q, q̇) q̇ + g(q), N m or N, including the effect of the tips' wrenches if `wrench` is true.
    #[must_use]
    pub fn bias(&self, wrench: bool) -> Vec<Expr<'g>> {
        let mut chain = self.chain.clone();
        for link in &mut chain.links {
            link.motion.acceleration = chain.graph.zero();
        }
        self.torques(&chain, Accelerations::Given, wrench).0
    }

    /// The accelerations q̈, rad/s² or m/s², for the joint torques `tau`, including the effect of the tips' wrenches if
    /// `wrench` is true.
    ///
    /// This solves M q̈ = τ − τ(q̈*) + M q̈*, with accelerations q̈* whose joint torques need few operations
    /// ([`LinkPlan::free`]). `None` if the solver does not apply.
    #[must_use]
    pub fn forward_dynamics(
        &self,
        tau: &[Expr<'g>],
        wrench: bool,
        solver: Solver,
        pivots: Pivots,
    ) -> Option<Vec<Expr<'g>>> {
        if solver != Solver::MassMatrix && !articulated::applies(&self.chain) {
            return None;
        }
        let (torques, states) = self.torques(&self.chain, Accelerations::Free, wrench);
        let excess: Vec<Expr<'g>> =
            tau.iter().zip(torques).map(|(tau, torque)| *tau - torque).collect();
        let articulated = |turns| {
            let chain = self.chain.without_idle_turns(&[]);
            articulated::solve(&chain, &self.plans, &excess, Method { turns, pivots })
        };
        let mut accelerations = match solver {
            Solver::ArticulatedBodies => articulated(Turns::Cheap),
            Solver::SmallPivots => articulated(Turns::Exact),
            Solver::MassMatrix => self.mass_matrix().solve(excess, pivots),
        };
        for (link, state) in self.chain.links.iter().zip(&states) {
            let rate = match link.kind {
                JointKind::Revolute => state.rate,
                JointKind::Prismatic => state.rate * self.chain.unit,
            };
            if !rate.is_zero() {
                accelerations[link.coordinate] += rate / link.ratio;
            }
        }
        Some(accelerations)
    }

    /// Whether each coordinate moves exactly one joint, so that joints can be eliminated one by one.
    pub(crate) fn is_articulated(&self) -> bool {
        articulated::applies(&self.chain)
    }

    /// Solves M x = b with [`Solver::SmallPivots`]; both vectors are ordered by coordinates.
    pub(crate) fn solve_articulated(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let chain = self.chain.without_idle_turns(&[]);
        let method = Method { turns: Turns::Exact, pivots: Pivots::Checked };
        articulated::solve(&chain, &self.plans, right, method)
    }

    /// The pivots D of M = Lᵀ D L, ordered by coordinates, as [`Recursion::forward_dynamics`] computes them with the
    /// given solver; `None` if the solver does not apply.
    pub(crate) fn pivots(&self, solver: Solver) -> Option<Vec<Expr<'g>>> {
        let chain = self.chain.without_idle_turns(&[]);
        let pivots = Pivots::Checked;
        let articulated = |turns| {
            let method = Method { turns, pivots };
            self.is_articulated().then(|| articulated::pivots(&chain, &self.plans, method))
        };
        match solver {
            Solver::MassMatrix => Some(self.mass_matrix().pivots(pivots)),
            Solver::ArticulatedBodies => articulated(Turns::Cheap),
            Solver::SmallPivots => articulated(Turns::Exact),
        }
    }

    fn torques(
        &self,
        chain: &Chain<'g>,
        accelerations: Accelerations,
        wrench: bool,
    ) -> (Vec<Expr<'g>>, Vec<LinkState<'g>>) {
        let tips = if wrench { &self.tips[..] } else { &[] };
        let chain = &chain.without_idle_turns(tips);
        let states = outward::outward(chain, &self.plans, accelerations);
        (inward::inward(chain, &self.plans, &states, tips), states)
    }

    /// The gravity terms g(q), N m or N: the joint torques that hold the mechanism at rest.
    #[must_use]
    pub fn gravity(&self) -> Vec<Expr<'g>> {
        gravity::gravity(&self.chain.without_idle_turns(&[]), &self.plans)
    }

    /// The mass matrix M(q), including drives.
    #[must_use]
    pub fn mass_matrix(&self) -> SymmetricMatrix<'g> {
        mass_matrix::cheapest(&self.chain.without_idle_turns(&[]), &self.plans)
    }
}

/// The wrenches of the tips in working frames.
fn tip_wrenches<'g>(mechanism: &Mechanism<'g>, chain: &Chain<'g>) -> Vec<TipWrench<'g>> {
    let tips = mechanism.frames.iter().filter_map(|frame| {
        let (link, (force, moment)) = (frame.link?, frame.wrench?);
        let working = &chain.frames[link];
        let back = working.axes.transpose();
        let force = back * (frame.rotation * force);
        let arm = back * (frame.translation - working.origin);
        let moment: Vector<'g> = back * (frame.rotation * moment) + arm.cross(force);
        // In the chain's unit of length, a force is represented by its torque at a distance of one unit.
        Some(TipWrench { link, force: force * chain.unit, moment })
    });
    tips.collect()
}
