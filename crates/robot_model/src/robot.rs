//! The checked robot: the content of a robot file as plain data.
//!
//! Values are [`Formula`]s over the robot's parameters, exactly as the file gives them; nothing is evaluated, merged
//! or repaired here. Units are SI, with angles in radians.

use robot_symbolic::{Formula, Rational};

use crate::unit::Unit;

/// The number of inertial parameters of a link: mass, first moment and inertia tensor.
pub const LINK_PARAMETERS: usize = 10;

/// A robot with a fixed base: a tree of links, each moved by one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The robot's name, an identifier.
    pub name: String,
    /// The description in the file, such as the source of the values.
    pub description: Option<String>,
    /// The acceleration of gravity in the base frame, m/s². The vector points down.
    pub gravity: [Formula; 3],
    /// Constant angles within this tolerance of a multiple of π/2, rad, are taken as that multiple; `None` if the file
    /// does not specify it.
    pub snap: Option<f64>,
    /// The frames of the link parameters that the base parameters combine.
    pub base_frames: BaseFrames,
    /// The symbols that remain parameters of equations and code, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// The coordinates q₁ … qₙ.
    pub coordinates: Vec<Coordinate>,
    /// The moving links, parents before children.
    pub links: Vec<Link>,
    /// Named frames fixed to links or to the base: tips, flanges, merged links.
    pub frames: Vec<Frame>,
    /// The Denavit–Hartenberg parameters of the file, in the order of its links; empty if it places no link by them.
    /// The placements already contain them.
    pub dh: Vec<DhRow>,
    /// The body that the robot may carry, if the file has one. It is also one of the bodies of the link that carries
    /// it.
    pub payload: Option<Payload>,
}

/// The frames of the link parameters that base parameters combine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BaseFrames {
    /// The link's frame in the file; the parameters are the mass, the first moment, and the inertia tensor about the
    /// frame's origin, in its axes.
    #[default]
    File,
    /// Denavit–Hartenberg frames; the parameters are the mass and the first and second moments. The regressor needs
    /// fewer operations in these frames. Axis z is the joint axis; the origin is the point of the joint axis at which
    /// the common normal with the axis of the parent's joint meets it.
    DenavitHartenberg,
}

impl BaseFrames {
    /// Both choices.
    pub const ALL: [BaseFrames; 2] = [BaseFrames::File, BaseFrames::DenavitHartenberg];

    /// The name in robot files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            BaseFrames::File => "file",
            BaseFrames::DenavitHartenberg => "denavit_hartenberg",
        }
    }

    /// The choice with the given name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<BaseFrames> {
        BaseFrames::ALL.into_iter().find(|frames| frames.name() == name)
    }
}

/// The Denavit–Hartenberg parameters of a link, as the file gives them.
#[derive(Clone, Debug, PartialEq)]
pub struct DhRow {
    /// The name of the link; it may be a fixed link, which is merged into the one that carries it.
    pub link: String,
    /// The index of the link if it moves: its joint position is added to θ if the joint is revolute, to d if it is
    /// prismatic.
    pub moving: Option<usize>,
    /// The convention.
    pub convention: DhConvention,
    /// The distance a along x, m.
    pub a: Formula,
    /// The twist α about x, rad.
    pub alpha: Formula,
    /// The distance d along z at joint position 0, m.
    pub d: Formula,
    /// The angle θ about z at joint position 0, rad.
    pub theta: Formula,
}

/// The two conventions of Denavit–Hartenberg parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConvention {
    /// Joint i moves about or along z of frame i−1: Rz(θ) Tz(d) Tx(a) Rx(α).
    Standard,
    /// Joint i moves about or along z of frame i: Rx(α) Tx(a) Rz(θ) Tz(d), α and a of frame i−1.
    Modified,
}

impl DhConvention {
    /// Both conventions.
    pub const ALL: [DhConvention; 2] = [DhConvention::Standard, DhConvention::Modified];

    /// The name in robot files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            DhConvention::Standard => "standard",
            DhConvention::Modified => "modified",
        }
    }
}

/// The names of the parameters of a body that is set at run time. By default, all of them are 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Payload {
    /// The mass, kg.
    pub mass: String,
    /// The center of mass in the frame of the link or named frame that carries the payload, m.
    pub center_of_mass: [String; 3],
    /// The inertia tensor about the center of mass in the axes of that frame: xx, yy, zz, xy, xz, yz, kg m².
    pub inertia: [String; 6],
}

/// A symbol of the robot file.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name, an identifier: a symbol in equations and a field of `Parameters` in code.
    pub name: String,
    /// The exact nominal value, in [`Parameter::unit`].
    pub value: Option<Rational>,
    /// The unit; `None` if the file gives none.
    pub unit: Option<Unit>,
    /// The LaTeX of the symbol, from a small checked grammar.
    pub latex: Option<String>,
    /// The documentation in the file.
    pub doc: Option<String>,
}

/// A generalized coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// The name of the joint that it moves.
    pub joint: String,
    /// The kind of the joint: the coordinate is in radians for a revolute joint and in meters for a prismatic one.
    pub kind: JointKind,
    /// The lower and upper limits, if the file gives them. Nothing enforces them. They bound the states that `diff`
    /// draws, the motion and the sliders of reports, and the trajectories that `robot-query` draws; generated code
    /// contains them as constants if all coordinates have limits.
    pub limits: Option<[Rational; 2]>,
}

