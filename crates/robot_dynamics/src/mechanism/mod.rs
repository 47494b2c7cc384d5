//! The symbolic robot: the formulas of a [`Robot`] lowered into a graph, ready for a recursion.

mod direction;
mod lower;
mod parallel;
mod snapped;

use robot_model::robot::{JointKind, Robot};
use robot_model::snap;
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Graph};

use crate::vector::{Matrix, Vector};
pub use snapped::snapped;

/// The options for expressing a robot's values.
#[derive(Clone, Debug, PartialEq)]
pub struct MechanismOptions {
    /// The tolerance within which a constant angle becomes a multiple of π/2, rad, so that rotations with rounded
    /// angles are exact. Each change is reported in [`Mechanism::snapped`]. With 0, constant angles keep all digits of
    /// the file.
    pub snap: f64,
    /// Whether irrational constants, such as the sine of an arbitrary constant angle, become floating-point numbers.
    /// Code needs this; printed equations need them to remain symbolic.
    pub rounded: bool,
}

impl MechanismOptions {
    /// The options for printed equations: exact constants.
    pub const EXACT: MechanismOptions = MechanismOptions { snap: snap::DEFAULT, rounded: false };
    /// The options for code: irrational constants as floating-point numbers.
    pub const ROUNDED: MechanismOptions = MechanismOptions { snap: snap::DEFAULT, rounded: true };

    /// These options with the given tolerance; if it is `None`, that of the robot file, or else [`snap::DEFAULT`].
    #[must_use]
    pub fn with_snap(self, given: Option<f64>, robot: &Robot) -> MechanismOptions {
        MechanismOptions { snap: given.or(robot.snap).unwrap_or(snap::DEFAULT), ..self }
    }
}

/// A symbolic robot.
///
/// Positions, velocities and accelerations are the symbols `q1`, `qd1`, `qdd1` …; parameters and wrench components have
/// the names in the robot file.
#[derive(Clone, Debug)]
pub struct Mechanism<'g> {
    /// The graph of all expressions.
    pub graph: &'g Graph,
    /// The acceleration of gravity in the base frame, m/s².
    pub gravity: Vector<'g>,
    /// The moving links, parents before children.
    pub links: Vec<MechanismLink<'g>>,
    /// The named frames.
    pub frames: Vec<MechanismFrame<'g>>,
    /// The number of coordinates.
    pub degrees_of_freedom: usize,
    /// The constant angles that were snapped.
    pub snapped: Vec<Snap>,
    /// The motion of the base; `None` if it is at rest. It is only used for parts of a robot, of which only joint
    /// torques are derived.
    pub(crate) base: Option<BaseMotion<'g>>,
}

/// The motion of a base, in its own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BaseMotion<'g> {
    /// The angular velocity, rad/s.
    pub(crate) angular_velocity: Vector<'g>,
    /// The angular acceleration, rad/s².
    pub(crate) angular_acceleration: Vector<'g>,
    /// The acceleration of the origin, including gravity as an acceleration of the base, m/s².
    pub(crate) acceleration: Vector<'g>,
}

