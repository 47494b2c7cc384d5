//! Writes a draft as a robot file in TOML: the links in order, with the names and values of the source.

use std::fmt::Write;
use std::path::Path;

use robot_symbolic::{Formula, Rational};

use super::Lowered;
use super::draft::{Draft, DraftLink, Mimic, Parent};
use super::placement::zeros;
use super::reader::Reader;
use crate::diagnostic::quote;
use crate::physics::{Verdict, judge};
use crate::robot::{Axis, Body, Friction, Inertia, JointKind, Move, Placement};

/// The draft as text. The frames of the draft must be placed by `xyz` and `rpy`, as they are in URDF.
pub(super) fn to_toml(lowered: &Lowered, name: &str) -> String {
    let Lowered { draft, order, .. } = lowered;
    let file = Path::new(name).file_name().and_then(|name| name.to_str()).unwrap_or(name);
    let mut text = format!("# Imported from {}.\nformat = 1\n\n[robot]\n", quote(file));
    line(&mut text, &format!("name = \"{}\"", draft.name.name));
    line(&mut text, &format!("gravity = {}", vector(&draft.gravity)));
    let mut are_on_base = vec![false; draft.links.len()];
    let mut before = None;
    for index in order {
        let Some(link) = draft.links.get(*index) else { continue };
        let is_parent_on_base = match link.parent {
            Parent::Link(parent) => are_on_base.get(parent).copied().unwrap_or_default(),
            Parent::Base | Parent::Name(_) => true,
        };
        let is_on_base = link.joint.kind.is_none() && is_parent_on_base;
        if let Some(slot) = are_on_base.get_mut(*index) {
            *slot = is_on_base;
        }
        push_link(&mut text, draft, link, before, is_on_base);
        before = Some(*index);
    }
    text
}

fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

/// Writes a link. `before` is the link that was written before it; `is_on_base` is whether the link is fixed to the
/// base, so that its mass has no effect.
fn push_link(
    text: &mut String,
    draft: &Draft,
    link: &DraftLink,
    before: Option<usize>,
    is_on_base: bool,
) {
    line(text, &format!("\n[[link]]\nname = \"{}\"", link.name.name));
    let parent = match (&link.parent, before) {
        (Parent::Link(parent), before) if before != Some(*parent) => {
            draft.links.get(*parent).map(|parent| parent.name.name.as_str())
        }
        (Parent::Base, Some(_)) => Some("base"),
        _ => None,
    };
    if let Some(parent) = parent {
        line(text, &format!("parent = \"{parent}\""));
    }
    line(text, &format!("joint = {}", joint(link)));
    let [xyz, rpy] = xyz_rpy(&link.before);
    let xyz = xyz.map(|xyz| format!("xyz = {}", vector(&xyz)));
    let rpy = rpy.map(|rpy| format!("rpy = {}", angles(&rpy)));
    let origin: Vec<String> = [xyz, rpy].into_iter().flatten().collect();
    if !origin.is_empty() {
        line(text, &format!("origin = {{ {} }}", origin.join(", ")));
    }
    let body = link.body.as_ref().filter(|_| !is_on_base);
    push_body(text, body.map(|(body, _)| body), link.joint.kind.is_some());
    if link.friction != Friction::none() {
        line(text, &format!("friction = {}", friction(&link.friction, link.joint.kind)));
    }
    if let Some(left_out) = &link.left_out {
        let coefficients = friction(left_out, link.joint.kind);
        line(
            text,
            &format!(
                "# friction = {coefficients}   # in the source, but not included in the torques"
            ),
        );
    }
}

fn push_body(text: &mut String, body: Option<&Body>, moving: bool) {
    let Some(body) = body else {
        if moving {
            line(text, "massless = true");
        }
        return;
    };
    if Reader::is_zero(&body.mass) {
        line(text, "massless = true");
    } else {
        line(text, &format!("mass = {}", formula_text(&body.mass)));
    }
    let [center, rpy] = xyz_rpy(&body.placement);
    line(text, &format!("center_of_mass = {}", vector(&center.unwrap_or_else(zeros))));
    let entries = &body.inertia.entries();
    let mut inertia: Vec<String> = Inertia::NAMES
        .iter()
        .zip(entries)
        .enumerate()
        .filter(|(index, (_, entry))| *index < 3 || !Reader::is_zero(entry))
        .map(|(_, (name, entry))| format!("{name} = {}", formula_text(entry)))
        .collect();
    inertia.extend(rpy.map(|rpy| format!("rpy = {}", angles(&rpy))));
    let values = entries.map(|entry| entry.evaluate(|_| f64::NAN));
    if judge(values) != Verdict::Possible {
        inertia.push("unchecked = true".to_owned());
    }
    line(text, &format!("inertia = {{ {} }}", inertia.join(", ")));
}

