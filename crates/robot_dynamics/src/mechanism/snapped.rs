//! Snapping of constant angles to multiples of π/2.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

use robot_model::robot::{Move, Placement, Robot};
use robot_symbolic::{Formula, Number};

use super::Snap;

/// A constant angle and the multiple of π/2 near it.
pub(super) struct Near {
    /// The multiple, in quarter turns.
    pub(super) quarters: i64,
    /// The angle, rad.
    pub(super) angle: f64,
    /// The multiple minus the angle, rad.
    pub(super) change: f64,
}

/// The multiple of π/2 from which a formula without symbols differs by at most the tolerance, rad.
pub(super) fn near(formula: &Formula, tolerance: f64) -> Option<Near> {
    let number = constant(formula)?;
    let (quarters, change) = quarters(&number, tolerance)?;
    Some(Near { quarters, angle: number.to_f64(), change })
}

/// The multiple of π/2, in quarter turns, from which a constant angle differs by at most the tolerance, and the
/// multiple minus the angle, rad.
fn quarters(angle: &Number, tolerance: f64) -> Option<(i64, f64)> {
    let value = angle.to_f64();
    let quarters = (value / FRAC_PI_2).round();
    let change = quarters * FRAC_PI_2 - value;
    if angle.is_zero() || change.abs() > tolerance || quarters.abs() > 1e6 {
        return None;
    }
    // |quarters| is below 1e6, so the cast is exact.
    Some((quarters as i64, change))
}

/// The robot with all constant angles of placements within `tolerance` (rad) of a multiple of π/2 replaced by `pi/2`
/// and so on, and the angles that this changes.
#[must_use]
pub fn snapped(robot: &Robot, tolerance: f64) -> (Robot, Vec<Snap>) {
    let snaps = changes(robot, tolerance);
    let mut robot = robot.clone();
    for link in &mut robot.links {
        snap_all(&mut link.placement, tolerance);
        for body in &mut link.bodies {
            snap_all(&mut body.placement, tolerance);
        }
    }
    for frame in &mut robot.frames {
        snap_all(&mut frame.placement, tolerance);
    }
    for row in &mut robot.dh {
        for angle in [&mut row.alpha, &mut row.theta] {
            snap(angle, tolerance);
        }
    }
    (robot, snaps)
}

/// The angles that snapping changes. The angle of a fixed link is in the placements of its body, of its frame and of the
/// links that it carries; it is in the list once.
pub(super) fn changes(robot: &Robot, tolerance: f64) -> Vec<Snap> {
    let mut list = List { tolerance, seen: HashMap::new(), snaps: vec![] };
    for (index, link) in robot.links.iter().enumerate() {
        list.add(&link.name, link.parent, &link.placement);
        for body in &link.bodies {
            list.add(&body.name, Some(index), &body.placement);
        }
    }
    for frame in &robot.frames {
        list.add(&frame.name, frame.link, &frame.placement);
    }
    list.snaps
}

/// The changed angles that were found so far.
struct List<'r> {
    tolerance: f64,
    /// The moves from a link, or the base, up to and including each changed angle.
    seen: HashMap<Option<usize>, Vec<&'r [Move]>>,
    snaps: Vec<Snap>,
}

impl<'r> List<'r> {
    /// Adds the angles of a placement relative to the link `from`, or the base, that are not in the list.
    fn add(&mut self, name: &str, from: Option<usize>, placement: &'r Placement) {
        for (place, step) in placement.0.iter().enumerate() {
            let Move::Rotate(_, formula) = step else { continue };
            let near = near(formula, self.tolerance).filter(|near| near.change != 0.0);
            let Some(Near { angle, change, .. }) = near else { continue };
            let moves = &placement.0[..=place];
            let seen = self.seen.entry(from).or_default();
            if !seen.contains(&moves) {
                seen.push(moves);
                self.snaps.push(Snap { name: name.to_owned(), angle, change });
            }
        }
    }
}

fn snap_all(placement: &mut Placement, tolerance: f64) {
    for step in &mut placement.0 {
        if let Move::Rotate(_, formula) = step {
            snap(formula, tolerance);
        }
    }
}

