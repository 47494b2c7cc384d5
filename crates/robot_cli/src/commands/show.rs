//! `show`: the contents of a robot file.

use clap::Args;
use robot_build::{FrameRef, FunctionKind, Options, functions, snapping, unsolvable};
use robot_document::robot::drives::{Drives, drives};
use robot_document::robot::rows::{self, LinkRow, ParameterRow};
use robot_document::robot::words;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::diagnostic::significant;
use robot_model::robot::{Inertia, JointKind, Placement, Robot};
use robot_symbolic::Graph;

use crate::Terminal;
use crate::failure::Failure;
use crate::help::wrapped;
use crate::robot::RobotArgument;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic show robots/trttr1.toml")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let described = self.robot.read(terminal)?;
        let robot = &described.robot;
        self.robot.check_base_frames(&[], terminal)?;
        let output = &mut terminal.output;
        writeln!(output, "{}", robot.name)?;
        if let Some(description) = &robot.description {
            let lines = description.trim().lines();
            let lines: Vec<String> = lines.map(|line| wrapped(line, text::COLUMNS, 0)).collect();
            writeln!(output, "{}", lines.join("\n"))?;
        }
        writeln!(output, "\n{}", text::table(&joints(robot)))?;
        let bodies = bodies(robot);
        if !bodies.is_empty() {
            writeln!(output, "{bodies}")?;
        }
        writeln!(output, "{POSES}\n{}", text::table(&poses(robot)))?;
        let masses = masses(robot, self.robot.snap());
        writeln!(output, "{MASSES}\n{}", table_of_masses(masses))?;
        if let Some(drives) = drives(robot) {
            let caption = wrapped(&drives.caption, text::COLUMNS, 0);
            writeln!(output, "{caption}\n{}", text::table(&rows_of_drives(robot, &drives)))?;
        }
        if !robot.parameters.is_empty() {
            writeln!(output, "{}", text::table(&parameters(robot)))?;
        }
        writeln!(output, "{}", functions(robot))?;
        let snapping = snapping(robot, self.robot.snap(), None)?;
        writeln!(output, "{}", text::snapping(&snapping))?;
        for group in described.choices.groups() {
            writeln!(output, "note: {}", group.line(described.choices.source()))?;
        }
        Ok(())
    }
}

/// The meaning and units of the table of poses.
const POSES: &str = "poses at joint position 0, as translations and rotations from the frame in the second column,\n\
    each in the frame reached by the preceding ones; lengths in m, angles in rad:";

/// The units and axes of the table of masses.
const MASSES: &str = "mass in kg; center of mass x, y, z in m, in the link frame; moments of inertia about the center of\n\
    mass in kg m^2, in the axes of the link frame; at the nominal parameters, without columns of zeros:";

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

fn joints(robot: &Robot) -> Vec<Vec<String>> {
    let title = ["link", "parent", "joint", "type", "coordinate", "limits"];
    let mut rows = vec![row(title)];
    for LinkRow { link, parent, kind, limits, .. } in rows::links(robot) {
        let axis = words::vector(&link.joint.axis, |formula| formula.text().to_owned());
        let (direction, unit) = match link.joint.kind {
            JointKind::Revolute => ("about", "rad"),
            JointKind::Prismatic => ("along", "m"),
        };
        let limits = limits.map_or_else(String::new, |limits| {
            let [low, high] = limits.each_ref().map(|limit| significant(limit.to_f64()));
            format!("{low} to {high} {unit}")
        });
        rows.push(vec![
            link.name.clone(),
            parent.to_owned(),
            link.joint.name.clone(),
            format!("{kind} {direction} {axis}"),
            rows::position_text(&link.joint),
            limits,
        ]);
    }
    without_empty(rows)
}

/// Lists the bodies of each link that has a body with another name than its own.
fn bodies(robot: &Robot) -> String {
    let mut shown = String::new();
    for link in &robot.links {
        let bodies: Vec<&str> = link.bodies.iter().map(|body| body.name.as_str()).collect();
        if bodies.iter().any(|body| *body != link.name) {
            shown += &text::list(&format!("bodies of {}", link.name), &bodies);
        }
    }
    shown
}

