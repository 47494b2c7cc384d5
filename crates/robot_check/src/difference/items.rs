//! Differences between the contents of two robots' files: parameters, links, joints and frames.

use robot_document::robot::rows::{self, FrameRow, LinkRow, ParameterRow};
use robot_document::robot::words;
use robot_model::diagnostic::number;
use robot_model::robot::{Body, Inertia, Joint, Link, Payload, Placement, Robot};
use robot_symbolic::{Formula, Graph, Rational, print};

/// The kind of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ItemKind {
    /// The robot as a whole.
    Robot,
    /// A parameter.
    Parameter,
    /// A link.
    Link,
    /// A joint.
    Joint,
    /// A named frame.
    Frame,
}

impl ItemKind {
    /// The word for the kind, such as `parameter` or `link`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            ItemKind::Robot => "robot",
            ItemKind::Parameter => "parameter",
            ItemKind::Link => "link",
            ItemKind::Joint => "joint",
            ItemKind::Frame => "frame",
        }
    }
}

/// A part of a robot with its properties.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// The kind of the item.
    pub kind: ItemKind,
    /// The name of the item.
    pub name: String,
    /// The properties: names, and values as text, which are exact if they are numbers.
    pub properties: Vec<(String, String)>,
}

/// A property that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// The name of the property, such as `mass` or `value`.
    pub name: String,
    /// The values in the two robots; `None` if the item does not have the property.
    pub values: [Option<String>; 2],
}

/// An item that was added, removed or changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// Only the second robot has the item.
    Added(Item),
    /// Only the first robot has the item.
    Removed(Item),
    /// Both robots have the item, with different properties.
    Changed {
        /// The kind of the item.
        kind: ItemKind,
        /// The name of the item.
        name: String,
        /// The properties that differ.
        properties: Vec<Property>,
    },
}

/// The changes: first those of the items of the first robot, in its order, then the added items.
pub(crate) fn changes(a: &Robot, b: &Robot) -> Vec<Change> {
    let (before, after) = (items(a), items(b));
    let counterpart = |item: &Item, among: &[Item]| {
        among.iter().find(|other| other.kind == item.kind && other.name == item.name).cloned()
    };
    let first = before.iter().filter_map(|item| match counterpart(item, &after) {
        None => Some(Change::Removed(item.clone())),
        Some(other) => changed(item, &other),
    });
    let came = after.iter().filter(|item| counterpart(item, &before).is_none());
    first.chain(came.cloned().map(Change::Added)).collect()
}

fn changed(a: &Item, b: &Item) -> Option<Change> {
    let of = |item: &Item, name: &str| {
        item.properties.iter().find(|(known, _)| known == name).map(|(_, value)| value.clone())
    };
    let added = b.properties.iter().filter(|(name, _)| of(a, name).is_none());
    let all = a
        .properties
        .iter()
        .chain(added)
        .map(|(name, _)| Property { name: name.clone(), values: [of(a, name), of(b, name)] });
    let properties: Vec<Property> = all.filter(|one| one.values[0] != one.values[1]).collect();
    let (kind, name) = (a.kind, a.name.clone());
    (!properties.is_empty()).then_some(Change::Changed { kind, name, properties })
}

fn items(robot: &Robot) -> Vec<Item> {
    // The name of the robot does not count as a difference.
    let whole = Item { kind: ItemKind::Robot, name: String::new(), properties: of_robot(robot) };
    let mut all = vec![whole];
    all.extend(rows::parameters(robot).map(parameter));
    all.extend(rows::links(robot).map(link));
    all.extend(rows::links(robot).map(joint));
    all.extend(rows::frames(robot).map(frame));
    all
}

fn named(name: &str, value: String) -> (String, String) {
    (name.to_owned(), value)
}

fn of_robot(robot: &Robot) -> Vec<(String, String)> {
    let mut properties = vec![named("gravity", vector(&robot.gravity))];
    let snap = robot.snap.map(|snap| named("snapping tolerance", format!("{snap:e} rad")));
    properties.extend(snap);
    properties.push(named("frames of base parameters", robot.base_frames.name().to_owned()));
    properties.extend(robot.payload.as_ref().map(|payload| {
        let Payload { mass, center_of_mass, inertia } = payload;
        let names = std::iter::once(mass).chain(center_of_mass).chain(inertia);
        named("payload", names.map(String::as_str).collect::<Vec<_>>().join(", "))
    }));
    properties
}

