//! The functions that can be derived, and their names.

use super::named::{FrameRef, suffixes};
use super::reach::out_of_reach;
use crate::robot::Robot;
use crate::variable::JointVariable;

/// Effects on the joint torques besides inertia and gravity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Effects {
    /// The friction in the joints, equations (4) and (5).
    pub friction: bool,
    /// The wrenches that the tips exert, which are additional inputs.
    pub wrench: bool,
}

impl Effects {
    /// Neither effect.
    pub const NONE: Effects = Effects { friction: false, wrench: false };
    /// Only the wrenches.
    pub const WRENCH: Effects = Effects { friction: false, wrench: true };
    /// Only friction.
    pub const FRICTION: Effects = Effects { friction: true, wrench: false };
    /// Both effects.
    pub const BOTH: Effects = Effects { friction: true, wrench: true };
    /// Every combination, in the order in which functions are listed.
    pub const ALL: [Effects; 4] =
        [Effects::NONE, Effects::WRENCH, Effects::FRICTION, Effects::BOTH];

    /// The name of the function with these effects; `names` are in the order of [`Effects::ALL`].
    const fn choose(self, names: [&'static str; 4]) -> &'static str {
        names[self.wrench as usize + 2 * self.friction as usize]
    }
}

/// Declares the functions, each in one row, in the order in which they are listed: the variant, its documentation, and
/// its properties.
///
/// A kind with [`Effects`] stands for one function for each combination of effects. A kind with a [`FrameRef`] is a
/// function of one frame, which is not listed.
macro_rules! functions {
    ($($(#[$doc:meta])* $kind:ident $(($with:ident: $type:ident))? = $declaration:expr;)*) => {
        /// The functions that can be derived.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum FunctionKind {
            $($(#[$doc])* $kind $(($type))?,)*
        }

        /// The listed functions of each row.
        const LISTED: &[&[FunctionKind]] = &[$(listed!($kind $($type)?)),*];

        impl FunctionKind {
            /// The declared properties of the function.
            const fn declaration(self) -> Declaration {
                match self {
                    $(FunctionKind::$kind $(($with))? => $declaration,)*
                }
            }
        }
    };
}

/// The functions that one row lists.
macro_rules! listed {
    ($kind:ident) => {
        &[FunctionKind::$kind]
    };
    ($kind:ident Effects) => {
        &[
            FunctionKind::$kind(Effects::ALL[0]),
            FunctionKind::$kind(Effects::ALL[1]),
            FunctionKind::$kind(Effects::ALL[2]),
            FunctionKind::$kind(Effects::ALL[3]),
        ]
    };
    ($kind:ident FrameRef) => {
        &[]
    };
}

functions! {
    /// The joint torques Q from q, q̇, q̈, with the selected effects.
    InverseDynamics(effects: Effects) = Declaration {
        effects,
        motions: true,
        result: effects.choose(["tau (n)", "tau (n)", "tau (n) with friction", "tau (n) with friction"]),
        ..Declaration::new(
            effects.choose([
                "inverse_dynamics",
                "inverse_dynamics_wrench",
                "inverse_dynamics_friction",
                "inverse_dynamics_wrench_friction",
            ]),
            MOTION,
        )
    };
    /// The forces F_l and moments M_l that the joints transmit, from q, q̇, q̈.
    LinkWrenches = Declaration::new("link_wrenches", MOTION)
        .with_result("force and moment in each joint (links × 3)");
    /// The mass matrix M from q.
    MassMatrix = Declaration::of_composites("mass_matrix", POSITION)
        .with_result("M (n × n)");
    /// The entries in the lower triangle of M that can be nonzero for the robot's structure, from q.
    MassMatrixLower = Declaration::of_composites("mass_matrix_lower", POSITION)
        .with_result("the entries of M's lower triangle for pairs of joints of which one carries the other, row by row");
    /// The bias torques C q̇ + g from q, q̇.
    Bias = Declaration::of_motions("bias", STATE)
        .with_result("bias torques C q̇ + g (n)");
    /// The gravity terms g from q.
    Gravity = Declaration::of_composites("gravity", POSITION)
        .with_result("g (n)");
    /// The joint accelerations q̈ from q, q̇, τ, with the selected effects.
    ForwardDynamics(effects: Effects) = Declaration {
        effects,
        solves: true,
        result: effects.choose(["qdd (n)", "qdd (n)", "qdd (n) with friction", "qdd (n) with friction"]),
        ..Declaration::of_both(
            effects.choose([
                "forward_dynamics",
                "forward_dynamics_wrench",
                "forward_dynamics_friction",
                "forward_dynamics_wrench_friction",
            ]),
            DRIVEN,
        )
    };
    /// The poses of the links' frames from q.
    ForwardKinematics = Declaration::new("forward_kinematics", POSITION)
        .with_result("poses of the links' frames: rotation (links × 9) and position (links × 3)");
    /// The poses of the named frames from q.
    FramePoses = Declaration::of_motions("frame_poses", POSITION)
        .with_result("the same for the named frames");
    /// The Jacobian from q: one function for each named frame, or, if the robot has no named frame, for each link
    /// without children.
    Jacobian = Declaration::of_motions("jacobian", POSITION)
        .with_result("J (6 × n) of each frame");
    /// The Jacobian of one frame from q.
    JacobianOf(_frame: FrameRef) = FunctionKind::Jacobian.declaration();
    /// J̇ q̇ from q, q̇: one function for each frame, as for [`FunctionKind::Jacobian`].
    JacobianDotQd = Declaration::of_motions("jacobian_dot_qd", STATE)
        .with_result("J̇ q̇ (6) of each frame");
    /// J̇ q̇ of one frame from q, q̇.
    JacobianDotQdOf(_frame: FrameRef) = FunctionKind::JacobianDotQd.declaration();
    /// The kinetic and potential energy from q, q̇.
    Energies = Declaration::of_both("energies", STATE)
        .with_result("kinetic energy of the links and drives, potential energy of the links that move");
    /// The Coriolis matrix C from q, q̇, by Christoffel symbols.
    CoriolisMatrix = Declaration::of_both("coriolis_matrix", STATE)
        .with_result("C (n × n)");
    /// The derivatives ∂Q/∂q and ∂Q/∂q̇ from q, q̇, q̈.
    InverseDynamicsDerivatives = Declaration::of_both("inverse_dynamics_derivatives", MOTION)
        .with_result("∂τ/∂q, ∂τ/∂q̇ (n × n)");
    /// The derivatives ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ from q, q̇, τ.
    ForwardDynamicsDerivatives = Declaration {
        solves: true,
        result: "∂q̈/∂q, ∂q̈/∂q̇, ∂q̈/∂τ (n × n)",
        ..Declaration::of_both("forward_dynamics_derivatives", DRIVEN)
    };
    /// The regressor Y in Q = Y π from q, q̇, q̈; π are the standard parameters, those of the links and drives.
    Regressor = Declaration::new("regressor", MOTION)
        .with_result("Y (n × standard parameters)");
    /// The regressor Y in Q = Y β from q, q̇, q̈; β are the base parameters, the smallest possible set.
    RegressorBase = Declaration { base: true, ..Declaration::new("regressor_base", MOTION) }
        .with_result("Y (n × base parameters)");
    /// The values of the base parameters β from the robot's parameters.
    BaseParameters = Declaration { base: true, ..Declaration::new("base_parameters", &[]) }
        .with_result("the base parameters");
}

const POSITION: &[JointVariable] = &[JointVariable::Position];
const STATE: &[JointVariable] = &[JointVariable::Position, JointVariable::Velocity];
const MOTION: &[JointVariable] = &JointVariable::MOTION;
const DRIVEN: &[JointVariable] =
    &[JointVariable::Position, JointVariable::Velocity, JointVariable::Torque];

/// The number of listed functions.
const COUNT: usize = {
    let (mut count, mut row) = (0, 0);
    while row < LISTED.len() {
        count += LISTED[row].len();
        row += 1;
    }
    count
};

/// The listed functions one after another.
const fn all() -> [FunctionKind; COUNT] {
    let mut all = [FunctionKind::Bias; COUNT];
    let (mut count, mut row) = (0, 0);
    while row < LISTED.len() {
        let mut column = 0;
        while column < LISTED[row].len() {
            all[count] = LISTED[row][column];
            count += 1;
            column += 1;
        }
        row += 1;
    }
    all
}

impl FunctionKind {
    /// All functions except those of single frames.
    pub const ALL: &'static [FunctionKind] = &all();

    /// The name in code and on the command line. For a function of one frame, the name of its kind, to which
    /// [`FunctionKind::full_name`] appends the name of the frame.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.declaration().name
    }

    /// The arrays over the joints that the function takes, in the order of the call. The wrenches of the tips follow
    /// them if there are any.
    #[must_use]
    pub const fn inputs(self) -> &'static [JointVariable] {
        self.declaration().inputs
    }

    /// What the function computes, with its shape, where n is the number of coordinates: `M (n × n)`. The tables of
    /// functions in the book and the README are made from it.
    #[must_use]
    pub const fn result(self) -> &'static str {
        self.declaration().result
    }

    /// The effects that the function takes into account.
    #[must_use]
    pub const fn effects(self) -> Effects {
        self.declaration().effects
    }

    /// This function with other effects; `None` if it cannot have any.
    #[must_use]
    pub const fn with_effects(self, effects: Effects) -> Option<FunctionKind> {
        match self {
            FunctionKind::InverseDynamics(_) => Some(FunctionKind::InverseDynamics(effects)),
            FunctionKind::ForwardDynamics(_) => Some(FunctionKind::ForwardDynamics(effects)),
            _ => None,
        }
    }

    /// Whether the recursion over motions and forces is part of the computation.
    #[must_use]
    pub const fn uses_motions(self) -> bool {
        self.declaration().motions
    }

    /// Whether composite inertias are part of the computation.
    #[must_use]
    pub const fn uses_composites(self) -> bool {
        self.declaration().composites
    }

    /// The frame of a function of a single frame.
    #[must_use]
    pub const fn frame(self) -> Option<FrameRef> {
        match self {
            FunctionKind::JacobianOf(frame) | FunctionKind::JacobianDotQdOf(frame) => Some(frame),
            _ => None,
        }
    }

    /// The function of one frame, if this is a kind that has a function for each frame.
    #[must_use]
    pub const fn of_frame(self, frame: FrameRef) -> Option<FunctionKind> {
        match self {
            FunctionKind::Jacobian => Some(FunctionKind::JacobianOf(frame)),
            FunctionKind::JacobianDotQd => Some(FunctionKind::JacobianDotQdOf(frame)),
            _ => None,
        }
    }

    /// The name of the function: that of its kind, or for a function of one frame for example `jacobian_tool`.
    #[must_use]
    pub fn full_name(self, robot: &Robot) -> String {
        let suffixes = self.frame().map(|frame| (frame, suffixes(robot)));
        let suffix = suffixes.and_then(|(frame, suffixes)| {
            suffixes.into_iter().find(|(other, _)| *other == frame).map(|(_, suffix)| suffix)
        });
        suffix.map_or_else(|| self.name().to_owned(), |suffix| format!("{}_{suffix}", self.name()))
    }

    /// The functions of single frames that a kind comprises. None for a kind that is a single function, or if only one
    /// frame is usual ([`FrameRef::usual`]).
    #[must_use]
    pub fn parts(self, robot: &Robot) -> Vec<FunctionKind> {
        let frames = FrameRef::usual(robot);
        let several = frames.len() > 1;
        frames.into_iter().filter(|_| several).filter_map(|frame| self.of_frame(frame)).collect()
    }

    /// The function with the given name. [`named`](super::named()) also finds functions of single frames.
    #[must_use]
    pub fn from_name(name: &str) -> Option<FunctionKind> {
        FunctionKind::ALL.iter().copied().find(|kind| kind.name() == name)
    }

    /// The reason why the robot does not have the function; `None` if it does.
    #[must_use]
    pub fn missing_in(self, robot: &Robot) -> Option<&'static str> {
        let Effects { wrench, friction } = self.effects();
        if self.frame().is_some_and(|frame| frame.name(robot).is_none()) {
            return Some(
                "the robot does not have this frame; choose a named frame or a moving link",
            );
        }
        if self == FunctionKind::FramePoses && robot.frames.is_empty() {
            return Some("the robot has no named frame; add [tip] or [[frame]] to the robot file");
        }
        if wrench && robot.tips().next().is_none() {
            return Some("the robot has no tip with a wrench; add [tip] to the robot file");
        }
        if friction && !robot.has_friction() {
            return Some(
                "no joint has friction; add `friction` to a link of the robot file (the import \
                 option `friction` copies it from the `<dynamics>` of a URDF file)",
            );
        }
        if self.declaration().base { out_of_reach(robot) } else { None }
    }

    /// Whether the function is about the base parameters.
    #[must_use]
    pub const fn has_base_parameters(self) -> bool {
        self.declaration().base
    }

    /// Whether the function solves a system of equations with the mass matrix, which must not be singular. The
    /// recursion of such a function may be evaluated at any accelerations, not only at 0.
    #[must_use]
    pub const fn divides_by_mass_matrix(self) -> bool {
        self.declaration().solves
    }

    /// The functions that a robot has.
    #[must_use]
    pub fn of_robot(robot: &Robot) -> Vec<FunctionKind> {
        FunctionKind::ALL.iter().copied().filter(|kind| kind.missing_in(robot).is_none()).collect()
    }
}

/// The properties of a function that do not depend on the robot.
#[derive(Clone, Copy, Debug)]
struct Declaration {
    name: &'static str,
    inputs: &'static [JointVariable],
    /// What it computes, with its shape.
    result: &'static str,
    effects: Effects,
    /// Whether the recursion over motions and forces is used.
    motions: bool,
    /// Whether composite inertias are used.
    composites: bool,
    /// Whether the function solves a system of equations with the mass matrix.
    solves: bool,
    /// Whether the function concerns the base parameters.
    base: bool,
}

impl Declaration {
    const fn new(name: &'static str, inputs: &'static [JointVariable]) -> Declaration {
        Declaration {
            name,
            inputs,
            result: "",
            effects: Effects::NONE,
            motions: false,
            composites: false,
            solves: false,
            base: false,
        }
    }

    const fn with_result(self, result: &'static str) -> Declaration {
        Declaration { result, ..self }
    }

    const fn of_motions(name: &'static str, inputs: &'static [JointVariable]) -> Declaration {
        Declaration { motions: true, ..Declaration::new(name, inputs) }
    }

    const fn of_composites(name: &'static str, inputs: &'static [JointVariable]) -> Declaration {
        Declaration { composites: true, ..Declaration::new(name, inputs) }
    }

    const fn of_both(name: &'static str, inputs: &'static [JointVariable]) -> Declaration {
        Declaration { motions: true, ..Declaration::of_composites(name, inputs) }
    }
}
