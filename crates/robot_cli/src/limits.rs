//! Positions on the command line that are outside the limits in the robot file.

use robot_model::diagnostic::{number, significant};
use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::Rational;

use crate::Terminal;
use crate::failure::Failure;

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
    if let Some(found) = outside(positions, may_be_degrees, robot) {
        writeln!(terminal.errors, "note: {option}: {found}")?;
    }
    Ok(())
}

/// The text about the positions outside their limits, if there are any.
fn outside(positions: &[f64], may_be_degrees: bool, robot: &Robot) -> Option<String> {
    let symbols = robot.symbols(JointVariable::Position);
    let mut found = vec![];
    for ((coordinate, symbol), position) in robot.coordinates.iter().zip(symbols).zip(positions) {
        let Some(limits) = &coordinate.limits else { continue };
        let [lower, upper] = limits.each_ref().map(Rational::to_f64);
        if !(lower..=upper).contains(position) {
            found.push((symbol, *position, [lower, upper], coordinate.kind));
        }
    }
    let (symbol, position, limits, kind) = found.first()?;
    let others: Vec<&str> = found[1..].iter().map(|(symbol, ..)| symbol.as_str()).collect();
    let others = match others.as_slice() {
        [] => String::new(),
        [other] => format!(", and so is {other}"),
        [..] => format!(", and so are {}", others.join(", ")),
    };
    let in_degrees = found.iter().find(|(_, position, [lower, upper], kind)| {
        may_be_degrees
            && *kind == JointKind::Revolute
            && (*lower..=*upper).contains(&position.to_radians())
    });
    let remedy = in_degrees.map_or_else(String::new, |(_, position, ..)| {
        format!("; a value in degrees is written {}deg", number(*position))
    });
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
            assert_eq!(outside(&positions, true, &robot).as_deref(), expected, "{positions:?}");
        }
        let turned = outside(&[3.0, 0.0, 0.0, 0.0], false, &robot);
        assert_eq!(turned.as_deref(), Some("q1 = 3 rad is outside its limits, -2 to 2 rad"));
    }
}
