//! The functions that can be derived, and their names.

use super::named::{FrameRef, suffixes};
use super::reach::out_of_reach;
use crate::robot::Robot;

/// The functions that can be derived.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FunctionKind {
    /// Q from q, q̇, q̈.
    InverseDynamics,
    /// Q from q, q̇, q̈ and the tips' wrenches.
    InverseDynamicsWrench,
    /// Q with friction from q, q̇, q̈.
    InverseDynamicsFriction,
    /// Q with friction from q, q̇, q̈ and the tips' wrenches.
    InverseDynamicsWrenchFriction,
    /// F_l and M_l of every joint.
    LinkWrenches,
    /// M from q.
    MassMatrix,
    /// C q̇ + g from q, q̇.
    Bias,
    /// g from q.
    Gravity,
    /// q̈ from q, q̇, τ.
    ForwardDynamics,
    /// q̈ from q, q̇, τ and the tips' wrenches.
    ForwardDynamicsWrench,
    /// q̈ with friction from q, q̇, τ.
    ForwardDynamicsFriction,
    /// q̈ with friction from q, q̇, τ and the tips' wrenches.
    ForwardDynamicsWrenchFriction,
    /// The poses of the links' frames from q.
    ForwardKinematics,
    /// The poses of the named frames from q.
    FramePoses,
    /// The Jacobian from q: a function for each named frame, or for the last link of each branch where
    /// the robot has no named frame.
    Jacobian,
    /// The Jacobian of one frame from q.
    JacobianOf(FrameRef),
    /// J̇ q̇ from q, q̇: a function for each frame, as of [`FunctionKind::Jacobian`].
    JacobianDotQd,
    /// J̇ q̇ of one frame from q, q̇.
    JacobianDotQdOf(FrameRef),
    /// Kinetic and potential energy from q, q̇.
    Energies,
    /// C from q, q̇, by Christoffel symbols.
    CoriolisMatrix,
    /// ∂Q/∂q and ∂Q/∂q̇ from q, q̇, q̈.
    InverseDynamicsDerivatives,
    /// ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ from q, q̇, τ.
    ForwardDynamicsDerivatives,
    /// Y of Q = Y π from q, q̇, q̈, with the parameters of links and drives π.
    Regressor,
    /// Y of Q = Y β from q, q̇, q̈, with the base parameters β, the fewest that do.
    RegressorBase,
    /// β from the robot's parameters alone.
    BaseParameters,
}

