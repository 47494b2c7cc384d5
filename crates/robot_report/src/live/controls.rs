//! The sliders of the moving robot.

use robot_document::markup::{Element, Node, element, holding};
use robot_model::robot::{Coordinate, JointKind, Parameter, Robot};
use robot_model::variable::JointVariable;

use crate::text;

/// The largest position of joints without limits, in rad and m.
const POSITION: [f64; 2] = [std::f64::consts::PI, 0.5];
/// The largest velocity, in rad/s and m/s.
const VELOCITY: [f64; 2] = [3.0, 1.0];
/// The largest acceleration, in rad/s² and m/s².
const ACCELERATION: [f64; 2] = [10.0, 5.0];
/// The largest mass of the payload in kg, and the range of its center of mass around the nominal one in m.
const MASS: f64 = 5.0;
const CENTER: f64 = 0.3;

/// The lowest and the highest position of a coordinate.
pub(super) fn range(coordinate: &Coordinate) -> [f64; 2] {
    match &coordinate.limits {
        Some(limits) => limits.each_ref().map(robot_symbolic::Rational::to_f64),
        None => symmetric(coordinate.kind, POSITION),
    }
}

fn symmetric(kind: JointKind, [angle, length]: [f64; 2]) -> [f64; 2] {
    let size = if kind == JointKind::Revolute { angle } else { length };
    [-size, size]
}

fn slider([low, high]: [f64; 2], value: f64, name: &str) -> Element {
    element("input")
        .attribute("type", "range")
        .attribute("min", low.to_string())
        .attribute("max", high.to_string())
        .attribute("step", "any")
        .attribute("value", value.clamp(low, high.max(low)).to_string())
        .attribute("aria-label", name)
}

/// A slider with its value beside it.
fn with_output(slider: Element) -> [Node; 2] {
    [slider.into(), holding("output", "0").into()]
}

/// The sliders for positions, velocities and accelerations of all coordinates.
pub(super) fn states(robot: &Robot) -> Element {
    let variables = [
        (JointVariable::Position, JointVariable::Position.name(), "position"),
        (JointVariable::Velocity, "q̇", "velocity"),
        (JointVariable::Acceleration, "q̈", "acceleration"),
    ];
    let headings = variables
        .map(|(_, sign, word)| holding("th", format!("{sign}, {word}")).attribute("scope", "col"));
    let rows = robot.coordinates.iter().enumerate().map(|(index, coordinate)| {
        let symbol = text::symbol(&JointVariable::Position.symbol(index));
        let cells = variables.iter().map(|(variable, sign, word)| {
            let range = match variable {
                JointVariable::Position => range(coordinate),
                JointVariable::Velocity => symmetric(coordinate.kind, VELOCITY),
                _ => symmetric(coordinate.kind, ACCELERATION),
            };
            let unit = text::unit(variable.unit(coordinate.kind));
            let name = format!("{word} of joint {}, {unit}", coordinate.joint);
            let slider = slider(range, 0.0, &name).attribute("data-state", variable.name());
            element("td")
                .attribute("data-name", format!("{sign}, {unit}"))
                .with_all(with_output(slider))
                .with(holding("small", format!(" {unit}")))
        });
        let heading = holding("th", format!("{symbol}, {}", coordinate.joint));
        element("tr").with(heading.attribute("scope", "row")).with_all(cells)
    });
    let caption = "Positions within the limits in the file; half a turn or 0.5 m to either side if there are none.";
    let table = element("table")
        .class("sliders")
        .with(holding("caption", holding("span", caption)))
        .with(holding(
            "thead",
            element("tr")
                .with(holding("th", "Coordinate").attribute("scope", "col"))
                .with_all(headings),
        ))
        .with(element("tbody").with_all(rows));
    element("div").class("wide").with(table)
}

/// The sliders for the mass and center of mass of the payload, if the robot can carry one.
pub(super) fn payload(robot: &Robot) -> Option<Element> {
    let payload = robot.payload.as_ref()?;
    let place = |name: &str| {
        robot.parameters.iter().position(|parameter: &Parameter| parameter.name == name)
    };
    let one = |name: &str, label: &str, range: [f64; 2]| -> Option<Element> {
        let index = place(name)?;
        let slider = slider(range, robot.nominal_value(name), label)
            .attribute("data-parameter", index.to_string());
        let unit = label.rsplit(' ').next().unwrap_or_default();
        let words = label.split(',').next().unwrap_or_default();
        Some(
            element("label")
                .with(Node::from(format!("{words} ")))
                .with_all(with_output(slider))
                .with(Node::from(format!(" {unit}"))),
        )
    };
    let mass = robot.nominal_value(&payload.mass);
    let mut sliders = vec![one(&payload.mass, "mass, kg", [0.0, MASS.max(2.0 * mass)])];
    for (name, axis) in payload.center_of_mass.iter().zip(["x", "y", "z"]) {
        let nominal = robot.nominal_value(name);
        sliders.push(one(
            name,
            &format!("center of mass {axis}, m"),
            [nominal - CENTER, nominal + CENTER],
        ));
    }
    let legend = "Payload; its moments of inertia keep their values from the file";
    Some(
        element("fieldset").with(holding("legend", legend)).with_all(sliders.into_iter().flatten()),
    )
}