impl<'g> BaseMotion<'g> {
    /// A base at rest in a field of gravity.
    pub(crate) fn at_rest(gravity: Vector<'g>) -> BaseMotion<'g> {
        let zero = Vector::zero(gravity.0[0].graph());
        BaseMotion { angular_velocity: zero, angular_acceleration: zero, acceleration: -gravity }
    }

    /// An arbitrary motion, given by additional symbols.
    pub(crate) fn any(graph: &'g Graph) -> BaseMotion<'g> {
        // These names are not valid for parameters.
        let vector = |letter| {
            Vector(["x", "y", "z"].map(|axis| graph.symbol(&format!("base {letter} {axis}"))))
        };
        BaseMotion {
            angular_velocity: vector("ω"),
            angular_acceleration: vector("ε"),
            acceleration: vector("a"),
        }
    }
}

/// A constant angle that was snapped to a multiple of π/2.
#[derive(Clone, Debug, PartialEq)]
pub struct Snap {
    /// The name of the link, body or frame whose placement contains the angle; the first of them if there are several.
    pub name: String,
    /// The angle in the file, rad.
    pub angle: f64,
    /// The multiple of π/2 minus the angle, rad.
    pub change: f64,
}

/// A symbolic link. Vectors are in the link's own frame unless stated otherwise.
#[derive(Clone, Debug)]
pub struct MechanismLink<'g> {
    /// The index of the parent link; `None` for the base.
    pub parent: Option<usize>,
    /// The rotation of the frame at joint position 0, from link components to parent components.
    pub rotation: Matrix<'g>,
    /// The origin of the frame at joint position 0, in parent components, m.
    pub translation: Vector<'g>,
    /// The kind of the joint.
    pub kind: JointKind,
    /// The unit vector of the joint axis, which is the same in the frame before and after the joint's motion.
    pub axis: Vector<'g>,
    /// The coordinate that moves the joint.
    pub coordinate: usize,
    /// The joint's position per unit of the coordinate.
    pub ratio: Expr<'g>,
    /// The joint position, rad or m.
    pub position: Expr<'g>,
    /// The joint velocity, rad/s or m/s.
    pub velocity: Expr<'g>,
    /// The joint acceleration, rad/s² or m/s².
    pub acceleration: Expr<'g>,
    /// The mass, kg.
    pub mass: Expr<'g>,
    /// The center of mass, m.
    pub center_of_mass: Vector<'g>,
    /// The inertia tensor about the center of mass, kg m².
    pub inertia: Matrix<'g>,
    /// The friction in the joint.
    pub friction: MechanismFriction<'g>,
    /// The inertia of the drive reflected to the joint: armature + N² × rotor inertia, kg m² or kg.
    pub reflected_inertia: Expr<'g>,
    /// N × rotor inertia if the drive is gyroscopic and its carrier, the parent link, moves; otherwise 0. The product
    /// of this and the joint velocity is the rotor's angular momentum relative to its carrier, about the joint axis: kg
    /// m² per rad or m of the joint.
    pub rotor_coupling: Expr<'g>,
}

/// The friction in a joint in symbols; see [`robot_model::robot::Friction`].
#[derive(Clone, Debug)]
pub struct MechanismFriction<'g> {
    /// The coefficient b of equation (4), N m s/rad or N s/m.
    pub viscous: Expr<'g>,
    /// The coefficient c of equation (5), without unit.
    pub coulomb: Expr<'g>,
    /// The diameter d in equation (5), m.
    pub spindle_diameter: Expr<'g>,
    /// The constant dry friction at positive velocities, N m or N.
    pub coulomb_positive: Expr<'g>,
    /// The constant dry friction at negative velocities, N m or N, as a positive value.
    pub coulomb_negative: Expr<'g>,
    /// A constant offset, N m or N.
    pub offset: Expr<'g>,
    /// The width of the smooth sign, rad/s or m/s; `None` for the exact sign.
    pub smoothing: Option<Expr<'g>>,
}

impl<'g> MechanismFriction<'g> {
    /// The sign of a velocity, exact or smooth.
    pub(crate) fn sign(&self, velocity: Expr<'g>) -> Expr<'g> {
        match self.smoothing {
            Some(width) => (velocity / width).tanh(),
            None => velocity.sign(),
        }
    }
}

/// A symbolic named frame.
#[derive(Clone, Debug)]
pub struct MechanismFrame<'g> {
    /// The name of the frame.
    pub name: String,
    /// The index of the link that carries it; `None` for the base.
    pub link: Option<usize>,
    /// The rotation from frame components to link components.
    pub rotation: Matrix<'g>,
    /// The origin, in link components, m.
    pub translation: Vector<'g>,
    /// The force and moment that a tip exerts on its surroundings, in frame components, N and N m; `None` if the frame
    /// is not a tip.
    pub wrench: Option<(Vector<'g>, Vector<'g>)>,
}

impl<'g> Mechanism<'g> {
    /// Expresses the robot in symbols of `graph`.
    #[must_use]
    pub fn new(robot: &Robot, graph: &'g Graph, options: &MechanismOptions) -> Mechanism<'g> {
        lower::lower(robot, graph, options)
    }

    /// The generalized coordinate with the given index from 0: `q1` for the first.
    #[must_use]
    pub fn coordinate(&self, index: usize) -> Expr<'g> {
        self.graph.symbol(&JointVariable::Position.symbol(index))
    }

    /// The links whose parent is `link`.
    pub fn children(&self, link: usize) -> impl Iterator<Item = usize> {
        (link + 1..self.links.len()).filter(move |child| self.links[*child].parent == Some(link))
    }
}

impl<'g> MechanismLink<'g> {
    /// The rotation of the link's frame, including the joint's motion, from link components to parent components:
    /// \[R\]ᵢⁱ⁻¹ of the paper.
    #[must_use]
    pub fn joint_rotation(&self) -> Matrix<'g> {
        match self.kind {
            JointKind::Revolute => {
                let motion = Matrix::rotation(self.axis, self.position.sin(), self.position.cos());
                self.rotation * motion
            }
            JointKind::Prismatic => self.rotation,
        }
    }

    /// The unit vector of the joint axis in parent components.
    #[must_use]
    pub fn axis_in_parent(&self) -> Vector<'g> {
        self.rotation * self.axis
    }

    /// The origin of the link's frame, including the joint's motion, in parent components: r̄ᵢⁱ⁻¹ of the paper.
    #[must_use]
    pub fn joint_translation(&self) -> Vector<'g> {
        match self.kind {
            JointKind::Revolute => self.translation,
            JointKind::Prismatic => self.translation + self.rotation * (self.axis * self.position),
        }
    }
}