/// The pose of each link's frame relative to that of its parent, and of each named frame relative to that of its link.
/// A long pose takes several rows.
fn poses(robot: &Robot) -> Vec<Vec<String>> {
    let links = rows::links(robot).map(|row| (&row.link.name, row.parent, &row.link.placement));
    let frames = rows::frames(robot);
    let frames = frames.map(|row| (&row.frame.name, row.link, &row.frame.placement));
    let all: Vec<(&String, &str, &Placement)> = links.chain(frames).collect();
    let length = |name: &str| name.chars().count() + "  ".len();
    let names = all.iter().map(|(name, _, _)| length(name)).max().unwrap_or(0);
    let origins = all.iter().map(|(_, origin, _)| length(origin)).max().unwrap_or(0);
    let room =
        text::COLUMNS.saturating_sub(names.max(length("frame")) + origins.max(length("from")));
    let mut rows = vec![row(["frame", "from", "pose"])];
    for (name, origin, placement) in all {
        let moves: Vec<String> = words::moves(placement)
            .map(|step| words::pose(&Placement(vec![step.clone()]), |part| part.text().to_owned()))
            .collect();
        let mut lines = filled(&moves, room).into_iter();
        let first = lines.next().unwrap_or_else(|| "the same".to_owned());
        rows.push(row([name.as_str(), origin, &first]));
        rows.extend(lines.map(|line| row(["", "", &line])));
    }
    rows
}

/// Joins parts by commas, on lines of at most `columns` columns if each part fits on one.
fn filled(parts: &[String], columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for (index, part) in parts.iter().enumerate() {
        let part = if index + 1 < parts.len() { format!("{part},") } else { part.clone() };
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + part.chars().count() <= columns => {
                *line += &format!(" {part}");
            }
            _ => lines.push(part),
        }
    }
    lines
}

/// The mass, center of mass and inertia tensor of each link at the nominal parameters. Entries without a value are
/// `?`; columns of zeros are left out.
fn masses(robot: &Robot, snap: Option<f64>) -> Vec<Vec<String>> {
    let graph = Graph::new();
    let options = MechanismOptions::EXACT.with_snap(snap, robot);
    let mechanism = Mechanism::new(robot, &graph, &options);
    let title = ["link", "mass", "x", "y", "z"].into_iter().chain(Inertia::NAMES);
    let mut rows = vec![title.map(str::to_owned).collect::<Vec<_>>()];
    for (link, moving) in robot.links.iter().zip(&mechanism.links) {
        let tensor = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        let tensor = tensor.map(|(row, column)| moving.inertia.0[row][column]);
        let values = [moving.mass].into_iter().chain(moving.center_of_mass.0).chain(tensor);
        let shown = values.map(|value| {
            let number = value.evaluate(|symbol| robot.nominal_value(&graph.symbol_name(symbol)));
            if number.is_finite() { significant(number) } else { "?".to_owned() }
        });
        rows.push(std::iter::once(link.name.clone()).chain(shown).collect());
    }
    without_zeros(rows)
}

/// Prints the table of masses; if it is too wide, the inertia tensors are a table of their own.
fn table_of_masses(rows: Vec<Vec<String>>) -> String {
    let whole = text::table(&rows);
    if whole.lines().all(|line| line.chars().count() <= text::COLUMNS) {
        return whole;
    }
    let is_tensor: Vec<bool> = rows.first().map_or(vec![], |title| {
        title.iter().map(|name| Inertia::NAMES.contains(&name.as_str())).collect()
    });
    let some = |rows, of_tensor: bool| {
        let is_wanted = |column: usize| column == 0 || is_tensor.get(column) == Some(&of_tensor);
        text::table(&with(rows, is_wanted))
    };
    format!("{}\n{}", some(rows.clone(), false), some(rows, true))
}

/// Removes columns that are empty below the title. The first column has names, which are not empty.
fn without_empty(rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    without(rows, |_, cell| cell.is_empty())
}

/// Removes columns after the mass that are 0 below the title.
fn without_zeros(rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    without(rows, |column, cell| column > 1 && cell.parse() == Ok(0.0))
}

fn without(rows: Vec<Vec<String>>, is_nothing: impl Fn(usize, &str) -> bool) -> Vec<Vec<String>> {
    let has = |column: usize| {
        let mut cells = rows.iter().skip(1).filter_map(|row| row.get(column));
        !cells.all(|cell| is_nothing(column, cell))
    };
    let kept: Vec<bool> = rows.first().map_or(vec![], |title| (0..title.len()).map(has).collect());
    with(rows, |column| kept.get(column) == Some(&true))
}

