//! `show`: the contents of a robot file.

use clap::Args;
use robot_build::{FrameRef, FunctionKind, Options, functions, snapping, unsolvable};
use robot_document::robot::rows::{self, LinkRow, ParameterRow};
use robot_document::robot::words;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::diagnostic::significant;
use robot_model::robot::{Inertia, JointKind, Robot};
use robot_symbolic::Graph;

use crate::Terminal;
use crate::failure::Failure;
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
            writeln!(output, "{}", description.trim())?;
        }
        writeln!(output, "\n{}", text::table(&joints(robot)))?;
        writeln!(output, "{MASSES}\n{}", text::table(&masses(robot, self.robot.snap())))?;
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

/// The units and axes of the table of masses.
const MASSES: &str = "masses in kg; centers of mass in m, in the link frame; moments of inertia about the center of\n\
    mass in kg m^2, in the axes of the link frame; at the nominal parameters:";

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

fn joints(robot: &Robot) -> Vec<Vec<String>> {
    let title = ["link", "parent", "joint", "type", "coordinate", "limits", "bodies"];
    let mut rows = vec![row(title)];
    for LinkRow { link, parent, kind, coordinate, limits } in rows::links(robot) {
        let axis = words::vector(&link.joint.axis, |formula| formula.text().to_owned());
        let (direction, unit) = match link.joint.kind {
            JointKind::Revolute => ("about", "rad"),
            JointKind::Prismatic => ("along", "m"),
        };
        let limits = limits.map_or_else(String::new, |limits| {
            let [low, high] = limits.each_ref().map(|limit| significant(limit.to_f64()));
            format!("{low} to {high} {unit}")
        });
        let bodies: Vec<&str> = link.bodies.iter().map(|body| body.name.as_str()).collect();
        rows.push(vec![
            link.name.clone(),
            parent.to_owned(),
            link.joint.name.clone(),
            format!("{kind} {direction} {axis}"),
            coordinate,
            limits,
            bodies.join(", "),
        ]);
    }
    without_empty(rows)
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
    let cut = |row: Vec<String>| {
        row.into_iter().zip(&kept).filter(|(_, kept)| **kept).map(|(cell, _)| cell).collect()
    };
    rows.into_iter().map(cut).collect()
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
        shown += &format!("    {why}\n");
    }
    shown
}
