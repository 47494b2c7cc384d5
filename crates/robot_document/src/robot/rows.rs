//! The rows of tables about a robot: all outputs describe a link, a frame and a parameter in the same words. Each
//! output chooses its columns and their appearance, and writes formulas in its own notation.

use robot_model::robot::{
    DhConvention, DhRow, Frame, Joint, JointKind, Link, Parameter, Robot, Wrench,
};
use robot_model::variable::JointVariable;
use robot_symbolic::print::{exact_text, to_text};
use robot_symbolic::{Expr, Formula, Graph, Rational};

use super::words;
use crate::layout::tidied;
use crate::math::Math;

/// A link and the joint that moves it.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkRow<'r> {
    /// The link, with its name, axis, placement and bodies.
    pub link: &'r Link,
    /// The name of the parent link.
    pub parent: &'r str,
    /// The kind of the joint.
    pub kind: &'static str,
    /// The symbol of the coordinate, such as `q2`.
    pub coordinate: String,
    /// The limits of the coordinate, in rad or m; `None` for a joint that mimics another.
    pub limits: Option<&'r [Rational; 2]>,
}

/// A named frame.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRow<'r> {
    /// The frame, with its name and placement.
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
            limits: coordinate
                .filter(|_| !is_mimic(&link.joint))
                .and_then(|coordinate| coordinate.limits.as_ref()),
        }
    })
}

/// Whether the position of a joint is not simply its coordinate.
#[must_use]
pub fn is_mimic(joint: &Joint) -> bool {
    !joint.ratio.as_number().is_some_and(|ratio| ratio.is_one()) || !words::is_zero(&joint.offset)
}

/// The position of a joint in terms of its coordinate, as text: `q2`, or `-2*q1 + 0.3` if it mimics another.
#[must_use]
pub fn position_text(joint: &Joint) -> String {
    let graph = Graph::new();
    let lower = |formula: &Formula| formula.lower(&graph, &mut |name| graph.symbol(name));
    let coordinate = JointVariable::Position.symbol(joint.coordinate);
    let position = lower(&joint.ratio) * graph.symbol(&coordinate) + lower(&joint.offset);
    to_text(position).unwrap_or(coordinate)
}

/// The layout of a joint's position in terms of its coordinate plus a constant, with the coordinate first: −2 q₁ + 0.3.
/// `layout` makes the layouts of expressions.
///
/// # Errors
///
/// The errors of `layout`.
pub fn position<E>(
    joint: &Joint,
    constant: &Formula,
    layout: impl Fn(Expr<'_>) -> Result<Math, E>,
) -> Result<Math, E> {
    let graph = Graph::new();
    let layout = |value| layout(value).map(|math| tidied(&math, None));
    let lower = |formula: &Formula| formula.lower(&graph, &mut |name| graph.symbol(name));
    let coordinate = graph.symbol(&JointVariable::Position.symbol(joint.coordinate));
    let moving = layout(lower(&joint.ratio) * coordinate)?;
    let constant = lower(&joint.offset) + lower(constant);
    if constant.is_zero() {
        return Ok(moving);
    }
    let constant = layout(constant)?;
    let plus = (constant.pieces().first() != Some(&Math::Sign('-'))).then_some(Math::Sign('+'));
    let constant = plus.iter().chain(constant.pieces());
    Ok(Math::Row(moving.pieces().iter().chain(constant).cloned().collect()))
}

/// A Denavit–Hartenberg parameter of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DhParameter<'r> {
    /// The value at joint position 0.
    pub formula: &'r Formula,
    /// The joint whose position is added; `None` for a parameter that is constant.
    pub joint: Option<&'r Joint>,
}

impl DhParameter<'_> {
    /// The layout of the parameter, with the coordinate first: q₂ + π/2. `layout` makes the layouts of expressions.
    ///
    /// # Errors
    ///
    /// The errors of `layout`.
    pub fn shown<E>(&self, layout: impl Fn(Expr<'_>) -> Result<Math, E>) -> Result<Math, E> {
        match self.joint {
            Some(joint) => position(joint, self.formula, layout),
            None => {
                let graph = Graph::new();
                let value = self.formula.lower(&graph, &mut |name| graph.symbol(name));
                layout(value).map(|math| tidied(&math, None))
            }
        }
    }
}

/// The Denavit–Hartenberg rows of a convention in the order of the robot file, each with its a, α, d and θ.
pub fn dh(
    robot: &Robot,
    convention: DhConvention,
) -> impl Iterator<Item = (&DhRow, [DhParameter<'_>; 4])> {
    robot.dh.iter().filter(move |row| row.convention == convention).map(|row| {
        let joint = row.moving.and_then(|index| robot.links.get(index)).map(|link| &link.joint);
        let moved = |kind| joint.filter(|joint| joint.kind == kind);
        let parameters = [
            (&row.a, None),
            (&row.alpha, None),
            (&row.d, moved(JointKind::Prismatic)),
            (&row.theta, moved(JointKind::Revolute)),
        ];
        (row, parameters.map(|(formula, joint)| DhParameter { formula, joint }))
    })
}

/// The caption of a table of Denavit–Hartenberg parameters.
#[must_use]
pub fn dh_caption(convention: DhConvention) -> String {
    let name = convention.name();
    format!("Denavit-Hartenberg parameters, {name} convention; lengths in m, angles in rad.")
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