/// Keeps the columns that are wanted.
fn with(rows: Vec<Vec<String>>, is_wanted: impl Fn(usize) -> bool) -> Vec<Vec<String>> {
    let cut = |row: Vec<String>| {
        let cells = row.into_iter().enumerate().filter(|(column, _)| is_wanted(*column));
        cells.map(|(_, cell)| cell).collect()
    };
    rows.into_iter().map(cut).collect()
}

fn rows_of_drives(robot: &Robot, drives: &Drives<'_>) -> Vec<Vec<String>> {
    let headings = drives.columns.iter().map(|heading| heading.to_lowercase());
    let mut rows: Vec<Vec<String>> =
        vec![std::iter::once("link".to_owned()).chain(headings).collect()];
    for (index, values) in &drives.rows {
        let name = robot.links.get(*index).map_or_else(String::new, |link| link.name.clone());
        let values = values.iter().map(|value| value.text().to_owned());
        rows.push(std::iter::once(name).chain(values).collect());
    }
    rows
}

fn parameters(robot: &Robot) -> Vec<Vec<String>> {
    let mut rows = vec![row(["parameter", "nominal", "unit", "meaning"])];
    for ParameterRow { parameter, value, unit, meaning } in rows::parameters(robot) {
        rows.push(vec![
            parameter.name.clone(),
            value.unwrap_or_default(),
            unit.unwrap_or_default().to_owned(),
            meaning.unwrap_or_default().to_owned(),
        ]);
    }
    without_empty(rows)
}

/// The reason why forward dynamics does not exist.
const SINGULAR: &str = "the mass matrix is singular in every configuration";

/// Prints the functions that the robot has, then those that it does not have, each with the reason.
fn functions(robot: &Robot) -> String {
    let lacking = unsolvable(robot, &Options::default()).map_or(vec![], |found| found.functions);
    let why = |kind: &FunctionKind| {
        let singular = lacking.contains(kind).then_some(SINGULAR);
        kind.missing_in(robot).or(singular)
    };
    let (mut there, mut absent): (Vec<&str>, Vec<(&str, Vec<&str>)>) = (vec![], vec![]);
    for kind in FunctionKind::ALL {
        match why(kind) {
            None => there.push(kind.name()),
            Some(why) => match absent.iter_mut().find(|(known, _)| *known == why) {
                Some((_, names)) => names.push(kind.name()),
                None => absent.push((why, vec![kind.name()])),
            },
        }
    }
    let named: Vec<(String, FunctionKind)> = functions::names(robot).into_iter().collect();
    let of = |is_wanted: fn(&FrameRef) -> bool| -> Vec<&str> {
        let wanted =
            named.iter().filter(|(_, kind)| kind.frame().is_some_and(|frame| is_wanted(&frame)));
        wanted.map(|(name, _)| name.as_str()).collect()
    };
    let lists = [
        ("functions", there),
        ("of frames", of(|frame| matches!(frame, FrameRef::Named(_)))),
        ("of moving links, by name only", of(|frame| matches!(frame, FrameRef::Link(_)))),
    ];
    let lists = lists.iter().filter(|(_, names)| !names.is_empty());
    let mut shown: String = lists.map(|(title, names)| text::list(title, names)).collect();
    for (why, names) in absent {
        shown += &text::list("not available", &names);
        shown += &format!("{}\n", wrapped(&format!("    {why}"), text::COLUMNS, 4));
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_are_broken_after_moves() {
        let moves = |count: usize| vec!["to (0, 0, 1)".to_owned(); count];
        assert_eq!(filled(&moves(0), 10), [""; 0]);
        assert_eq!(filled(&moves(1), 5), ["to (0, 0, 1)"]);
        let (two, one) = ("to (0, 0, 1), to (0, 0, 1),", "to (0, 0, 1)");
        assert_eq!(filled(&moves(3), two.len()), [two, one]);
        assert_eq!(filled(&moves(3), two.len() - 2).len(), 3);
    }

    #[test]
    fn wide_tables_of_masses_are_two() {
        let table = |width: usize| {
            let title = ["link", "mass", "x", "xx", "yz"].map(str::to_owned).to_vec();
            table_of_masses(vec![
                title,
                ["a", "1", "2", "3", &"4".repeat(width)].map(str::to_owned).to_vec(),
            ])
        };
        assert_eq!(table(3), "link  mass  x  xx   yz\na        1  2   3  444\n");
        let wide = table(100);
        assert!(wide.starts_with("link  mass  x\na        1  2\n\nlink  xx "), "{wide}");
    }
}
