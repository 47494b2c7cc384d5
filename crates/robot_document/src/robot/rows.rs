//! The rows of tables about a robot: all outputs describe a link, a frame and a parameter in the same words. Each
//! output chooses its columns and their appearance, and writes formulas in its own notation.

use robot_model::robot::{Frame, Link, Parameter, Robot, Wrench};
use robot_model::variable::JointVariable;
use robot_symbolic::Rational;
use robot_symbolic::print::exact_text;

use super::words;

/// A link and the joint that moves it.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkRow<'r> {
    /// The link, with its name, axis, pose and bodies.
    pub link: &'r Link,
    /// The name of the parent link.
    pub parent: &'r str,
    /// The kind of the joint.
    pub kind: &'static str,
    /// The symbol of the coordinate, such as `q2`.
    pub coordinate: String,
    /// The limits of the coordinate, in rad or m.
    pub limits: Option<&'r [Rational; 2]>,
}

/// A named frame.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRow<'r> {
    /// The frame, with its name and pose.
    pub frame: &'r Frame,
    /// The name of the link that it is fixed to.
    pub link: &'r str,
    /// The components of the wrench that the frame exerts on its surroundings, force first.
    pub wrench: Option<String>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRow<'r> {
    /// The parameter, with its name.
    pub parameter: &'r Parameter,
    /// The nominal value, as exact text.
    pub value: Option<String>,
    /// The unit.
    pub unit: Option<&'r str>,
    /// The meaning, in the words of the robot file.
    pub meaning: Option<&'r str>,
}

/// The rows of the links, in the order of the robot file.
pub fn links(robot: &Robot) -> impl Iterator<Item = LinkRow<'_>> {
    robot.links.iter().map(|link| {
        let coordinate = robot.coordinates.get(link.joint.coordinate);
        LinkRow {
            link,
            parent: words::carrier(robot, link.parent),
            kind: words::motion(link.joint.kind),
            coordinate: JointVariable::Position.symbol(link.joint.coordinate),
            limits: coordinate.and_then(|coordinate| coordinate.limits.as_ref()),
        }
    })
}

/// The rows of the named frames, in the order of the robot file.
pub fn frames(robot: &Robot) -> impl Iterator<Item = FrameRow<'_>> {
    let components = |wrench: &Wrench| wrench.components().collect::<Vec<_>>().join(", ");
    robot.frames.iter().map(move |frame| FrameRow {
        frame,
        link: words::carrier(robot, frame.link),
        wrench: frame.wrench.as_ref().map(components),
    })
}

/// The rows of the parameters, in the order of the robot file.
pub fn parameters(robot: &Robot) -> impl Iterator<Item = ParameterRow<'_>> {
    robot.parameters.iter().map(|parameter| ParameterRow {
        parameter,
        value: parameter.value.as_ref().map(exact_text),
        unit: parameter.unit.as_ref().map(|unit| unit.text.as_str()),
        meaning: parameter.doc.as_deref(),
    })
}
