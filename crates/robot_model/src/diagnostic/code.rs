//! The stable codes of diagnostics. Each has a page, `diagnostics/CODE.md` of this package.

macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident = $code:literal, $title:literal;)*) => {
        $($(#[$doc])* #[doc = $title] pub const $name: &str = $code;)*

        /// Every code with its title, in order.
        pub const TABLE: &[(&str, &str)] = &[$(($code, $title)),*];

        /// The page of a code, in Markdown: why it matters, an example, what to do.
        #[must_use]
        pub fn page(code: &str) -> Option<&'static str> {
            match code {
                $($code => Some(include_str!(
                    concat!(env!("CARGO_MANIFEST_DIR"), "/diagnostics/", $code, ".md")
                )),)*
                _ => None,
            }
        }
    };
}

codes! {
    TOO_LARGE = "R0001", "The file is larger than the limit.";
    NOT_TEXT = "R0002", "The file is not UTF-8 text.";
    SYNTAX = "R0003", "The text is not TOML, or not XML.";
    UNKNOWN_KEY = "R0101", "A key, element or attribute has no meaning where it stands.";
    MISSING_KEY = "R0102", "A key, element or attribute that is needed is missing.";
    WRONG_TYPE = "R0103", "A value has the wrong type.";
    UNKNOWN_WORD = "R0104", "A word is none of those allowed.";
    WRONG_COUNT = "R0105", "A list has the wrong number of entries.";
    CONFLICT = "R0106", "Keys exclude each other or have no effect together.";
    FORMAT = "R0107", "The file is of a format that is not known.";
    LIMIT = "R0108", "There are more entries than the limit.";
    XACRO = "R0109", "The file is a xacro template.";
    NAME = "R0201", "A name has characters that names have not.";
    RESERVED = "R0202", "A name means something of itself.";
    DUPLICATE = "R0203", "A name is given twice.";
    ALIKE = "R0204", "Two names differ in case or underscores alone.";
    LATEX = "R0205", "LaTeX of a symbol is outside the grammar for symbols.";
    TEXT = "R0206", "A text has control or invisible characters.";
    NUMBER = "R0301", "A value is not a finite number, or too large or small to compute with.";
    EXPRESSION = "R0302", "A text is not an expression.";
    UNKNOWN_SYMBOL = "R0303", "An expression has a name that is not a parameter.";
    UNIT = "R0304", "A unit is not known.";
    UNIT_NOT_SI = "R0305", "A unit is not an SI unit.";
    DIMENSION = "R0306", "Units do not fit.";
    UNIT_OF_NUMBER = "R0307", "The unit of an expression fits only if a number in it has one.";
    UNKNOWN_LINK = "R0401", "A parent is none of the links.";
    CYCLE = "R0402", "Links descend from themselves.";
    ZERO_AXIS = "R0403", "A joint axis has no direction.";
    LIMITS = "R0404", "Joint limits are in the wrong order.";
    MIMIC = "R0405", "A joint cannot follow the joint that it names.";
    NO_JOINT = "R0406", "Nothing moves.";
    TWO_PARENTS = "R0407", "A link is the child of several joints.";
    UNREACHABLE = "R0408", "A link hangs on nothing.";
    MASS = "R0501", "A moving link has no mass that a body can have.";
    INERTIA_SIGN = "R0502", "An inertia tensor has a negative principal moment.";
    INERTIA_TRIANGLE = "R0503", "Principal moments of inertia break the triangle inequality.";
    FRICTION = "R0504", "A figure of friction or drive has a sign that it cannot have.";
    UNUSED = "R0601", "A parameter is not used.";
    NO_EFFECT = "R0602", "A figure has no effect on the motion.";
    NOT_READ = "R0603", "An element or attribute that URDF does not have is not read.";
    AXIS_LENGTH = "R0604", "A joint axis is not of unit length.";
    UNITS = "R0605", "Figures look as if they were not in SI units.";
    CENTER_FAR = "R0606", "A centre of mass lies far outside of its link.";
    COPIED = "R0607", "Several links have the same inertia.";
    ABOUT_ORIGIN = "R0608", "An inertia looks as if it were about the origin of its frame.";
    TOO_WIDE = "R0609", "An inertia is that of a far larger body than the link.";
    POINT_MASS = "R0610", "A body that turns has mass and no moments of inertia.";
    MOVES_NOTHING = "R0611", "A joint moves nothing that has mass.";
    ANGLE_NEAR = "R0612", "An angle is nearly a multiple of π/2.";
    DEGREES = "R0613", "An angle looks as if it were in degrees.";
    AXIS_NEAR = "R0614", "A joint axis is nearly along an axis of its frame.";
    GRAVITY_UP = "R0615", "Gravity points up.";
    FREE_BASE = "R0617", "The base has mass, and several branches move on it.";
    LIMIT_SIGN = "R0618", "A limit of a joint has a sign that it cannot have.";
    TAKEN_AS_BASE = "R0701", "A link is taken for the base.";
    TAKEN_TOGETHER = "R0702", "A fixed link is part of the link that carries it.";
    TAKEN_COORDINATE = "R0703", "A joint shares or gives a coordinate in a way to know of.";
    TAKEN_DEFAULT = "R0704", "A figure that the file leaves out has the format's own value.";
    TAKEN_NAME = "R0705", "A name is changed.";
    LEFT_OUT = "R0706", "Something in the file is no part of the robot here.";
    TAKEN_ANGLE = "R0707", "An angle is taken for a multiple of π/2.";
    BUDGET = "R0801", "A function costs more than its budget.";
    LACKING = "R0802", "A function is asked for that the robot lacks.";
    PIN = "R0803", "The plan pinned beside the file is not for it.";
}