/// The kind of a joint: rotation about the joint axis or translation along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JointKind {
    /// A rotation: the paper's Δ = 1.
    Revolute,
    /// A translation: the paper's Δ = 0.
    Prismatic,
}

/// A moving link.
///
/// Its frame is the parent's frame (or the base frame) moved by `placement` and then by the joint. The origin of the
/// frame therefore lies on the joint axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The name in the file.
    pub name: String,
    /// The index of the parent link, which is always below the link's own index; `None` for the base.
    pub parent: Option<usize>,
    /// The link's frame at joint position 0, relative to the parent's frame.
    pub placement: Placement,
    /// The joint that moves the link.
    pub joint: Joint,
    /// The rigid bodies of the link: one, or several if fixed links were merged.
    pub bodies: Vec<Body>,
    /// Friction in the joint.
    pub friction: Friction,
    /// The inertia of the drive.
    pub drive: Drive,
}

/// The joint between a link and its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The name of the joint; that of the link if the file names no joint.
    pub name: String,
    /// Rotation or translation.
    pub kind: JointKind,
    /// The joint axis in the link's frame, a vector of any length except 0.
    pub axis: [Formula; 3],
    /// The coordinate that moves the joint: an index into [`Robot::coordinates`].
    pub coordinate: usize,
    /// The ratio in joint position = `ratio` · q + `offset`. It is 1 except for a joint that mimics another.
    pub ratio: Formula,
    /// The offset in the same equation. It is 0 except for a joint that mimics another.
    pub offset: Formula,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The name: that of the link, or of the fixed link that was merged into it.
    pub name: String,
    /// The mass, kg.
    pub mass: Formula,
    /// The frame of the body relative to the link's frame. Its origin is the center of mass.
    pub placement: Placement,
    /// The inertia tensor about the center of mass in the axes of `placement`, kg m².
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

/// A rigid displacement: a sequence of elementary moves, each relative to the frame that the preceding ones reach.
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
    /// The first axis.
    X,
    /// The second axis.
    Y,
    /// The third axis.
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
    /// The coefficient b of equation (4), N m s/rad or N s/m.
    pub viscous: Formula,
    /// The coefficient c of equation (5): dry friction divided by the contact force perpendicular to the axis.
    pub coulomb: Formula,
    /// The diameter d in equation (5): the journal diameter of a revolute joint, m (the paper's spindle diameter).
    pub spindle_diameter: Formula,
    /// The constant dry friction at positive velocities, N m or N.
    pub coulomb_positive: Formula,
    /// The constant dry friction at negative velocities, N m or N, as a positive value.
    pub coulomb_negative: Formula,
    /// A constant offset, N m or N.
    pub offset: Formula,
    /// The width v of the smooth sign tanh(q̇ / v), rad/s or m/s; `None` for the exact sign function.
    pub smoothing: Option<Formula>,
}

/// The inertia of a drive; all values are 0 if the file has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// The inertia already reflected to the joint, kg m² or kg.
    pub armature: Formula,
    /// The inertia of the rotor about its own axis, kg m².
    pub rotor_inertia: Formula,
    /// The rotor's turns per turn of a revolute joint, or its rad per m of a prismatic joint. The reflected inertia is the rotor's inertia times the
    /// square of this ratio.
    pub gear_ratio: Formula,
    /// Whether the gyroscopic moments of the spinning rotor are part of the model. In this case the rotor's axis is the
    /// joint axis, and the parent link carries the rotor.
    pub gyroscopic: bool,
}

impl Friction {
    /// Creates friction in which all values are 0.
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

    /// All its formulas.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let Friction {
            viscous,
            coulomb,
            spindle_diameter,
            coulomb_positive,
            coulomb_negative,
            offset,
            smoothing,
        } = self;
        let formulas =
            [viscous, coulomb, spindle_diameter, coulomb_positive, coulomb_negative, offset];
        formulas.into_iter().chain(smoothing)
    }
}

impl Drive {
    /// Creates a drive without inertia.
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
    /// The index of the link that carries the frame; `None` for the base.
    pub link: Option<usize>,
    /// The placement of the frame relative to that link's frame.
    pub placement: Placement,
    /// The wrench that the frame exerts on its surroundings, if it is a tip.
    pub wrench: Option<Wrench>,
}

/// The names of the components of the wrench that a tip exerts on its surroundings, in the axes of the tip's frame; the
/// moment is about the origin of this frame. This is the paper's wrench (25).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrench {
    /// The components of the force, N.
    pub force: [String; 3],
    /// The components of the moment, N m.
    pub moment: [String; 3],
    /// The LaTeX of the components, force first, if the file gives it.
    pub latex: [Option<String>; 6],
}

impl Robot {
    /// The number of coordinates.
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

    /// The parameter with the given name.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// The nominal value of the parameter with the given name; NaN if the parameter has none or does not exist.
    #[must_use]
    pub fn nominal_value(&self, name: &str) -> f64 {
        let value = self.parameter(name).and_then(|parameter| parameter.value.as_ref());
        value.map_or(f64::NAN, Rational::to_f64)
    }
}
