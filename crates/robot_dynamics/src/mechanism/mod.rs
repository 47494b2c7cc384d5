//! The robot in symbols: a [`Robot`]'s formulas lowered into a graph, ready for a recursion.

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

/// Options for turning a robot's values into expressions.
#[derive(Clone, Debug, PartialEq)]
pub struct MechanismOptions {
    /// Constant angles within this many radians of a multiple of π/2 become that multiple, so that rotations with
    /// rounded angles are exact; each change is reported in [`Mechanism::snapped`]. With 0, constant angles keep all
    /// digits of the file.
    pub snap: f64,
    /// Whether irrational constants (the sine of an arbitrary constant angle) become floating-point numbers, as code
    /// needs them, or stay symbolic, as printed equations need them.
    pub rounded: bool,
}

impl MechanismOptions {
    /// For print: exact constants.
    pub const EXACT: MechanismOptions = MechanismOptions { snap: snap::DEFAULT, rounded: false };
    /// For code: irrational constants as floating-point numbers.
    pub const ROUNDED: MechanismOptions = MechanismOptions { snap: snap::DEFAULT, rounded: true };

    /// These options with a tolerance: the one given, else the robot file's, else [`snap::DEFAULT`].
    #[must_use]
    pub fn with_snap(self, given: Option<f64>, robot: &Robot) -> MechanismOptions {
        MechanismOptions { snap: given.or(robot.snap).unwrap_or(snap::DEFAULT), ..self }
    }
}

/// A symbolic robot.
///
/// Coordinates, velocities and accelerations are the symbols `q1`, `qd1`, `qdd1` …; parameters and
/// wrench components carry the file's names.
#[derive(Clone, Debug)]
pub struct Mechanism<'g> {
    /// The graph of all expressions.
    pub graph: &'g Graph,
    /// Acceleration of gravity in the base frame, m/s².
    pub gravity: Vector<'g>,
    /// The moving links, parents before children.
    pub links: Vec<MechanismLink<'g>>,
    /// Named frames.
    pub frames: Vec<MechanismFrame<'g>>,
    /// The number of generalized coordinates.
    pub degrees_of_freedom: usize,
    /// The constant angles that were snapped.
    pub snapped: Vec<Snap>,
    /// The motion of the base if it is not at rest: for parts of a robot, which only joint torques are derived of.
    pub(crate) base: Option<BaseMotion<'g>>,
}

/// The motion of a base, in its own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BaseMotion<'g> {
    /// rad/s.
    pub(crate) angular_velocity: Vector<'g>,
    /// rad/s².
    pub(crate) angular_acceleration: Vector<'g>,
    /// Acceleration of the origin, gravity included as one, m/s².
    pub(crate) acceleration: Vector<'g>,
}

impl<'g> BaseMotion<'g> {
    /// At rest, in a field of gravity.
    pub(crate) fn at_rest(gravity: Vector<'g>) -> BaseMotion<'g> {
        let zero = Vector::zero(gravity.0[0].graph());
        BaseMotion { angular_velocity: zero, angular_acceleration: zero, acceleration: -gravity }
    }

    /// Any motion, in symbols of its own.
    pub(crate) fn any(graph: &'g Graph) -> BaseMotion<'g> {
        // No parameter has such a name.
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
    /// The link or frame whose placement has the angle.
    pub name: String,
    /// The angle in the file, rad.
    pub angle: f64,
    /// The multiple of π/2 minus the angle, rad.
    pub change: f64,
}

/// A symbolic link. Vectors are in the link's own frame unless said otherwise.
#[derive(Clone, Debug)]
pub struct MechanismLink<'g> {
    /// The parent link; `None` for the base.
    pub parent: Option<usize>,
    /// Rotation of the frame at joint position 0: link components to parent components.
    pub rotation: Matrix<'g>,
    /// Origin of the frame at joint position 0, parent components, m.
    pub translation: Vector<'g>,
    /// Rotation or translation.
    pub kind: JointKind,
    /// Unit vector of the joint axis; the same in the frame before and after the joint's motion.
    pub axis: Vector<'g>,
    /// The coordinate that moves the joint.
    pub coordinate: usize,
    /// The joint's position per unit of the coordinate.
    pub ratio: Expr<'g>,
    /// Joint position, rad or m.
    pub position: Expr<'g>,
    /// Joint velocity, rad/s or m/s.
    pub velocity: Expr<'g>,
    /// Joint acceleration, rad/s² or m/s².
    pub acceleration: Expr<'g>,
    /// Mass, kg.
    pub mass: Expr<'g>,
    /// Center of mass, m.
    pub center_of_mass: Vector<'g>,
    /// Inertia tensor about the center of mass, kg m².
    pub inertia: Matrix<'g>,
    /// Friction.
    pub friction: MechanismFriction<'g>,
    /// Inertia of the drive reflected to the joint: armature + N² × rotor inertia, kg m² or kg.
    pub reflected_inertia: Expr<'g>,
    /// N × rotor inertia if the drive is gyroscopic and its carrier, the parent link, moves; 0
    /// otherwise. The rotor's angular momentum against its carrier is this times the joint's
    /// velocity, about the joint axis: kg m² per rad or m of the joint.
    pub rotor_coupling: Expr<'g>,
}

/// Friction in symbols; see [`robot_model::robot::Friction`].
#[derive(Clone, Debug)]
pub struct MechanismFriction<'g> {
    /// b of equation (4).
    pub viscous: Expr<'g>,
    /// c of equation (5).
    pub coulomb: Expr<'g>,
    /// d of equation (5), m.
    pub spindle_diameter: Expr<'g>,
    /// Constant dry friction for positive velocities.
    pub coulomb_positive: Expr<'g>,
    /// Constant dry friction for negative velocities.
    pub coulomb_negative: Expr<'g>,
    /// Constant offset.
    pub offset: Expr<'g>,
    /// Width of the smooth sign.
    pub smoothing: Option<Expr<'g>>,
}

impl<'g> MechanismFriction<'g> {
    /// The direction of a velocity: its sign, or the smooth one.
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
    /// The name.
    pub name: String,
    /// The link that carries it; `None` for the base.
    pub link: Option<usize>,
    /// Rotation: frame components to link components.
    pub rotation: Matrix<'g>,
    /// Origin, link components, m.
    pub translation: Vector<'g>,
    /// Force and moment that the frame exerts on its surroundings, frame components, if it is a
    /// tip; N and N m.
    pub wrench: Option<(Vector<'g>, Vector<'g>)>,
}

impl<'g> Mechanism<'g> {
    /// The robot in symbols of `graph`.
    #[must_use]
    pub fn new(robot: &Robot, graph: &'g Graph, options: &MechanismOptions) -> Mechanism<'g> {
        lower::lower(robot, graph, options)
    }

    /// The generalized coordinate of that index (from 0), `q1` for the first.
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
    /// The rotation of the link's frame, including the joint's motion: \[R\]ᵢⁱ⁻¹ of the paper, link components to
    /// parent components.
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

    /// Unit vector of the joint axis in parent components.
    #[must_use]
    pub fn axis_in_parent(&self) -> Vector<'g> {
        self.rotation * self.axis
    }

    /// The origin of the link's frame, including the joint's motion, in parent components: r̄ᵢⁱ⁻¹.
    #[must_use]
    pub fn joint_translation(&self) -> Vector<'g> {
        match self.kind {
            JointKind::Revolute => self.translation,
            JointKind::Prismatic => self.translation + self.rotation * (self.axis * self.position),
        }
    }
}
