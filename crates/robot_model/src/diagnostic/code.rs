//! The stable codes of diagnostics. Each code has a page, `diagnostics/CODE.md` in this package.
//!
//! The first two digits are the subject; a new code takes the next free number of its subject:
//!
//! - R00: the file as a whole, before anything in it is read;
//! - R01: keys, elements and entries: unknown, missing, of the wrong type or too many;
//! - R02: names, symbols and texts;
//! - R03: numbers, expressions, units and dimensions;
//! - R04: the tree of links and joints;
//! - R05: masses, inertias, friction and drives that no body can have;
//! - R06: likely mistakes, and content without effect;
//! - R07: choices of a reader: content that it interpreted, merged, renamed or left out;
//! - R08: requests for generated code: functions, budgets, pinned plans.
//!
//! R00 to R05 are errors, except R0307, errors that an option turns into warnings, and some masses and inertias in URDF
//! (`description/urdf/masses.rs`); R06 are warnings, except that a payload fixed to the base (R0602) is an error; R07
//! are notes; R08 are errors, except that a stale plan and values that are not finite are warnings.

macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident = $code:literal, $title:literal;)*) => {
        $($(#[$doc])* #[doc = $title] pub const $name: &str = $code;)*

        /// Every code with its title, in order.
        pub const TABLE: &[(&str, &str)] = &[$(($code, $title)),*];

        /// The page of a code in Markdown: why it matters, an example, and the remedy.
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
    SYNTAX = "R0003", "The file is not valid TOML or XML.";
    UNKNOWN_KEY = "R0101", "A key, element or attribute has no meaning in its place.";
    MISSING_KEY = "R0102", "A required key, element or attribute is missing.";
    WRONG_TYPE = "R0103", "A value has the wrong type.";
    UNKNOWN_WORD = "R0104", "A word is not one of those allowed.";
    WRONG_COUNT = "R0105", "A list has the wrong number of entries.";
    CONFLICT = "R0106", "Keys exclude each other or have no effect together.";
    FORMAT = "R0107", "The file format is unknown.";
    LIMIT = "R0108", "A limit on size or count is exceeded.";
    XACRO = "R0109", "The file is a xacro template.";
    NAME = "R0201", "A name contains characters that are not allowed.";
    RESERVED = "R0202", "A name is reserved.";
    DUPLICATE = "R0203", "A name is defined twice.";
    ALIKE = "R0204", "Two names differ only in case or underscores.";
    LATEX = "R0205", "The LaTeX for a symbol is not in the grammar for symbols.";
    TEXT = "R0206", "Text contains control or invisible characters.";
    NUMBER = "R0301", "A value is not finite, or is too large or too small to compute with.";
    EXPRESSION = "R0302", "An expression is not valid.";
    UNKNOWN_SYMBOL = "R0303", "An expression contains a name that is not a parameter.";
    UNIT = "R0304", "A unit is unknown.";
    UNIT_NOT_SI = "R0305", "A unit is not a coherent SI unit.";
    DIMENSION = "R0306", "Units do not match.";
    UNIT_OF_NUMBER = "R0307", "The units match only if a number in the expression has a unit.";
    UNKNOWN_LINK = "R0401", "A parent is not a link of the file.";
    CYCLE = "R0402", "A link is its own ancestor.";
    ZERO_AXIS = "R0403", "A joint axis has no direction.";
    LIMITS = "R0404", "Joint limits are in the wrong order.";
    MIMIC = "R0405", "A joint cannot mimic the joint that it names.";
    NO_JOINT = "R0406", "No joint moves.";
    TWO_PARENTS = "R0407", "A link is the child of several joints.";
    UNREACHABLE = "R0408", "A link has no parent.";
    MASS = "R0501", "A moving link has no mass, or an impossible one.";
    INERTIA_SIGN = "R0502", "An inertia tensor has a negative principal moment.";
    INERTIA_TRIANGLE = "R0503", "Principal moments of inertia violate the triangle inequality.";
    FRICTION = "R0504", "A friction or drive value has an impossible sign.";
    UNUSED = "R0601", "A parameter is not used.";
    NO_EFFECT = "R0602", "A value has no effect on the motion.";
    NOT_READ = "R0603", "An unknown URDF element or attribute is ignored.";
    AXIS_LENGTH = "R0604", "A joint axis does not have unit length.";
    UNITS = "R0605", "Values do not appear to be in SI units.";
    CENTER_FAR = "R0606", "A center of mass lies far outside its link.";
    COPIED = "R0607", "Several links have the same inertia.";
    ABOUT_ORIGIN = "R0608", "An inertia appears to be about the origin of its frame.";
    TOO_WIDE = "R0609", "An inertia fits a far larger body than the link.";
    POINT_MASS = "R0610", "A rotating body has mass but no moments of inertia.";
    MOVES_NOTHING = "R0611", "A joint moves no mass.";
    ANGLE_NEAR = "R0612", "An angle is nearly a multiple of π/2.";
    DEGREES = "R0613", "An angle appears to be in degrees.";
    AXIS_NEAR = "R0614", "A component of a joint axis is nearly zero.";
    GRAVITY_UP = "R0615", "Gravity points up.";
    FREE_BASE = "R0617", "The base has mass, and several branches move on it.";
    LIMIT_SIGN = "R0618", "A joint limit has an impossible sign.";
    PRINTED_ALIKE = "R0619", "Two symbols are printed alike.";
    TAKEN_AS_BASE = "R0701", "A link is used as the base.";
    TAKEN_TOGETHER = "R0702", "A fixed link is merged into its parent.";
    TAKEN_COORDINATE = "R0703", "The coordinate of a joint is stated.";
    TAKEN_DEFAULT = "R0704", "A value that is not in the file has the format's default.";
    TAKEN_NAME = "R0705", "A name is changed.";
    LEFT_OUT = "R0706", "Content of the file is not used.";
    TAKEN_ANGLE = "R0707", "An angle is snapped to a multiple of π/2.";
    BUDGET = "R0801", "A function exceeds its budget.";
    LACKING = "R0802", "A requested function is not available for the robot.";
    PIN = "R0803", "The pinned plan does not match the robot file.";
    INFINITE = "R0804", "A function has no finite value at the nominal values of the parameters.";
}

/// Codes that must not be used again: removed codes, whose meaning users and their scripts may remember, and skipped
/// ones. A code that is removed must be added here.
pub const RETIRED: &[&str] = &["R0616"];
