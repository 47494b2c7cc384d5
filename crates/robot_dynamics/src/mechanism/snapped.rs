//! Snapping of constant angles to multiples of π/2.

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
    let mut robot = robot.clone();
    let mut snaps = vec![];
    for link in &mut robot.links {
        place(&link.name, &mut link.placement, tolerance, &mut snaps);
        for body in &mut link.bodies {
            place(&link.name, &mut body.placement, tolerance, &mut snaps);
        }
    }
    for frame in &mut robot.frames {
        place(&frame.name, &mut frame.placement, tolerance, &mut snaps);
    }
    // The placements contain these angles, so that their changes are in the list already.
    for row in &mut robot.dh {
        for angle in [&mut row.alpha, &mut row.theta] {
            snap(angle, tolerance);
        }
    }
    (robot, snaps)
}

fn place(name: &str, placement: &mut Placement, tolerance: f64, snaps: &mut Vec<Snap>) {
    for step in &mut placement.0 {
        let Move::Rotate(_, formula) = step else { continue };
        let Some(Near { angle, change, .. }) = snap(formula, tolerance) else { continue };
        if change != 0.0 {
            snaps.push(Snap { name: name.to_owned(), angle, change });
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
}
