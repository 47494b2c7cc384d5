//! The contents of the robot file as tables: joints, frames, masses, drives and parameters.

use robot_document::markup::{Element, Node, element, holding};
use robot_document::robot::drives::drives as drives_of;
use robot_document::robot::rows::{self, FrameRow, LinkRow, ParameterRow};
use robot_document::robot::words;
use robot_model::robot::{Body, DhConvention, Inertia, Robot};
use robot_symbolic::{Formula, Rational};

use crate::formula::Symbols;
use crate::page::side_by_side;
use crate::parts;
use crate::table::Table;
use crate::text;

/// The table of links and joints: their poses at q = 0 and their motions.
pub(crate) fn kinematics(robot: &Robot) -> Element {
    let columns = ["Link", "Parent", "Joint", "Type", "Axis", "Pose at q = 0", "Limits"];
    let caption = "Links and joints. A pose is a sequence of displacements in the parent frame, \
        each in the frame reached by the preceding ones; lengths in m, angles in rad.";
    let mut table = Table::stacked(caption, columns);
    for (index, row) in rows::links(robot).enumerate() {
        let LinkRow { link, parent, kind, limits, .. } = &row;
        let limits = limits.map(|limits| limits.each_ref().map(Rational::to_f64));
        let cells: [Node; 6] = [
            (*parent).into(),
            link.joint.name.as_str().into(),
            format!("{kind}, {}", position(robot, &row)).into(),
            vector(&link.joint.axis).into(),
            text::pose(robot, &link.placement).into(),
            limits
                .map_or_else(String::new, |[low, high]| {
                    format!("{} …\u{a0}{}", text::number(low), text::number(high))
                })
                .into(),
        ];
        table.row(&parts::link(index), link.name.as_str(), cells);
    }
    table.build()
}

/// The least width of the columns of the table of links and joints that have no names, in pixels.
const OTHERS: f64 = 376.0;
/// The width of a character of a name, in pixels.
const CHARACTER: f64 = 8.0;

/// Whether the table of links and joints fits beside a scheme of this width in pixels.
pub(crate) fn fits_beside(robot: &Robot, width: f64) -> bool {
    let longest = |name: fn(&LinkRow<'_>) -> usize| {
        rows::links(robot).map(|row| name(&row)).max().unwrap_or(0)
    };
    let names = longest(|row| row.link.name.chars().count())
        + longest(|row| row.parent.chars().count())
        + longest(|row| row.link.joint.name.chars().count());
    width + OTHERS + CHARACTER * names as f64 <= side_by_side()
}

/// The tables of Denavit–Hartenberg parameters, one for each convention that the robot file uses.
pub(crate) fn dh<'r>(
    robot: &'r Robot,
    symbols: &'r Symbols,
) -> impl Iterator<Item = Element> + use<'r> {
    let tables = DhConvention::ALL.map(|convention| {
        let indices = match convention {
            DhConvention::Standard => ["aᵢ", "αᵢ", "dᵢ", "θᵢ"],
            DhConvention::Modified => ["aᵢ₋₁", "αᵢ₋₁", "dᵢ", "θᵢ"],
        };
        let caption = format!("{} {}", rows::dh_caption(convention), displacements(convention));
        let mut table = Table::new(&caption, ["Link"].into_iter().chain(indices));
        let rows: Vec<_> = rows::dh(robot, convention).collect();
        for (row, parameters) in &rows {
            let cells = parameters.iter().map(|parameter| match parameter.joint {
                Some(_) => symbols.parameter(parameter),
                None => value_cell(robot, symbols, parameter.formula),
            });
            let part = row.moving.map_or_else(String::new, parts::link);
            table.row(&part, row.link.as_str(), cells);
        }
        (!rows.is_empty()).then(|| table.build())
    });
    tables.into_iter().flatten()
}

/// The displacements of a Denavit–Hartenberg row in a sentence.
const fn displacements(convention: DhConvention) -> &'static str {
    match convention {
        DhConvention::Standard => {
            "The Denavit-Hartenberg frame i of a link is reached from that of its parent link, written i − 1, by rotating \
             about z by θ, translating along z by d, translating along x by a and rotating about x by α; joint i moves about or \
             along z of frame i − 1."
        }
        DhConvention::Modified => {
            "The frame i of a link is reached from that of its parent link, written i − 1, by rotating about x by α, \
             translating along x by a, rotating about z by θ and translating along z by d; joint i moves about or along z of frame \
             i."
        }
    }
}

