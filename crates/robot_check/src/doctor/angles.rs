//! Checks for angles that were rounded, and for angles in degrees.

use std::f64::consts::{FRAC_PI_2, TAU};

use robot_dynamics::mechanism::MechanismOptions;
use robot_model::description::AngleLocation;
use robot_model::diagnostic::{Diagnostic, code};
use robot_model::diagnostic::{number, significant};
use robot_model::robot::JointKind;

use super::facts::RobotFacts;

/// The maximum error of angles that programs write, rad.
const NOISE: f64 = 1e-6;
/// The relative error of a multiple of π/2 in single precision.
const SINGLE: f64 = 1.2e-7;
/// The minimum number of decimals for an angle to be taken as rounded; with fewer, 1.5 and 3 are ordinary angles.
const DECIMALS: i32 = 2;
/// The largest angle that a placement needs: one turn, rad.
const TURN: f64 = TAU + 1e-3;
/// The largest position of a joint with cables: four turns in either direction, rad.
const FOUR_TURNS: f64 = 4.0 * TAU + 1e-3;

pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let snap = MechanismOptions::ROUNDED.with_snap(None, facts.robot).snap;
    for angle in &facts.locations.angles {
        if angle.value.is_constant() {
            found.extend(placed(angle, snap));
        }
    }
    for link in &facts.links {
        let limit = link.farthest_limit(facts.robot, JointKind::Revolute);
        if let Some((widest, place)) = limit.filter(|(widest, _)| *widest > FOUR_TURNS) {
            let message =
                format!("a limit of `{}` is {} rad", link.link.joint.name, significant(widest));
            found.push(degrees(message, widest).at(place, "in degrees?"));
        }
    }
}

fn placed(angle: &AngleLocation, snap: f64) -> Option<Diagnostic> {
    let value = angle.value.evaluate(|_| f64::NAN);
    if value.abs() > TURN {
        let message = format!("an angle is {} rad", significant(value));
        return Some(degrees(message, value).at(&angle.place, "in degrees?"));
    }
    let quarters = (value / FRAC_PI_2).round();
    let miss = value - quarters * FRAC_PI_2;
    if miss == 0.0 {
        return None;
    }
    let multiple = multiple(quarters);
    if miss.abs() <= snap {
        return Some(
            Diagnostic::note(code::TAKEN_ANGLE, format!("an angle is snapped to {multiple}"))
                .at(&angle.place, format!("off by {} rad", significant(miss)))
                .because(format!(
                    "angles within {snap:e} rad of a multiple of π/2 are snapped to it"
                )),
        );
    }
    is_rounded(value, quarters, miss).then(|| {
        let message = format!("an angle is nearly {multiple}");
        Diagnostic::warning(code::ANGLE_NEAR, message)
            .at(&angle.place, format!("off by {} rad", significant(miss)))
            .because(format!(
                "the rounded angle leaves a {} of {} instead of 0 in the code and, unless it is \
                 snapped, in equations",
                if quarters.rem_euclid(2.0) == 0.0 { "sine" } else { "cosine" },
                significant(miss.sin().abs())
            ))
            .help(format!(
                "write all its digits, {}, or in a robot file \"{}\"; if the value cannot be \
                 changed, set `snap = {}` in `[robot]` or the option `snap`",
                quarters * FRAC_PI_2,
                multiple.replace('π', "pi"),
                tolerance(miss)
            ))
    })
}

/// Whether the value is the multiple of π/2 with some digits left out, rather than an independent angle, for example
/// from a calibration.
fn is_rounded(value: f64, quarters: f64, miss: f64) -> bool {
    let miss = miss.abs();
    if miss <= NOISE || miss <= SINGLE * value.abs() {
        return true;
    }
    let text = format!("{value}");
    let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let decimals = i32::try_from(decimals).unwrap_or(i32::MAX);
    // If it was rounded or truncated, the error is less than one unit of its last place.
    quarters != 0.0 && decimals >= DECIMALS && miss < 10.0_f64.powi(-decimals)
}

/// The smallest power of ten that is not below the error.
fn tolerance(miss: f64) -> String {
    format!("1e{}", miss.abs().log10().ceil())
}

/// The text of a multiple of π/2, such as `π/2` or `-3π/2`.
fn multiple(quarters: f64) -> String {
    // The number of quarter turns is small, because angles beyond one turn are reported as degrees.
    let quarters = quarters as i64;
    let sign = if quarters < 0 { "-" } else { "" };
    match quarters.abs() {
        0 => "0".to_owned(),
        1 => format!("{sign}π/2"),
        2 => format!("{sign}π"),
        3 => format!("{sign}3*π/2"),
        halves => format!("{sign}{}*π", halves / 2),
    }
}

fn degrees(message: String, value: f64) -> Diagnostic {
    Diagnostic::warning(code::DEGREES, message)
        .because(format!("these are {} turns", significant((value / TAU).abs())))
        .help(format!(
            "give angles in radians; {} degrees are {} rad",
            number(value),
            number(value.to_radians())
        ))
}