/// Replaces a constant angle within the tolerance of a multiple of π/2 by that multiple. `None` if there is no such
/// multiple.
fn snap(formula: &mut Formula, tolerance: f64) -> Option<Near> {
    let near = near(formula, tolerance)?;
    if let Ok(multiple) = Formula::parse(&multiple_text(near.quarters)) {
        *formula = multiple;
    }
    Some(near)
}

/// The value of a formula without symbols, such as 1.5708 or π/2 + 10⁻⁷.
fn constant(formula: &Formula) -> Option<Number> {
    formula.as_number().or_else(|| {
        let value = formula.evaluate(|_| f64::NAN);
        (formula.is_constant() && value.is_finite()).then(|| Number::real(value))
    })
}

/// The text of a multiple of π/2: `-pi/2`, `3*pi/2`, `2*pi`.
fn multiple_text(quarters: i64) -> String {
    let sign = if quarters < 0 { "-" } else { "" };
    let (count, below) = match quarters.unsigned_abs() {
        even if even.is_multiple_of(2) => (even / 2, ""),
        odd => (odd, "/2"),
    };
    match count {
        0 => "0".to_owned(),
        1 => format!("{sign}pi{below}"),
        _ => format!("{sign}{count}*pi{below}"),
    }
}

#[cfg(test)]
mod tests {
    use robot_model::description::read_toml;

    use super::*;

    #[test]
    fn multiples_are_as_people_write_them() {
        let texts = [0, 1, -1, 2, -2, 3, -3, 4].map(multiple_text);
        let expected = ["0", "pi/2", "-pi/2", "pi", "-pi", "3*pi/2", "-3*pi/2", "2*pi"];
        assert_eq!(texts, expected);
    }

    #[test]
    fn sums_with_pi_are_snapped_like_decimals() {
        for (text, expected) in [
            ("pi/2 + 1e-12", Some("pi/2")),
            ("pi/2 + 4e-6", Some("pi/2")),
            ("-3*pi/2 - 4e-6", Some("-3*pi/2")),
            ("sqrt(2)*pi/sqrt(8)", Some("pi/2")),
            ("1.5708", Some("pi/2")),
            ("pi/2 + 2e-5", None),
            ("pi/2 + 0*a", None),
            ("pi/4", None),
        ] {
            let mut formula = Formula::parse(text).unwrap();
            let snapped = snap(&mut formula, 1e-5).map(|_| formula.text().to_owned());
            assert_eq!(snapped.as_deref(), expected, "{text}");
        }
    }

    #[test]
    fn an_angle_is_a_multiple_up_to_the_tolerance() {
        let of = |value: f64| quarters(&Number::real(value), 1e-5).map(|(quarters, _)| quarters);
        let near = [FRAC_PI_2 + 4e-6, -2.0 * FRAC_PI_2 - 8e-6, 1e-12, 0.0].map(of);
        assert_eq!(near, [Some(1), Some(-2), Some(0), None]);
        assert_eq!([FRAC_PI_2 + 2e-5, 0.785, 1e-4].map(of), [None; 3]);
    }

    /// A fixed link's angle is in the placements of its body, of its frame and of what it carries.
    #[test]
    fn the_angle_of_a_fixed_link_is_in_the_list_once() {
        let link = |name: &str, joint: &str, more: &str| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ {joint} }}\norigin = {{ xyz = [0, 0, 0.3]{more} }}\nmass = 1\n\
                 center_of_mass = [0, 0, 0.1]\ninertia = {{ xx = 0.01, yy = 0.01, zz = 0.01 }}\n"
            )
        };
        let turns = "type = \"revolute\", axis = \"y\"";
        let angle = ", rpy = [0, 0, 1.5708]";
        let text = "format = 1\n[robot]\nname = \"arm\"\n".to_owned()
            + &link("a", turns, "")
            + &link("palm", "type = \"fixed\"", angle)
            + &link("b", turns, "")
            + &link("c", turns, angle);
        let robot = read_toml("arm.toml", &text).unwrap().robot;
        let (_, snaps) = snapped(&robot, 1e-5);
        let names: Vec<&str> = snaps.iter().map(|snap| snap.name.as_str()).collect();
        assert_eq!(names, ["palm", "c"]);
    }
}
