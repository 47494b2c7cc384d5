//! The tables of a robot file, with the only list of their keys.
//!
//! The reader can only look up keys of these shapes, and the JSON schema of the format is generated from them.

use crate::functions::ALL_FUNCTIONS;
use crate::robot::BaseFrames;

/// A table of the file.
#[derive(Debug)]
pub struct Shape {
    /// The name of the table in messages, such as `a joint`.
    pub what: &'static str,
    /// The purpose of the table.
    pub doc: &'static str,
    /// The keys of the table.
    pub keys: &'static [Key],
}

/// A key of a table.
#[derive(Debug)]
pub struct Key {
    /// The name of the key.
    pub name: &'static str,
    /// The kind of value that the key takes.
    pub content: Content,
    /// Whether it is required.
    pub presence: Presence,
    /// The purpose of the key.
    pub doc: &'static str,
}

/// Whether a key is required.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// The key is required in every table.
    Needed,
    /// Whether the key is required depends on other keys.
    Depends,
    /// The key is optional.
    Optional,
}

/// The kind of value that a key takes.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// The version number of the format.
    Format,
    /// A number, or an expression over the parameters.
    Formula,
    /// Three formulas.
    Vector,
    /// A word for an axis, or three formulas.
    Axis,
    /// A number.
    Number,
    /// The lower and the upper limit, two numbers.
    Limits,
    /// A non-negative whole number.
    Whole,
    /// The name of a function of generated code, or of a bundle in the file.
    Function,
    /// A list of functions, with a word for all of them if there is one.
    Functions(Option<&'static str>),
    /// A table whose keys are identifiers and whose values are lists of functions.
    Bundles,
    /// `true` or `false`.
    Boolean,
    /// One of these words.
    Word(&'static [&'static str]),
    /// A text for human readers.
    Text,
    /// A unit: a product of powers of SI units.
    Unit,
    /// The LaTeX of a symbol.
    Latex,
    /// An identifier, which may become a variable in code.
    Identifier,
    /// The name of a link, joint or frame.
    Label,
    /// The name of a link, or `base`.
    Parent,
    /// The names of the three components of a force or moment.
    Components(&'static Shape),
    /// A table.
    Table(&'static Shape),
    /// A list of tables.
    List(&'static Shape),
    /// A table, or a list of them.
    OneOrMany(&'static Shape),
    /// A table whose keys are identifiers and whose values are numbers or tables of this shape.
    Parameters(&'static Shape),
}

impl Content {
    /// The shape of the tables that the key takes.
    fn shape(self) -> Option<&'static Shape> {
        match self {
            Components(shape) | Table(shape) | List(shape) | OneOrMany(shape)
            | Parameters(shape) => Some(shape),
            _ => None,
        }
    }
}

use Content::{
    Axis, Boolean, Bundles, Components, Format, Formula, Function, Functions, Identifier, Label,
    Latex, Limits, List, Number, OneOrMany, Parameters, Parent, Table, Text, Unit, Vector, Whole,
    Word,
};

/// The types of joints.
pub const JOINT_TYPES: &[&str] = &["revolute", "prismatic", "fixed"];
/// The words for joint axes.
pub const AXES: &[&str] = &["x", "y", "z", "-x", "-y", "-z"];
/// The conventions of Denavit–Hartenberg rows.
pub const CONVENTIONS: &[&str] = &["standard", "modified"];
/// The points about which a tensor can be given.
pub const POINTS: &[&str] = &["center_of_mass", "origin"];

/// The frames of base parameters.
pub const BASE_FRAMES: &[&str] = &[BaseFrames::File.name(), BaseFrames::DenavitHartenberg.name()];

/// The syntax of identifiers, which may become variables in code, as a regular expression.
pub const IDENTIFIER: &str = "^[A-Za-z_][A-Za-z0-9_]{0,63}$";
/// The syntax of the names of links, joints and frames, as a regular expression.
pub const LABEL: &str = "^[A-Za-z0-9_][A-Za-z0-9_.-]{0,63}$";

const fn needed(name: &'static str, content: Content, doc: &'static str) -> Key {
    Key { name, content, presence: Presence::Needed, doc }
}

const fn depends(name: &'static str, content: Content, doc: &'static str) -> Key {
    Key { name, content, presence: Presence::Depends, doc }
}

const fn key(name: &'static str, content: Content, doc: &'static str) -> Key {
    Key { name, content, presence: Presence::Optional, doc }
}

/// The whole file.
pub static ROBOT_FILE: Shape = Shape {
    what: "a robot file",
    doc: "A robot with a fixed base. Units are SI, with angles in radians.",
    keys: &[
        needed("format", Format, "The file format: 1."),
        key(
            "parameters",
            Parameters(&PARAMETER),
            "Symbols in the equations, fields of `Parameters` in code.",
        ),
        needed("robot", Table(&ROBOT), "The robot as a whole."),
        key("dh", Table(&DH_TABLE), "Denavit-Hartenberg rows for the whole arm."),
        needed("link", List(&LINK), "The links, each with the joint that moves it."),
        key("tip", OneOrMany(&TIP), "Frames that exert a wrench on their surroundings."),
        key("frame", OneOrMany(&FRAME), "Named frames."),
        key("payload", Table(&PAYLOAD), "A body that the robot may carry, set at run time."),
        key("code", Table(&CODE), "Which functions to generate if the caller names none."),
        key(
            "budget",
            OneOrMany(&BUDGET),
            "Limits on the operations and the stack of generated code.",
        ),
    ],
};

/// `[robot]`.
pub static ROBOT: Shape = Shape {
    what: "[robot]",
    doc: "The robot as a whole.",
    keys: &[
        needed("name", Identifier, "An identifier."),
        key("description", Text, "Source of the values, remarks."),
        key(
            "gravity",
            Vector,
            "Acceleration of gravity in the base frame, m/s^2; it points down. Default: [0, 0, \
             -9.81].",
        ),
        key(
            "snap",
            Number,
            "Constant angles within this many radians of a multiple of pi/2 are snapped to it. \
             Default: 1e-9.",
        ),
        key(
            "base_frames",
            Word(BASE_FRAMES),
            "Which link parameters the base parameters combine: first moments and inertia \
             tensors in the file's frames (the default), or first and second moments in \
             Denavit-Hartenberg frames.",
        ),
    ],
};

/// A parameter with properties besides its value.
pub static PARAMETER: Shape = Shape {
    what: "a parameter",
    doc: "A symbol that remains a parameter in equations and code.",
    keys: &[
        key("value", Number, "The nominal value."),
        key(
            "unit",
            Unit,
            "Products of powers of 1 rad kg m s Hz N Pa J W, such as \"kg m^2\" or \"N s/m\".",
        ),
        key("latex", Latex, "How the symbol is printed in LaTeX."),
        key("doc", Text, "What the parameter means."),
    ],
};

/// `[dh]`.
pub static DH_TABLE: Shape = Shape {
    what: "a DH table",
    doc: "One row for each link without `origin` and `dh`.",
    keys: &[
        needed("convention", Word(CONVENTIONS), CONVENTION_DOC),
        needed("rows", List(&DH_TABLE_ROW), "The rows, in the order of the links."),
    ],
};

const CONVENTION_DOC: &str = "\"standard\" is Rz(theta) Tz(d) Tx(a) Rx(alpha), \"modified\" is Rx(alpha) Tx(a) Rz(theta) Tz(d).";
const A: Key = key("a", Formula, "Length along x, m.");
const ALPHA: Key = key("alpha", Formula, "Angle about x, rad.");
const D: Key = key("d", Formula, "Length along z, m; a prismatic joint adds to it.");
const THETA: Key = key("theta", Formula, "Angle about z, rad; a revolute joint adds to it.");

/// A row of `[dh]`.
pub static DH_TABLE_ROW: Shape = Shape {
    what: "a DH row",
    doc: "A joint; values that are left out are 0.",
    keys: &[key("type", Word(JOINT_TYPES), "Default: revolute."), A, ALPHA, D, THETA],
};

/// `dh` of a link.
pub static DH_ROW: Shape = Shape {
    what: "a DH row",
    doc: "The frame of a link; values that are left out are 0.",
    keys: &[needed("convention", Word(CONVENTIONS), CONVENTION_DOC), A, ALPHA, D, THETA],
};

/// `[[link]]`.
pub static LINK: Shape = Shape {
    what: "a link",
    doc: "A link and the joint that moves it.",
    keys: &[
        needed("name", Label, "Letters, digits, `_`, `-`, `.`; not `base`."),
        key("parent", Parent, "Default: the previous link, or the base for the first link."),
        depends("joint", Table(&JOINT), "The joint between the link and its parent."),
        key("origin", Table(&ORIGIN), "The link frame at joint position 0, in the parent's frame."),
        key("dh", Table(&DH_ROW), "A Denavit-Hartenberg row in place of `origin`."),
        key("massless", Boolean, "Allows a moving link to be massless."),
        key("mass", Formula, "Positive, kg."),
        depends("center_of_mass", Vector, "In the link frame, m."),
        depends("inertia", Table(&INERTIA), "The inertia tensor."),
        key("friction", Table(&FRICTION), "Friction in the joint."),
        key("drive", Table(&DRIVE), "Inertia of the drive."),
    ],
};

/// `joint`.
pub static JOINT: Shape = Shape {
    what: "a joint",
    doc: "The joint between a link and its parent.",
    keys: &[
        depends("type", Word(JOINT_TYPES), "The type of motion; in a DH table, that of the row."),
        key("name", Label, "Default: the name of the link."),
        depends("axis", Axis, "Its direction in the link frame, of any nonzero length."),
        key(
            "limits",
            Limits,
            "Lower and upper, rad or m; nothing enforces them. They bound random states and the motions on pages.",
        ),
        key("mimic", Table(&MIMIC), "The joint mimics another."),
    ],
};

/// `mimic`.
pub static MIMIC: Shape = Shape {
    what: "a `mimic` table",
    doc: "Position = ratio * position of the leading joint + offset.",
    keys: &[
        needed("joint", Label, "The leading joint."),
        key("ratio", Formula, "Default: 1."),
        key("offset", Formula, "Default: 0; rad or m."),
    ],
};

/// `origin`.
pub static ORIGIN: Shape = Shape {
    what: "an origin",
    doc: "A frame relative to another.",
    keys: &[
        key("xyz", Vector, "Its origin, m."),
        key(
            "rpy",
            Vector,
            "Its axes: roll, pitch, yaw about fixed axes, R = Rz(yaw) Ry(pitch) Rx(roll), rad.",
        ),
    ],
};

/// `inertia`.
pub static INERTIA: Shape = Shape {
    what: "an inertia",
    doc: "Entries of the tensor, kg m^2; products are entries of the tensor, xy = -int xy dm.",
    keys: &[
        key("unchecked", Boolean, "Accepts a physically impossible tensor."),
        depends("xx", Formula, "Moment of inertia about x."),
        depends("yy", Formula, "Moment of inertia about y."),
        depends("zz", Formula, "Moment of inertia about z."),
        key("xy", Formula, "Entry (1, 2)."),
        key("xz", Formula, "Entry (1, 3)."),
        key("yz", Formula, "Entry (2, 3)."),
        key("rpy", Vector, "Orientation of the tensor's axes relative to the link's, rad."),
        key(
            "about",
            Word(POINTS),
            "The reference point of the tensor. Default: the center of mass.",
        ),
    ],
};

/// `friction`.
pub static FRICTION: Shape = Shape {
    what: "a `friction` table",
    doc: "Friction in a joint.",
    keys: &[
        key("viscous", Formula, "Viscous friction b, N m s/rad or N s/m."),
        key(
            "coulomb",
            Formula,
            "Coulomb friction coefficient c: friction force per contact force \
            perpendicular to the axis.",
        ),
        key("spindle_diameter", Formula, "Journal diameter of a revolute joint with `coulomb`, m."),
        key(
            "coulomb_positive",
            Formula,
            "Constant Coulomb friction for positive velocities, N m \
            or N.",
        ),
        key("coulomb_negative", Formula, "The same for negative velocities, as a positive value."),
        key("coulomb_torque", Formula, "Constant Coulomb friction of a revolute joint, N m."),
        key("coulomb_force", Formula, "Constant Coulomb friction of a prismatic joint, N."),
        key("offset", Formula, "Constant friction offset, N m or N."),
        key(
            "smoothing",
            Formula,
            "Smoothing width v: sign(qd) becomes tanh(qd / v); rad/s or m/s.",
        ),
    ],
};

/// `drive`.
pub static DRIVE: Shape = Shape {
    what: "a drive",
    doc: "Inertia of a drive.",
    keys: &[
        key("armature", Formula, "Armature: inertia already reflected to the joint, kg m^2 or kg."),
        key("rotor_inertia", Formula, "Of the rotor about its own axis, kg m^2."),
        key(
            "gear_ratio",
            Formula,
            "N, the rotor's turns per turn of a revolute joint, or its rad per m of a prismatic joint; the reflected inertia is N^2 times the rotor inertia.",
        ),
        key("gyroscopic", Boolean, "Includes the gyroscopic moments of the rotor."),
    ],
};

/// `[tip]`, `[[tip]]`.
pub static TIP: Shape = Shape {
    what: "a tip",
    doc: "A named frame that exerts a wrench on its surroundings.",
    keys: &[
        depends("name", Label, "Optional for a single tip."),
        key("parent", Parent, "Default: the last link."),
        key("origin", Table(&ORIGIN), "The frame relative to its parent."),
        key("wrench", Table(&WRENCH), "Names of the components."),
    ],
};

/// `[[frame]]`.
pub static FRAME: Shape = Shape {
    what: "a frame",
    doc: "A named frame.",
    keys: &[
        needed("name", Label, "Its name."),
        needed("parent", Parent, "The link that carries it."),
        key("origin", Table(&ORIGIN), "The frame relative to its parent."),
    ],
};

/// `[payload]`.
pub static PAYLOAD: Shape = Shape {
    what: "[payload]",
    doc: "A body that the robot may carry, with values set at run time.",
    keys: &[key("parent", Parent, "A link, tip or frame. Default: the last link.")],
};

/// `[code]`.
pub static CODE: Shape = Shape {
    what: "[code]",
    doc: "Which functions to generate if the caller names none.",
    keys: &[
        key(
            "functions",
            Functions(Some(ALL_FUNCTIONS)),
            "Functions, each by itself; \"all\" for every function of the robot.",
        ),
        key(
            "bundles",
            Bundles,
            "Functions computed in one call that shares their work, by the \
            name of the call.",
        ),
    ],
};

/// `[[budget]]`.
pub static BUDGET: Shape = Shape {
    what: "a budget",
    doc: "Limits on generated code; if a function exceeds them, the build fails.",
    keys: &[
        key("function", Function, "Default: every generated function."),
        key("max_operations", Whole, "Multiplications, additions and divisions per call."),
        key("max_stack", Whole, "Bytes of stack per call."),
    ],
};

/// `wrench`.
pub static WRENCH: Shape = Shape {
    what: "a wrench",
    doc: "Names of the components, in the tip's axes; the moment is about the tip's origin.",
    keys: &[
        needed("force", Components(&COMPONENT), "Force, N."),
        needed("moment", Components(&COMPONENT), "Moment, N m."),
    ],
};

/// A component of a wrench with its LaTeX.
pub static COMPONENT: Shape = Shape {
    what: "a component of a wrench",
    doc: "A component of a wrench.",
    keys: &[
        needed("name", Identifier, "Its name."),
        key(
            "latex",
            Latex,
            "How the component is \
        printed in LaTeX.",
        ),
    ],
};

impl Shape {
    /// The key with the given name.
    #[must_use]
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// What the other tables of a robot file are called that have a key of this name, in the order of the file.
    pub(super) fn owners(&self, name: &str) -> Vec<&'static str> {
        let mut shapes: Vec<&Shape> = vec![&ROBOT_FILE];
        let mut next = 0;
        while let Some(shape) = shapes.get(next).copied() {
            let inner = shape.keys.iter().filter_map(|key| key.content.shape());
            let new: Vec<&Shape> = inner
                .filter(|one| !shapes.iter().any(|known| std::ptr::eq(*known, *one)))
                .collect();
            shapes.extend(new);
            next += 1;
        }
        let mut owners: Vec<&str> = vec![];
        for one in shapes.into_iter().filter(|one| one.key(name).is_some()) {
            if one.what != self.what && !owners.contains(&one.what) {
                owners.push(one.what);
            }
        }
        owners
    }
}
