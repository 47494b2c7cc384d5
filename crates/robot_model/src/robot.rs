//! The checked robot: what a robot file says, as plain data.
//!
//! Values are [`Formula`]s over the robot's parameters, exactly as the file gives them; nothing is evaluated, merged
//! or repaired here. Units are SI, with angles in radians.

use robot_symbolic::{Formula, Rational};

use crate::unit::Unit;

/// The number of inertial parameters of a link: mass, first moment, inertia tensor.
pub const LINK_PARAMETERS: usize = 10;

/// A robot with a fixed base: links in a tree, each moved by one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The robot's name, an identifier.
    pub name: String,
    /// The file's description: source of the values, remarks.
    pub description: Option<String>,
    /// Acceleration of gravity in the base frame, m/s²: it points down.
    pub gravity: [Formula; 3],
    /// Constant angles within this many radians of a multiple of π/2 stand for that multiple; `None` if the file does
    /// not say.
    pub snap: Option<f64>,
    /// The frames of the link parameters that the base parameters combine.
    pub base_frames: BaseFrames,
    /// The symbols that stay parameters of equations and code, in the file's order.
    pub parameters: Vec<Parameter>,
    /// The generalized coordinates q₁ … qₙ.
    pub coordinates: Vec<Coordinate>,
    /// The moving links, parents before children.
    pub links: Vec<Link>,
    /// Named frames fixed to links or to the base: tips, flanges, merged links.
    pub frames: Vec<Frame>,
    /// The body that the robot may carry, if the file has one; it is also a body of its link.
    pub payload: Option<Payload>,
}

/// The frames of the link parameters that base parameters combine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BaseFrames {
    /// Mass, first moment and inertia tensor about the origin and in the axes of the link's frame in
    /// the file.
    #[default]
    File,
    /// Mass, first and second moments in Denavit–Hartenberg frames, in which the regressor needs fewer operations: z
    /// is the joint axis, and the origin lies on it where the common normal with the axis of the parent's joint meets
    /// it.
    DenavitHartenberg,
}

impl BaseFrames {
    /// All choices.
    pub const ALL: [BaseFrames; 2] = [BaseFrames::File, BaseFrames::DenavitHartenberg];

    /// The name in robot files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            BaseFrames::File => "file",
            BaseFrames::DenavitHartenberg => "denavit_hartenberg",
        }
    }

    /// The choice of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<BaseFrames> {
        BaseFrames::ALL.into_iter().find(|frames| frames.name() == name)
    }
}

/// The names of the parameters of a body that is to be set at run time, all of them 0 by default.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Payload {
    /// Mass, kg.
    pub mass: String,
    /// Center of mass in the carrying frame of the file, m.
    pub center_of_mass: [String; 3],
    /// Tensor about the center of mass, axes of that frame: xx, yy, zz, xy, xz, yz, kg m².
    pub inertia: [String; 6],
}

/// A symbol of the robot file.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name, an identifier: a symbol in equations, a field of `Parameters` in code.
    pub name: String,
    /// The nominal value, exact, in [`Parameter::unit`].
    pub value: Option<Rational>,
    /// The unit; `None` if the file gives none.
    pub unit: Option<Unit>,
    /// Its LaTeX, from a small checked grammar.
    pub latex: Option<String>,
    /// Its meaning, in the file's words.
    pub doc: Option<String>,
}

/// A generalized coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// The name of the joint that it moves.
    pub joint: String,
    /// Radians for a rotation, meters for a translation.
    pub kind: JointKind,
    /// Lower and upper limits if the file gives them; they bound only test states.
    pub limits: Option<[Rational; 2]>,
}

/// Rotation about or translation along the joint axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JointKind {
    /// A rotation: the paper's Δ = 1.
    Revolute,
    /// A translation: the paper's Δ = 0.
    Prismatic,
}

/// A moving link.
///
/// Its frame is the parent's frame (or the base) moved by `placement`, then by the joint. The
/// frame's origin therefore lies on the joint axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The name in the file.
    pub name: String,
    /// The parent link, by index; `None` for the base. Always below the link's own index.
    pub parent: Option<usize>,
    /// The frame at joint position 0, in the parent's frame.
    pub placement: Placement,
    /// The joint that moves the link.
    pub joint: Joint,
    /// The rigid bodies that make up the link: one, or several if fixed links were merged.
    pub bodies: Vec<Body>,
    /// Friction in the joint.
    pub friction: Friction,
    /// The drive's inertia.
    pub drive: Drive,
}

/// The joint between a link and its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The name; the link's if the file names no joints.
    pub name: String,
    /// Rotation or translation.
    pub kind: JointKind,
    /// The axis in the link's frame, of any length but 0.
    pub axis: [Formula; 3],
    /// The coordinate that moves it, an index into [`Robot::coordinates`].
    pub coordinate: usize,
    /// Joint position = `ratio` · q + `offset`; the ratio is 1 except for a joint that mimics another.
    pub ratio: Formula,
    /// See `ratio`; 0 except for a joint that mimics another.
    pub offset: Formula,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The name: that of the link, or of the fixed link that was merged.
    pub name: String,
    /// Mass, kg.
    pub mass: Formula,
    /// The frame in which `inertia` holds: its origin is the center of mass, in the link's frame.
    pub placement: Placement,
    /// Inertia tensor about the center of mass, axes of `placement`, kg m².
    pub inertia: Inertia,
}