fn joint(link: &DraftLink) -> String {
    let joint = &link.joint;
    let mut parts = Vec::new();
    if joint.name.name != link.name.name {
        parts.push(format!("name = \"{}\"", joint.name.name));
    }
    let kind = match joint.kind {
        Some(JointKind::Revolute) => "revolute",
        Some(JointKind::Prismatic) => "prismatic",
        None => "fixed",
    };
    parts.push(format!("type = \"{kind}\""));
    if joint.kind.is_some() {
        parts.push(format!("axis = {}", axis(&joint.axis)));
    }
    if let Some([lower, upper]) = &joint.limits {
        parts.push(format!("limits = [{}, {}]", number(lower), number(upper)));
    }
    if let Some(Mimic { joint, ratio, offset, .. }) = &joint.mimic {
        let mut mimic = format!("joint = \"{}\", ratio = {}", joint.name, formula_text(ratio));
        if !Reader::is_zero(offset) {
            // Writing to a string does not fail.
            let _ = write!(mimic, ", offset = {}", formula_text(offset));
        }
        parts.push(format!("mimic = {{ {mimic} }}"));
    }
    format!("{{ {} }}", parts.join(", "))
}

/// The axis as `"z"` if it is an axis of the frame, otherwise as a vector.
fn axis(axis: &[Formula; 3]) -> String {
    let along: Vec<usize> =
        (0..3).filter(|index| axis.get(*index).is_some_and(|one| !Reader::is_zero(one))).collect();
    let ([index], Some(letter)) =
        (along.as_slice(), along.first().and_then(|i| "xyz".get(*i..=*i)))
    else {
        return vector(axis);
    };
    let negative = axis.get(*index).is_some_and(|one| one.evaluate(|_| f64::NAN) < 0.0);
    format!("\"{}{letter}\"", if negative { "-" } else { "" })
}

fn friction(friction: &Friction, kind: Option<JointKind>) -> String {
    let both = match kind {
        Some(JointKind::Prismatic) => "coulomb_force",
        Some(JointKind::Revolute) | None => "coulomb_torque",
    };
    let coefficients = [("viscous", &friction.viscous), (both, &friction.coulomb_positive)];
    let parts: Vec<String> = coefficients
        .iter()
        .filter(|(_, value)| !Reader::is_zero(value))
        .map(|(name, value)| format!("{name} = {}", formula_text(value)))
        .collect();
    format!("{{ {} }}", parts.join(", "))
}

/// The translation and the angles of a placement, each `None` if the placement has none.
fn xyz_rpy(placement: &Placement) -> [Option<[Formula; 3]>; 2] {
    let (mut xyz, mut rpy) = (None, None);
    for step in &placement.0 {
        match step {
            Move::Translate(by) => xyz = Some(by.clone()),
            Move::Rotate(axis, angle) => {
                let [roll, pitch, yaw] = rpy.get_or_insert_with(zeros);
                let slot = match axis {
                    Axis::X => roll,
                    Axis::Y => pitch,
                    Axis::Z => yaw,
                };
                slot.clone_from(angle);
            }
        }
    }
    [xyz, rpy]
}

fn vector(vector: &[Formula; 3]) -> String {
    format!("[{}]", vector.each_ref().map(formula_text).join(", "))
}

fn angles(angles: &[Formula; 3]) -> String {
    format!("[{}]", angles.each_ref().map(angle).join(", "))
}

/// The angle as a multiple of π/2 if the two are equal in floating point, otherwise as its value.
fn angle(angle: &Formula) -> String {
    const TURNS: &[&str] = &["pi/2", "-pi/2", "pi", "-pi", "3*pi/2", "-3*pi/2", "2*pi", "-2*pi"];
    let value = angle.evaluate(|_| f64::NAN);
    let same = |text: &&&str| {
        Formula::parse(text)
            .is_ok_and(|turn| turn.evaluate(|_| f64::NAN).to_bits() == value.to_bits())
    };
    match TURNS.iter().find(same) {
        Some(turn) => format!("\"{turn}\""),
        None => formula_text(angle),
    }
}

