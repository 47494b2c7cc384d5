//! Positions on the command line and in files of states that are outside the limits in the robot file.

use robot_model::diagnostic::{number, significant};
use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::Rational;

use crate::Terminal;
use crate::failure::Failure;
use crate::states::Place;

/// Notes that joint positions, given as `text` with an option, are outside their limits. They have no effect on the
/// dynamics, but such a position may be in degrees.
pub(crate) fn note(
    (option, text): (&str, &str),
    positions: &[f64],
    robot: &Robot,
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    // Who writes a unit or a multiple of pi knows that numbers are in radians.
    let may_be_degrees = !text.contains(['d', '°', 'p']);
    let remedy = |position| {
        may_be_degrees.then(|| format!("a value in degrees is written {}deg", number(position)))
    };
    if let Some(found) = outside(positions, robot, remedy) {
        writeln!(terminal.errors, "note: {option}: {found}")?;
    }
    Ok(())
}

/// The states of a file whose positions are outside their limits.
pub(crate) struct Outside<'r> {
    robot: &'r Robot,
    limits: Vec<Option<[f64; 2]>>,
    count: usize,
    first: Option<String>,
}

impl Outside<'_> {
    pub(crate) fn new(robot: &Robot) -> Outside<'_> {
        Outside { robot, limits: limits(robot).collect(), count: 0, first: None }
    }

    /// Adds the positions of a state.
    pub(crate) fn add(&mut self, place: Place, positions: &[f64]) {
        let mut all = self.limits.iter().zip(positions);
        if all.all(|(limits, position)| limits.is_none_or(|limits| is_inside(limits, *position))) {
            return;
        }
        self.count += 1;
        if self.first.is_none() {
            let remedy = |_| Some("angles in files are in radians".to_owned());
            let text = outside(positions, self.robot, remedy);
            self.first = text.map(|text| format!("{place}: {text}"));
        }
    }

    /// The note about these states of a file, if there are any.
    pub(crate) fn note(&self, file: &str) -> Option<String> {
        let all = match self.count {
            0 | 1 => String::new(),
            count => format!(" ({count} such states)"),
        };
        Some(format!("note: {file}: {}{all}\n", self.first.as_deref()?))
    }
}

/// The limits of each coordinate that has them, in rad or m.
fn limits(robot: &Robot) -> impl Iterator<Item = Option<[f64; 2]>> {
    let limits = robot.coordinates.iter().map(|coordinate| coordinate.limits.as_ref());
    limits.map(|limits| limits.map(|limits| limits.each_ref().map(Rational::to_f64)))
}

fn is_inside([lower, upper]: [f64; 2], position: f64) -> bool {
    (lower..=upper).contains(&position)
}

/// The text about the positions outside their limits, if there are any; `remedy` is the advice if a position would be
/// inside in degrees.
fn outside(
    positions: &[f64],
    robot: &Robot,
    remedy: impl Fn(f64) -> Option<String>,
) -> Option<String> {
    let symbols = robot.symbols(JointVariable::Position);
    let mut found = vec![];
    let kinds = robot.coordinates.iter().map(|coordinate| coordinate.kind);
    for (((kind, limits), symbol), position) in kinds.zip(limits(robot)).zip(symbols).zip(positions)
    {
        if let Some(limits) = limits.filter(|limits| !is_inside(*limits, *position)) {
            found.push((symbol, *position, limits, kind));
        }
    }
    let (symbol, position, limits, kind) = found.first()?;
    let others: Vec<&str> = found[1..].iter().map(|(symbol, ..)| symbol.as_str()).collect();
    let others = match others.as_slice() {
        [] => String::new(),
        [other] => format!(", and so is {other}"),
        [..] => format!(", and so are {}", others.join(", ")),
    };
    let in_degrees = found.iter().find(|(_, position, limits, kind)| {
        *kind == JointKind::Revolute && is_inside(*limits, position.to_radians())
    });
    let remedy = in_degrees.and_then(|(_, position, ..)| remedy(*position));
    let remedy = remedy.map_or_else(String::new, |remedy| format!("; {remedy}"));
    let unit = JointVariable::Position.unit(*kind);
    let [lower, upper] = limits.map(significant);
    let position = number(*position);
    Some(format!(
        "{symbol} = {position} {unit} is outside its limits, {lower} to {upper} {unit}{others}{remedy}"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_outside_their_limits_are_found() {
        let link = |name: &str, joint: &str| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ axis = \"z\", {joint} }}\nmass = 1\n\
                 center_of_mass = [0, 0, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
            )
        };
        let text = [
            "format = 1\n[robot]\nname = \"arm\"\n".to_owned(),
            link("1", "type = \"revolute\", limits = [-2, 2]"),
            link("2", "type = \"revolute\""),
            link("3", "type = \"prismatic\", limits = [0, 0.5]"),
            link("4", "type = \"revolute\", limits = [-1, 1]"),
        ];
        let robot = robot_model::description::read("arm.toml", &text.concat()).unwrap().robot;
        for (positions, expected) in [
            ([2.0, 90.0, 0.5, -1.0], None),
            (
                [3.0, 0.0, 0.0, 0.0],
                Some(
                    "q1 = 3 rad is outside its limits, -2 to 2 rad; a value in degrees is written 3deg",
                ),
            ),
            (
                [90.0, 90.0, 0.0, -45.0],
                Some(
                    "q1 = 90 rad is outside its limits, -2 to 2 rad, and so is q4; a value in degrees \
                     is written 90deg",
                ),
            ),
            ([0.0, 0.0, 1.0, 0.0], Some("q3 = 1 m is outside its limits, 0 to 0.5 m")),
        ] {
            let degrees =
                |position| Some(format!("a value in degrees is written {}deg", number(position)));
            let found = outside(&positions, &robot, degrees);
            assert_eq!(found.as_deref(), expected, "{positions:?}");
        }
        let turned = outside(&[3.0, 0.0, 0.0, 0.0], &robot, |_| None);
        assert_eq!(turned.as_deref(), Some("q1 = 3 rad is outside its limits, -2 to 2 rad"));

        let mut found = Outside::new(&robot);
        found.add(Place::Line(2), &[2.0, 90.0, 0.5, -1.0]);
        assert_eq!(found.note("states.csv"), None);
        found.add(Place::Line(3), &[90.0, 0.0, 0.0, 0.0]);
        let first = "note: states.csv: line 3: q1 = 90 rad is outside its limits, -2 to 2 rad; angles in files are in \
                     radians";
        assert_eq!(found.note("states.csv"), Some(format!("{first}\n")));
        found.add(Place::Line(4), &[0.0, 0.0, 1.0, 0.0]);
        let all = format!("{first} (2 such states)\n");
        assert_eq!(found.note("states.csv"), Some(all));
    }
}