/// The table of named frames; `None` if there are none.
pub(crate) fn frames(robot: &Robot) -> Option<Element> {
    let caption = match robot.tips().next() {
        Some(_) => {
            "Frames. A tip exerts the wrench with these components on its surroundings; the external wrench, which \
             acts on the tip, is its negative."
        }
        None => "Frames.",
    };
    let mut table = Table::stacked(caption, ["Frame", "Fixed to", "Pose", "Wrench"]);
    for FrameRow { frame, link, wrench } in rows::frames(robot) {
        let pose = text::pose(robot, &frame.placement);
        let cells = [link.to_owned(), pose, wrench.unwrap_or_default()];
        let part = frame.link.map_or_else(String::new, parts::link);
        table.row(&part, frame.name.as_str(), cells);
    }
    (!robot.frames.is_empty()).then(|| table.build())
}

/// The table of masses and moments of inertia, as in Table 1 of the paper.
pub(crate) fn masses(robot: &Robot, symbols: &Symbols) -> Element {
    let bodies = || robot.links.iter().flat_map(|link| &link.bodies);
    let occurs = |entry: &usize| {
        bodies()
            .any(|body| body.inertia.entries().get(*entry).is_some_and(|one| !words::is_zero(one)))
    };
    let (shown, omitted): (Vec<usize>, Vec<usize>) = (0..Inertia::NAMES.len()).partition(occurs);
    let names =
        |entries: &[usize]| entries.iter().map(|entry| Inertia::NAMES[*entry]).collect::<Vec<_>>();
    let columns = ["Body", "Mass, kg", "Center of mass and axes, m, rad"];
    let columns = columns.into_iter().chain(names(&shown));
    let products = match shown.iter().any(|entry| *entry > 2) {
        true => "; products of inertia are entries of the tensor, xy = −∫xy dm",
        false => "",
    };
    let caption = format!(
        "Masses and moments of inertia, kg·m². The moments are about the center of mass, in the axes given{products}.{}",
        words::zeros(&[], &names(&omitted))
    );
    let mut table = Table::stacked(&caption, columns);
    for (index, link) in robot.links.iter().enumerate() {
        for Body { name, mass, placement, inertia } in &link.bodies {
            let place = match text::pose(robot, placement) {
                none if none == "none" => "at the link frame's origin".to_owned(),
                pose => pose,
            };
            let cells =
                [value_cell(robot, symbols, mass), holding("span", place)].into_iter().chain(
                    shown.iter().map(|entry| value_cell(robot, symbols, inertia.entries()[*entry])),
                );
            table.row(&parts::link(index), name.as_str(), cells);
        }
    }
    table.build()
}

/// The table of drives; `None` if no joint has a drive with inertia.
pub(crate) fn drives(robot: &Robot, symbols: &Symbols) -> Option<Element> {
    let drives = drives_of(robot)?;
    let mut table = Table::stacked(&drives.caption, ["Link"].into_iter().chain(drives.columns));
    for (index, values) in drives.rows {
        let name = robot.links.get(index).map_or("", |link| link.name.as_str());
        table.row(
            &parts::link(index),
            name,
            values.iter().map(|value| value_cell(robot, symbols, value)),
        );
    }
    Some(table.build())
}

/// The table of parameters with their values and units; `None` if there are none.
pub(crate) fn parameters(robot: &Robot, symbols: &Symbols) -> Option<Element> {
    let caption = "Parameters: symbols in the equations, fields of the generated code.";
    let mut table =
        Table::stacked(caption, ["Name", "Symbol", "Value", "Unit", "Meaning", "Used by"]);
    for ParameterRow { parameter, value, unit, meaning } in rows::parameters(robot) {
        let name = &parameter.name;
        let links = parts::links_of_parameter(robot, name).into_iter();
        let links = links.filter_map(|index| robot.links.get(index));
        let words = [
            value.unwrap_or_else(|| "none".to_owned()).replace('-', "−"),
            text::unit(unit.unwrap_or_default()),
            meaning.unwrap_or_default().to_owned(),
            links.map(|link| link.name.as_str()).collect::<Vec<_>>().join(", "),
        ];
        let cells = std::iter::once(Node::from(symbols.symbol(name)));
        let cells = cells.chain(words.into_iter().map(Node::from));
        table.row(&parts::parameter(name), holding("code", name.as_str()), cells);
    }
    (!robot.parameters.is_empty()).then(|| table.build())
}