/// A value: a number, or an expression in quotes.
fn formula_text(formula: &Formula) -> String {
    match formula.as_number() {
        Some(value) => match value.as_rational() {
            Some(value) => number(value),
            None => format!("\"{}\"", formula.text()),
        },
        None => format!("\"{}\"", formula.text()),
    }
}

/// A decimal number in TOML with exactly this value: the shortest one if a floating-point number has the value.
fn number(value: &Rational) -> String {
    if let Some(integer) = value.to_integer().filter(|integer| integer.unsigned_abs() < 1 << 53) {
        return integer.to_string();
    }
    let short = format!("{:?}", value.to_f64());
    if Rational::from_decimal(&short).as_ref() == Some(value) {
        return short;
    }
    scientific(value)
}

/// The number with all its digits and an exponent.
fn scientific(value: &Rational) -> String {
    /// The maximum number of decimal places; the limits on digits and exponents of decimal text ensure that none has
    /// more.
    const MAX_PLACES: usize = 3100;
    let ten = Rational::integer(10);
    let mut scaled = value.clone();
    for places in 0..MAX_PLACES {
        let (digits, denominator) = scaled.to_digits();
        if denominator == "1" {
            let kept = digits.trim_end_matches('0');
            let zeros = digits.len() - kept.len();
            return match zeros.checked_sub(places) {
                Some(zeros) => format!("{kept}e{zeros}"),
                None => below_one(kept, places - zeros),
            };
        }
        scaled = &scaled * &ten;
    }
    format!("\"{value}\"")
}

/// The decimal text of `digits` · 10^−`places`. Exponents of decimal text are limited to ±400, so a number with more
/// places has the decimal point after its first digit.
fn below_one(digits: &str, places: usize) -> String {
    const MAX_EXPONENT: usize = 400;
    let first = if digits.starts_with('-') { 2 } else { 1 };
    match digits.split_at_checked(first) {
        Some((first, rest)) if places > MAX_EXPONENT => {
            format!("{first}.{rest}e-{}", places - rest.len())
        }
        _ => format!("{digits}e-{places}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_more_places_than_exponents_have_are_read_again() {
        let many = "1234567890".repeat(50);
        for text in [format!("0.{many}7"), format!("-0.{many}7"), format!("0.0{many}3e-250")] {
            let value = Rational::from_decimal(&text).unwrap();
            assert_eq!(Rational::from_decimal(&number(&value)), Some(value), "{text}");
        }
    }

    #[test]
    fn numbers_are_short_and_exact() {
        for (text, expected) in [
            ("0", "0"),
            ("-12", "-12"),
            ("4.0", "4"),
            ("0.350", "0.35"),
            ("2.375e-06", "2.375e-6"),
            ("1e300", "1e300"),
            ("-1e-320", "-1e-320"),
            ("0.1234567890123456789", "1234567890123456789e-19"),
            ("98765432109876543210.5", "987654321098765432105e-1"),
            ("90071992547409930000", "9007199254740993e4"),
        ] {
            let value = Rational::from_decimal(text).unwrap();
            assert_eq!(number(&value), expected);
            assert_eq!(Rational::from_decimal(expected).as_ref(), Some(&value));
        }
    }

    #[test]
    fn right_angles_are_recognized_by_their_last_digit() {
        let text = |text: &str| angle(&Formula::number(&Rational::from_decimal(text).unwrap()));
        assert_eq!(text("1.5707963267948966"), "\"pi/2\"");
        assert_eq!(text("-3.141592653589793"), "\"-pi\"");
        assert_eq!(text("1.57079632679"), "1.57079632679");
        assert_eq!(text("0"), "0");
    }

    #[test]
    fn axes_along_the_frame_are_letters() {
        let text = |vector: [&str; 3]| {
            axis(&vector.map(|one| Formula::number(&Rational::from_decimal(one).unwrap())))
        };
        assert_eq!(text(["0", "-2", "0"]), "\"-y\"");
        assert_eq!(text(["0.6", "0", "0.8"]), "[0.6, 0, 0.8]");
    }
}