/// A symmetric tensor, kg m². Products of inertia are entries of the tensor: xy = −∫xy dm.
#[derive(Clone, Debug, PartialEq)]
pub struct Inertia {
    /// Entry (1, 1).
    pub xx: Formula,
    /// Entry (2, 2).
    pub yy: Formula,
    /// Entry (3, 3).
    pub zz: Formula,
    /// Entry (1, 2).
    pub xy: Formula,
    /// Entry (1, 3).
    pub xz: Formula,
    /// Entry (2, 3).
    pub yz: Formula,
}

impl Inertia {
    /// The names of the entries, in the order of [`Inertia::entries`].
    pub const NAMES: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

    /// The entries (1, 1), (2, 2), (3, 3), (1, 2), (1, 3), (2, 3).
    #[must_use]
    pub fn entries(&self) -> [&Formula; 6] {
        let Inertia { xx, yy, zz, xy, xz, yz } = self;
        [xx, yy, zz, xy, xz, yz]
    }
}

/// A rigid displacement: a sequence of elementary moves, each in the frame reached by the preceding ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Placement(pub Vec<Move>);

/// An elementary move.
#[derive(Clone, Debug, PartialEq)]
pub enum Move {
    /// A translation, m.
    Translate([Formula; 3]),
    /// A rotation about a coordinate axis, rad.
    Rotate(Axis, Formula),
}

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Placement {
    /// A translation followed by rotations about fixed axes, R = Rz(yaw) Ry(pitch) Rx(roll).
    #[must_use]
    pub fn from_xyz_rpy(xyz: [Formula; 3], [roll, pitch, yaw]: [Formula; 3]) -> Placement {
        Placement(vec![
            Move::Translate(xyz),
            Move::Rotate(Axis::Z, yaw),
            Move::Rotate(Axis::Y, pitch),
            Move::Rotate(Axis::X, roll),
        ])
    }

    /// This displacement followed by another.
    #[must_use]
    pub fn then(mut self, other: &Placement) -> Placement {
        self.0.extend(other.0.iter().cloned());
        self
    }
}

/// Friction in a joint; all values are 0 if the file has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// b of equation (4), N m s/rad or N s/m.
    pub viscous: Formula,
    /// c of equation (5): dry friction per contact force across the axis.
    pub coulomb: Formula,
    /// d of equation (5): the journal diameter of a revolute joint, m (the paper's spindle diameter).
    pub spindle_diameter: Formula,
    /// Constant dry friction for positive velocities, N m or N.
    pub coulomb_positive: Formula,
    /// Constant dry friction for negative velocities, N m or N, as a positive value.
    pub coulomb_negative: Formula,
    /// Constant offset, N m or N.
    pub offset: Formula,
    /// Width v of the smooth sign tanh(q̇ / v), rad/s or m/s; `None` for the exact sign function.
    pub smoothing: Option<Formula>,
}

/// The drive's inertia; all values are 0 if the file has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Inertia already reflected to the joint, kg m² or kg.
    pub armature: Formula,
    /// The rotor's inertia about its own axis, kg m².
    pub rotor_inertia: Formula,
    /// The rotor's turns per turn of the joint; the reflected inertia is the square of this ratio times the rotor's
    /// inertia.
    pub gear_ratio: Formula,
    /// Whether the spinning rotor's gyroscopic moments are part of the model: the rotor's axis is
    /// then the joint axis and the rotor is carried by the parent link.
    pub gyroscopic: bool,
}

impl Friction {
    /// No friction.
    #[must_use]
    pub fn none() -> Friction {
        let zero = || Formula::number(&Rational::ZERO);
        Friction {
            viscous: zero(),
            coulomb: zero(),
            spindle_diameter: zero(),
            coulomb_positive: zero(),
            coulomb_negative: zero(),
            offset: zero(),
            smoothing: None,
        }
    }
}

impl Drive {
    /// No inertia in the drive.
    #[must_use]
    pub fn none() -> Drive {
        let zero = || Formula::number(&Rational::ZERO);
        Drive {
            armature: zero(),
            rotor_inertia: zero(),
            gear_ratio: Formula::number(&Rational::ONE),
            gyroscopic: false,
        }
    }
}

/// A named frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The name; `tip` if the file gives none.
    pub name: String,
    /// The link that carries it; `None` for the base.
    pub link: Option<usize>,
    /// Its pose in that link's frame.
    pub placement: Placement,
    /// The wrench that the frame exerts on its surroundings, if it is a tip.
    pub wrench: Option<Wrench>,
}

/// The names of a wrench's components, in the axes of its frame, with the moment about its origin: the wrench that
/// the tip exerts on its surroundings, the paper's payload wrench (25).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrench {
    /// Force, N.
    pub force: [String; 3],
    /// Moment, N m.
    pub moment: [String; 3],
    /// The LaTeX of the components, force first, if the file has it.
    pub latex: [Option<String>; 6],
}

impl Robot {
    /// The number of generalized coordinates.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.coordinates.len()
    }

    /// The frames that exert a wrench, in the file's order.
    pub fn tips(&self) -> impl Iterator<Item = (&Frame, &Wrench)> {
        self.frames.iter().filter_map(|frame| Some((frame, frame.wrench.as_ref()?)))
    }

    /// Whether any joint has friction.
    #[must_use]
    pub fn has_friction(&self) -> bool {
        self.links.iter().any(|link| link.friction != Friction::none())
    }

    /// The parameter of that name.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// The nominal value of the parameter of that name; NaN if it has none, or does not exist.
    #[must_use]
    pub fn nominal_value(&self, name: &str) -> f64 {
        let value = self.parameter(name).and_then(|parameter| parameter.value.as_ref());
        value.map_or(f64::NAN, Rational::to_f64)
    }
}
