//! Numbers on the command line: `0.5`, `pi/2`, `90deg`.

use std::fmt::Display;
use std::ops::{Bound, RangeBounds};

use robot_model::description::undefined;
use robot_model::diagnostic::quote;
use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::{Formula, is_below_range};

/// The endings that mark values in degrees, for angles and their derivatives.
const DEGREES: [(JointVariable, &[&str]); 3] = [
    (JointVariable::Position, &["deg", "°"]),
    (JointVariable::Velocity, &["deg/s", "°/s", "deg", "°"]),
    (JointVariable::Acceleration, &["deg/s^2", "°/s^2", "deg", "°"]),
];

/// Parses a number, or a formula of numbers such as `-3*pi/4`.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    if let Ok(number) = text.parse::<f64>() {
        return match number.is_finite() {
            true if is_below_range(text, number) => {
                Err(format!("`{}` is below the range of floating-point numbers", quote(text)))
            }
            true => Ok(number),
            false => Err(format!("`{}` is not a finite number", quote(text))),
        };
    }
    let wrong = || format!("`{}` is not a number; write one such as 0.5 or pi/2", quote(text));
    let mut has_names = false;
    let parsed =
        Formula::parse(text).map_err(|error| match error.message.contains("exponent") {
            true => format!("`{}`: {}", quote(text), error.message),
            false => wrong(),
        })?;
    let number = parsed.evaluate(|_| {
        has_names = true;
        f64::NAN
    });
    match (has_names, undefined(&parsed), number.is_finite()) {
        (true, ..) => Err(wrong()),
        (false, Some(reason), _) => {
            Err(format!("`{}` does not have a value: {reason}", quote(text)))
        }
        (false, None, true) => Ok(number),
        (false, None, false) => Err(format!("`{}` does not have a finite value", quote(text))),
    }
}

/// Parses a time in seconds, such as `0.5`, `1/2` or `2s`.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    number(text).or_else(|wrong| match text.trim().strip_suffix('s') {
        Some(before) => number(before).map_err(|_| wrong),
        None => Err(wrong),
    })
}

/// Returns a parser of arguments that are whole numbers in a range, written such as `1000` or `1e3`.
pub(crate) fn whole<T>(
    range: impl RangeBounds<T> + Clone,
) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: TryFrom<u64> + PartialOrd + Display + Copy,
{
    move |text| {
        // Whole numbers up to this one are exact as f64.
        const MOST: f64 = (1_u64 << 53) as f64;
        let spelled =
            || text.parse().ok().filter(|x: &f64| x.fract() == 0.0 && (0.0..=MOST).contains(x));
        let number = text.parse::<u64>().ok().or_else(|| spelled().map(|x| x as u64));
        let number = number.and_then(|number| T::try_from(number).ok());
        number.filter(|number| range.contains(number)).ok_or_else(|| {
            let limits = match (range.start_bound(), range.end_bound()) {
                (Bound::Included(least), Bound::Included(most)) => {
                    format!(" from {least} to {most}")
                }
                (Bound::Included(least), _) if number.is_some() => format!(" of at least {least}"),
                _ if is_whole(text) => format!(" of at most {}", u64::MAX),
                _ => String::new(),
            };
            format!("expected a whole number{limits}")
        })
    }
}