fn parameter(ParameterRow { parameter, value, unit, .. }: ParameterRow<'_>) -> Item {
    let value = value.map(|value| named("value", value));
    let unit = unit.map(|unit| named("unit", unit.to_owned()));
    let properties = value.into_iter().chain(unit).collect();
    Item { kind: ItemKind::Parameter, name: parameter.name.clone(), properties }
}

fn link(LinkRow { link, parent, .. }: LinkRow<'_>) -> Item {
    let mut properties =
        vec![named("parent", parent.to_owned()), named("pose", placement(&link.placement))];
    for body in &link.bodies {
        let prefix =
            if body.name == link.name { String::new() } else { format!("{}: ", body.name) };
        let of_body = body_properties(body).into_iter();
        properties.extend(of_body.map(|(name, value)| (format!("{prefix}{name}"), value)));
    }
    Item { kind: ItemKind::Link, name: link.name.clone(), properties }
}

fn body_properties(body: &Body) -> Vec<(String, String)> {
    let mut properties = vec![
        named("mass", formula(&body.mass)),
        named("center of mass", placement(&body.placement)),
    ];
    let entries = Inertia::NAMES.into_iter().zip(body.inertia.entries());
    properties.extend(entries.map(|(name, entry)| (format!("I{name}"), formula(entry))));
    properties
}

fn joint(LinkRow { link, kind, coordinate, limits, .. }: LinkRow<'_>) -> Item {
    let Link { joint, friction, drive, .. } = link;
    let Joint { axis, ratio, offset, .. } = joint;
    let mut properties = vec![
        named("moves", link.name.clone()),
        named("kind", kind.to_owned()),
        named("axis", vector(axis)),
        named("coordinate", coordinate),
        named("ratio", formula(ratio)),
        named("offset", formula(offset)),
        named("viscous friction", formula(&friction.viscous)),
        named("friction per contact force", formula(&friction.coulomb)),
        named("journal diameter", formula(&friction.spindle_diameter)),
        named("forward Coulomb friction", formula(&friction.coulomb_positive)),
        named("backward Coulomb friction", formula(&friction.coulomb_negative)),
        named("friction offset", formula(&friction.offset)),
        named("armature", formula(&drive.armature)),
        named("rotor inertia", formula(&drive.rotor_inertia)),
        named("gear ratio", formula(&drive.gear_ratio)),
        named("gyroscopic rotor", drive.gyroscopic.to_string()),
    ];
    properties.extend(friction.smoothing.as_ref().map(|width| named("smoothing", formula(width))));
    properties.extend(limits.map(|[low, high]| {
        named("limits", format!("{} to {}", print::exact_text(low), print::exact_text(high)))
    }));
    Item { kind: ItemKind::Joint, name: joint.name.clone(), properties }
}

fn frame(FrameRow { frame, link, wrench }: FrameRow<'_>) -> Item {
    let mut properties =
        vec![named("link", link.to_owned()), named("pose", placement(&frame.placement))];
    properties.extend(wrench.map(|names| named("wrench", names)));
    Item { kind: ItemKind::Frame, name: frame.name.clone(), properties }
}

/// A number as exact text, or a formula as its text in the file. Products with 0, as in inertias about another point,
/// are numbers, too.
fn formula(formula: &Formula) -> String {
    let graph = Graph::new();
    let value = formula.lower(&graph, &mut |name| graph.symbol(name)).as_number();
    let rational = value.as_ref().and_then(|value| value.as_rational());
    rational.map_or_else(|| formula.text().to_owned(), exact)
}

/// The longest text of a number that is not printed with a power of ten.
const MAX_DIGITS: usize = 24;

/// The exact text of a number, with a power of ten if it is long and this is exact too.
fn exact(value: &Rational) -> String {
    let text = print::exact_text(value);
    if text.len() <= MAX_DIGITS {
        return text;
    }
    let short = number(value.to_f64());
    if Rational::from_decimal(&short).as_ref() == Some(value) { short } else { text }
}

fn vector(entries: &[Formula; 3]) -> String {
    words::vector(entries, formula)
}

fn placement(placement: &Placement) -> String {
    words::pose(placement, formula)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_have_powers_of_ten_if_they_are_exact() {
        for (text, expected) in [
            ("0.1", "0.1"),
            ("1e30", "1e30"),
            ("-1.01e-100", "-1.01e-100"),
            ("100000000000000000000", "100000000000000000000"),
            ("1.00000000000000000000000001", "1.00000000000000000000000001"),
        ] {
            let value = Rational::from_decimal(text).unwrap();
            assert_eq!(exact(&value), expected, "{text}");
        }
    }
}
