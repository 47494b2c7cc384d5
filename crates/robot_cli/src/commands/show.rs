//! `show`: what a robot file says.

use clap::Args;
use robot_build::{FrameRef, FunctionKind, Options, functions, snapping, unsolvable};
use robot_document::robot::rows::{self, LinkRow, ParameterRow};
use robot_document::robot::words;
use robot_model::robot::{JointKind, Robot};

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
        let output = &mut terminal.output;
        writeln!(output, "{}", robot.name)?;
        if let Some(description) = &robot.description {
            writeln!(output, "{}", description.trim())?;
        }
        writeln!(output, "\n{}", text::table(&joints(robot)))?;
        if !robot.parameters.is_empty() {
            writeln!(output, "{}", text::table(&parameters(robot)))?;
        }
        writeln!(output, "{}", text::table(&functions(robot)))?;
        let snapping = snapping(robot, self.robot.snap(), None)?;
        writeln!(output, "{}", text::snapping(&snapping))?;
        for choice in described.choices.iter() {
            writeln!(output, "note: {}", choice.message)?;
        }
        Ok(())
    }
}

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

fn joints(robot: &Robot) -> Vec<Vec<String>> {
    let mut rows = vec![row(["link", "parent", "joint", "type", "coordinate", "bodies"])];
    for LinkRow { link, parent, kind, coordinate, .. } in rows::links(robot) {
        let axis = words::vector(&link.joint.axis, |formula| formula.text().to_owned());
        let direction = match link.joint.kind {
            JointKind::Revolute => "about",
            JointKind::Prismatic => "along",
        };
        let bodies: Vec<&str> = link.bodies.iter().map(|body| body.name.as_str()).collect();
        rows.push(vec![
            link.name.clone(),
            parent.to_owned(),
            link.joint.name.clone(),
            format!("{kind} {direction} {axis}"),
            coordinate,
            bodies.join(", "),
        ]);
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
    rows
}

/// Why there is no forward dynamics.
const SINGULAR: &str = "the mass matrix is singular in every posture";

fn functions(robot: &Robot) -> Vec<Vec<String>> {
    let mut rows = vec![row(["function", ""])];
    let lacking = unsolvable(robot, &Options::default()).map_or(vec![], |found| found.functions);
    for kind in FunctionKind::ALL {
        let singular = lacking.contains(kind).then_some(SINGULAR);
        rows.push(row([kind.name(), kind.missing_in(robot).or(singular).unwrap_or("yes")]));
    }
    for (name, kind) in functions::names(robot) {
        let what = match kind.frame() {
            None => continue,
            Some(FrameRef::Named(_)) => "of a frame",
            Some(FrameRef::Link(_)) => "of a moving link; must be named",
        };
        rows.push(row([&name, what]));
    }
    rows
}