/// Whether a text is a whole number of any size.
fn is_whole(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Parses a number in the unit of a joint's variable; angles can be in degrees.
fn of_joint(text: &str, variable: JointVariable, kind: JointKind) -> Result<f64, String> {
    let text = text.trim();
    let ends =
        DEGREES.iter().find(|(known, _)| *known == variable).map_or(&[][..], |(_, ends)| ends);
    let Some(degrees) = ends.iter().find_map(|end| text.strip_suffix(end)) else {
        return number(text).map_err(|wrong| match (kind, ends) {
            (JointKind::Revolute, [degrees, ..]) => {
                wrong.replace("0.5 or pi/2", &format!("0.5, pi/2 or 90{degrees}"))
            }
            _ => wrong,
        });
    };
    match kind {
        JointKind::Revolute if degrees.trim().is_empty() => {
            Err(format!("`{}` has no number; write one such as 90deg", quote(text)))
        }
        JointKind::Revolute => Ok(number(degrees)?.to_radians()),
        JointKind::Prismatic => {
            Err(format!("`{}` is an angle, and the joint is prismatic: write meters", quote(text)))
        }
    }
}

/// Parses a variable of all joints, separated by commas, given as `option`; the errors name the joints. The number of
/// values is not checked.
pub(crate) fn of_joints(
    option: &str,
    text: &str,
    variable: JointVariable,
    robot: &Robot,
) -> Result<Vec<f64>, Vec<String>> {
    let symbols = robot.symbols(variable);
    list(option, text, &symbols, |index, entry| {
        let kind = robot.coordinates.get(index).map_or(JointKind::Revolute, |one| one.kind);
        of_joint(entry, variable, kind)
    })
}

/// The message if the number of values is not that of the names.
pub(crate) fn miscounted(option: &str, values: &[f64], names: &[String]) -> Option<String> {
    let (given, expected) = (values.len(), names.len());
    let plural = if given == 1 { "entry" } else { "entries" };
    let names = names.join(", ");
    (given != expected).then(|| format!("{option}: {given} {plural}, not {expected} ({names})"))
}

/// Parses numbers with these names, separated by commas, given as `option`. Their number is not checked.
pub(crate) fn list(
    option: &str,
    text: &str,
    names: &[String],
    read: impl Fn(usize, &str) -> Result<f64, String>,
) -> Result<Vec<f64>, Vec<String>> {
    let entries: Vec<&str> =
        if text.trim().is_empty() { vec![] } else { text.split(',').collect() };
    let (mut values, mut wrong) = (vec![], vec![]);
    for (index, entry) in entries.iter().enumerate() {
        match read(index, entry) {
            Ok(value) => values.push(value),
            Err(why) => {
                let name = names.get(index).map(|name| format!(", {name}")).unwrap_or_default();
                wrong.push(format!("{option}: entry {}{name}: {why}", index + 1));
            }
        }
    }
    if wrong.is_empty() { Ok(values) } else { Err(wrong) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read() {
        let pi = std::f64::consts::PI;
        for (text, value) in [
            ("-0.5", -0.5),
            (" 1e-3 ", 1e-3),
            ("pi/2", pi / 2.0),
            ("-3*pi/4", -3.0 * pi / 4.0),
            ("sqrt(2)", 2_f64.sqrt()),
        ] {
            assert_eq!(number(text), Ok(value), "{text}");
        }
        for text in
            ["", "x", "pi/", "1/0", "inf", "nan", "90deg", "1,5", "2*x", "1e-400", "tan(pi/2)"]
        {
            assert!(number(text).is_err(), "{text}");
        }
    }

    #[test]
    fn seconds_have_a_unit_or_none() {
        for (text, value) in [("2", 2.0), ("1/2", 0.5), ("1s", 1.0), ("-1e-3 s", -1e-3)] {
            assert_eq!(seconds(text), Ok(value), "{text}");
        }
        for text in ["", "s", "1m", "1 ms", "x", "1e-400", "1e-400s", "inf"] {
            let shown = quote(text);
            assert!(seconds(text).is_err_and(|why| why.contains(&*shown)), "{text}");
        }
    }

    /// A joint that mimics another has no coordinate, so the second coordinate is that of the third joint.
    #[test]
    fn degrees_are_those_of_revolute_coordinates() {
        let link = |name: &str, joint: &str| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ axis = \"z\", {joint} }}\nmass = 1\n\
                 center_of_mass = [0, 0, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
            )
        };
        let arm = |kinds: [&str; 3]| {
            let [a, b, c] = kinds.map(|kind| format!("type = \"{kind}\""));
            let text = [
                "format = 1\n[robot]\nname = \"arm\"\n".to_owned(),
                link("1", &a),
                link("2", &format!("{b}, mimic = {{ joint = \"1\" }}")),
                link("3", &c),
            ];
            robot_model::description::read("arm.toml", &text.concat()).unwrap().robot
        };
        let read = |robot| of_joints("--q", "0, 90deg", JointVariable::Position, &robot);
        let slider = arm(["revolute", "revolute", "prismatic"]);
        assert!(read(slider).unwrap_err()[0].contains("entry 2, q2: `90deg` is an angle"));
        let turning = arm(["prismatic", "prismatic", "revolute"]);
        assert_eq!(read(turning), Ok(vec![0.0, 90_f64.to_radians()]));
    }

    #[test]
    fn degrees_are_those_of_revolute_joints() {
        let read = |text, variable, kind| of_joint(text, variable, kind);
        use JointKind::{Prismatic, Revolute};
        use JointVariable::{Acceleration, Position, Torque, Velocity};
        assert_eq!(read("90deg", Position, Revolute), Ok(90_f64.to_radians()));
        assert_eq!(read("-45 °", Position, Revolute), Ok((-45_f64).to_radians()));
        assert_eq!(read("180deg/s", Velocity, Revolute), Ok(180_f64.to_radians()));
        assert_eq!(read("1deg/s^2", Acceleration, Revolute), Ok(1_f64.to_radians()));
        assert_eq!(read("0.5", Position, Prismatic), Ok(0.5));
        assert!(read("deg", Position, Revolute).unwrap_err().contains("has no number"));
        assert!(read("90deg/s", Position, Revolute).is_err());
        assert!(read("90deg", Torque, Revolute).is_err());
        assert!(read("90deg", Position, Prismatic).unwrap_err().contains("prismatic"));
    }
}