impl FunctionKind {
    /// All functions but those of single frames.
    pub const ALL: &'static [FunctionKind] = &[
        FunctionKind::InverseDynamics,
        FunctionKind::InverseDynamicsWrench,
        FunctionKind::InverseDynamicsFriction,
        FunctionKind::InverseDynamicsWrenchFriction,
        FunctionKind::LinkWrenches,
        FunctionKind::MassMatrix,
        FunctionKind::Bias,
        FunctionKind::Gravity,
        FunctionKind::ForwardDynamics,
        FunctionKind::ForwardDynamicsWrench,
        FunctionKind::ForwardDynamicsFriction,
        FunctionKind::ForwardDynamicsWrenchFriction,
        FunctionKind::ForwardKinematics,
        FunctionKind::FramePoses,
        FunctionKind::Jacobian,
        FunctionKind::JacobianDotQd,
        FunctionKind::Energies,
        FunctionKind::CoriolisMatrix,
        FunctionKind::InverseDynamicsDerivatives,
        FunctionKind::ForwardDynamicsDerivatives,
        FunctionKind::Regressor,
        FunctionKind::RegressorBase,
        FunctionKind::BaseParameters,
    ];

    /// The name in code and on the command line; of a function of one frame that of its kind, behind which
    /// [`FunctionKind::full_name`] puts the frame's.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            FunctionKind::InverseDynamics => "inverse_dynamics",
            FunctionKind::InverseDynamicsWrench => "inverse_dynamics_wrench",
            FunctionKind::InverseDynamicsFriction => "inverse_dynamics_friction",
            FunctionKind::InverseDynamicsWrenchFriction => "inverse_dynamics_wrench_friction",
            FunctionKind::LinkWrenches => "link_wrenches",
            FunctionKind::MassMatrix => "mass_matrix",
            FunctionKind::Bias => "bias",
            FunctionKind::Gravity => "gravity",
            FunctionKind::ForwardDynamics => "forward_dynamics",
            FunctionKind::ForwardDynamicsWrench => "forward_dynamics_wrench",
            FunctionKind::ForwardDynamicsFriction => "forward_dynamics_friction",
            FunctionKind::ForwardDynamicsWrenchFriction => "forward_dynamics_wrench_friction",
            FunctionKind::ForwardKinematics => "forward_kinematics",
            FunctionKind::FramePoses => "frame_poses",
            FunctionKind::Jacobian | FunctionKind::JacobianOf(_) => "jacobian",
            FunctionKind::JacobianDotQd | FunctionKind::JacobianDotQdOf(_) => "jacobian_dot_qd",
            FunctionKind::Energies => "energies",
            FunctionKind::CoriolisMatrix => "coriolis_matrix",
            FunctionKind::InverseDynamicsDerivatives => "inverse_dynamics_derivatives",
            FunctionKind::ForwardDynamicsDerivatives => "forward_dynamics_derivatives",
            FunctionKind::Regressor => "regressor",
            FunctionKind::RegressorBase => "regressor_base",
            FunctionKind::BaseParameters => "base_parameters",
        }
    }

    /// The frame of a function of one frame.
    #[must_use]
    pub const fn frame(self) -> Option<FrameRef> {
        match self {
            FunctionKind::JacobianOf(frame) | FunctionKind::JacobianDotQdOf(frame) => Some(frame),
            _ => None,
        }
    }

    /// The function of one frame, of a kind that has one for each.
    #[must_use]
    pub const fn of_frame(self, frame: FrameRef) -> Option<FunctionKind> {
        match self {
            FunctionKind::Jacobian => Some(FunctionKind::JacobianOf(frame)),
            FunctionKind::JacobianDotQd => Some(FunctionKind::JacobianDotQdOf(frame)),
            _ => None,
        }
    }

    /// The name of the function: that of the kind, or of one frame `jacobian_tool`.
    #[must_use]
    pub fn full_name(self, robot: &Robot) -> String {
        let suffixes = self.frame().map(|frame| (frame, suffixes(robot)));
        let suffix = suffixes.and_then(|(frame, suffixes)| {
            suffixes.into_iter().find(|(other, _)| *other == frame).map(|(_, suffix)| suffix)
        });
        suffix.map_or_else(|| self.name().to_owned(), |suffix| format!("{}_{suffix}", self.name()))
    }

    /// The functions of single frames that a kind stands for; none of a kind that is one function by
    /// itself, as also where the robot has one frame.
    #[must_use]
    pub fn parts(self, robot: &Robot) -> Vec<FunctionKind> {
        let frames = FrameRef::usual(robot);
        let several = frames.len() > 1;
        frames.into_iter().filter(|_| several).filter_map(|frame| self.of_frame(frame)).collect()
    }

    /// The function of that name; for those of single frames see [`named`](super::named()).
    #[must_use]
    pub fn from_name(name: &str) -> Option<FunctionKind> {
        FunctionKind::ALL.iter().copied().find(|kind| kind.name() == name)
    }

    /// Whether the function takes the tips' wrenches, and is there for a robot with a tip alone.
    #[must_use]
    pub fn has_wrench(self) -> bool {
        matches!(
            self,
            FunctionKind::InverseDynamicsWrench
                | FunctionKind::InverseDynamicsWrenchFriction
                | FunctionKind::ForwardDynamicsWrench
                | FunctionKind::ForwardDynamicsWrenchFriction
        )
    }

    /// Whether the function has the friction of the joints in it.
    #[must_use]
    pub fn has_friction(self) -> bool {
        matches!(
            self,
            FunctionKind::InverseDynamicsFriction
                | FunctionKind::InverseDynamicsWrenchFriction
                | FunctionKind::ForwardDynamicsFriction
                | FunctionKind::ForwardDynamicsWrenchFriction
        )
    }

    /// Why the robot has no such function; `None` where it has.
    #[must_use]
    pub fn missing_in(self, robot: &Robot) -> Option<&'static str> {
        let (needs_tip, needs_friction) = (self.has_wrench(), self.has_friction());
        if self.frame().is_some_and(|frame| frame.name(robot).is_none()) {
            return Some("the robot has no such frame");
        }
        if self == FunctionKind::FramePoses && robot.frames.is_empty() {
            return Some("the robot has no named frame; add [tip] or [[frame]] to its file");
        }
        if needs_tip && robot.tips().next().is_none() {
            return Some("the robot has no tip with a wrench; add [tip] to its file");
        }
        if needs_friction && !robot.has_friction() {
            return Some(
                "no joint has friction; add `friction` to a link of the file, which `robot-symbolic import --friction` does for the `<dynamics>` of URDF",
            );
        }
        match self {
            FunctionKind::RegressorBase | FunctionKind::BaseParameters => out_of_reach(robot),
            _ => None,
        }
    }

    /// Whether the function solves with the mass matrix, which must not be singular. It is then free to choose
    /// the accelerations of its bias.
    #[must_use]
    pub const fn divides_by_mass_matrix(self) -> bool {
        matches!(
            self,
            FunctionKind::ForwardDynamics
                | FunctionKind::ForwardDynamicsWrench
                | FunctionKind::ForwardDynamicsFriction
                | FunctionKind::ForwardDynamicsWrenchFriction
                | FunctionKind::ForwardDynamicsDerivatives
        )
    }

    /// The functions that a robot has.
    #[must_use]
    pub fn of(robot: &Robot) -> Vec<FunctionKind> {
        FunctionKind::ALL.iter().copied().filter(|kind| kind.missing_in(robot).is_none()).collect()
    }
}