/// A formula that is marked with its parameters; if it has any, its nominal value is shown below it.
fn value_cell(robot: &Robot, symbols: &Symbols, formula: &Formula) -> Element {
    let shown = element("span").class("figure");
    if formula.is_constant() {
        return shown.with(text::plain(formula));
    }
    let mut names: Vec<String> = vec![];
    for (name, _) in formula.symbols() {
        let token = parts::parameter(name);
        if !names.contains(&token) {
            names.push(token);
        }
    }
    let shown = shown.attribute("data-of", names.join(" ")).with(symbols.formula(formula));
    let value = text::value(robot, formula);
    if value.is_finite() { shown.with(holding("small", text::number(value))) } else { shown }
}

/// The joint position in terms of the coordinate: `q2` or `(−0.5) q2 + (0.1)`.
fn position(robot: &Robot, row: &LinkRow<'_>) -> String {
    let joint = &row.link.joint;
    let coordinate = text::symbol(&row.coordinate);
    if !rows::is_mimic(joint) {
        return coordinate;
    }
    let turned = format!("({}) {coordinate}", text::with_value(robot, &joint.ratio));
    match words::is_zero(&joint.offset) {
        true => turned,
        false => format!("{turned} + ({})", text::with_value(robot, &joint.offset)),
    }
}

fn vector(components: &[Formula; 3]) -> String {
    let known = [("x", ["1", "0", "0"]), ("y", ["0", "1", "0"]), ("z", ["0", "0", "1"])];
    let texts = components.each_ref().map(Formula::text);
    match known.iter().find(|(_, unit)| *unit == texts) {
        Some((name, _)) => (*name).to_owned(),
        None => words::vector(components, text::plain),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(frame: &str, inertia: &str) -> Robot {
        let text = format!(
            "format = 1\n[robot]\nname = \"arm\"\n[parameters]\na1 = {{ value = 0.4, unit = \"m\" }}\n\
             [[link]]\nname = \"boom\"\nmass = 1\ncenter_of_mass = [0, 0, 0]\ninertia = {{ {inertia} }}\n{frame}\n"
        );
        robot_model::description::read_toml("arm.toml", &text).unwrap().robot
    }

    const PLAIN: &str = "joint = { type = \"revolute\", axis = \"z\" }";

    #[test]
    fn denavit_hartenberg_parameters_are_a_table_of_their_convention() {
        let frame = "joint = { type = \"revolute\" }\n\
                     dh = { convention = \"modified\", a = \"a1\", alpha = \"-pi/2\", theta = \"pi/2\" }";
        let arm = robot(frame, "xx = 1, yy = 1, zz = 1");
        let symbols = Symbols::of(&arm);
        let found: Vec<String> = dh(&arm, &symbols).map(|table| format!("{table}")).collect();
        let [table] = found.as_slice() else { panic!("{found:?}") };
        for part in
            ["modified convention", "aᵢ₋₁", "θᵢ", ">−π/2<", "<small>0.4</small>", "<mo>+</mo>"]
        {
            assert!(table.contains(part), "{part}: {table}");
        }
        assert_eq!(dh(&robot(PLAIN, "xx = 1, yy = 1, zz = 1"), &symbols).count(), 0);
    }

    #[test]
    fn drives_have_a_table_with_nominal_values() {
        let shown = |drive: &str| {
            let robot = robot(&format!("{PLAIN}\n{drive}"), "xx = 1, yy = 1, zz = 1");
            drives(&robot, &Symbols::of(&robot)).map(|table| table.to_string())
        };
        assert_eq!(shown(""), None);
        let table = shown("drive = { rotor_inertia = 0.003, gear_ratio = \"-80*a1/a1\" }").unwrap();
        for part in ["Drives: the rotor inertia", "boom", "0.003", "<small>−80</small>"] {
            assert!(table.contains(part), "{part}: {table}");
        }
        assert!(!table.contains("Armature"), "{table}");
    }

    #[test]
    fn columns_of_zeros_are_named_in_the_caption() {
        let shown = |inertia| {
            let robot = robot(PLAIN, inertia);
            masses(&robot, &Symbols::of(&robot)).to_string()
        };
        let plain = shown("xx = 1, yy = 1, zz = 1");
        assert!(
            plain.contains("Columns of zeros are omitted: the products of inertia."),
            "{plain}"
        );
        assert!(plain.contains(">zz</th>") && !plain.contains(">xy</th>"), "{plain}");
        let one = shown("xx = 1, yy = 1, zz = 1, xz = 0.1");
        assert!(
            one.contains("the products of inertia xy and yz.") && one.contains(">xz</th>"),
            "{one}"
        );
        let all = shown("xx = 1, yy = 1, zz = 1, xy = 0.1, xz = 0.1, yz = 0.1");
        assert!(!all.contains("Columns of zeros") && all.contains(">yz</th>"), "{all}");
    }
}
