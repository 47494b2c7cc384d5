//! The functions that can be derived, and their names.

use crate::base_parameters::out_of_reach;
use crate::model::Robot;

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
    /// A named frame's Jacobian from q: a function per frame.
    Jacobian,
    /// J̇ q̇ of a named frame from q, q̇: a function per frame.
    JacobianDotQd,
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
    /// All functions.
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

    /// The name in code and on the command line.
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
            FunctionKind::Jacobian => "jacobian",
            FunctionKind::JacobianDotQd => "jacobian_dot_qd",
            FunctionKind::Energies => "energies",
            FunctionKind::CoriolisMatrix => "coriolis_matrix",
            FunctionKind::InverseDynamicsDerivatives => "inverse_dynamics_derivatives",
            FunctionKind::ForwardDynamicsDerivatives => "forward_dynamics_derivatives",
            FunctionKind::Regressor => "regressor",
            FunctionKind::RegressorBase => "regressor_base",
            FunctionKind::BaseParameters => "base_parameters",
        }
    }

    /// The function of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<FunctionKind> {
        FunctionKind::ALL.iter().copied().find(|kind| kind.name() == name)
    }

    /// Whether the function takes the tips' wrenches, and is there for a robot with a tip alone.
    pub(crate) fn has_wrench(self) -> bool {
        matches!(
            self,
            FunctionKind::InverseDynamicsWrench
                | FunctionKind::InverseDynamicsWrenchFriction
                | FunctionKind::ForwardDynamicsWrench
                | FunctionKind::ForwardDynamicsWrenchFriction
        )
    }

    /// Whether the function has the friction of the joints in it.
    pub(crate) fn has_friction(self) -> bool {
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
        let needs_frame = matches!(
            self,
            FunctionKind::FramePoses | FunctionKind::Jacobian | FunctionKind::JacobianDotQd
        );
        if needs_frame && robot.frames.is_empty() {
            return Some("the robot has no named frame; add [tip] or [[frame]] to its file");
        }
        if needs_tip && robot.tips().next().is_none() {
            return Some("the robot has no tip with a wrench; add [tip] to its file");
        }
        if needs_friction && !robot.has_friction() {
            return Some("no joint has friction; add `friction` to a link of the file");
        }
        match self {
            FunctionKind::RegressorBase | FunctionKind::BaseParameters => out_of_reach(robot),
            _ => None,
        }
    }

    /// The functions that a robot has.
    #[must_use]
    pub fn of(robot: &Robot) -> Vec<FunctionKind> {
        FunctionKind::ALL.iter().copied().filter(|kind| kind.missing_in(robot).is_none()).collect()
    }
}
