//! Angles that were rounded, and angles in degrees.

use std::f64::consts::{FRAC_PI_2, TAU};

use robot_dynamics::mechanism::MechanismOptions;
use robot_model::description::AngleLocation;
use robot_model::diagnostic::significant;
use robot_model::diagnostic::{Diagnostic, code};
use robot_model::robot::JointKind;

use super::facts::RobotFacts;

/// Programs that write angles leave noise below this, rad.
const NOISE: f64 = 1e-6;
/// The part of a multiple of π/2 by which single precision misses it.
const SINGLE: f64 = 1.2e-7;
/// With fewer decimals than this, or with those, 1.5 and 3 are angles like others.
const DECIMALS: i32 = 2;
/// Placements need no more than a turn, rad.
const TURN: f64 = TAU + 1e-3;
/// Joints with cables turn no more than four times to a side, rad.
const FOUR_TURNS: f64 = 4.0 * TAU + 1e-3;

pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let snap = MechanismOptions::ROUNDED.with_snap(None, facts.robot).snap;
    for angle in &facts.locations.angles {
        if angle.value.is_constant() {
            found.extend(placed(angle, snap));
        }
    }
    for link in &facts.links {
        let coordinate = facts.robot.coordinates.get(link.link.joint.coordinate);
        let limits = coordinate.and_then(|one| match one.kind {
            JointKind::Revolute => one.limits.as_ref(),
            JointKind::Prismatic => None,
        });
        let (Some(limits), Some(place)) = (limits, &link.place.limits) else { continue };
        let widest = limits.each_ref().map(|limit| limit.to_f64().abs());
        let widest = widest.iter().fold(0.0_f64, |a, b| a.max(*b));
        if widest > FOUR_TURNS {
            let message = format!("a limit of `{}` is {widest} rad", link.link.joint.name);
            found.push(degrees(message, widest).at(place, "in degrees?"));
        }
    }
}

fn placed(angle: &AngleLocation, snap: f64) -> Option<Diagnostic> {
    let value = angle.value.evaluate(|_| f64::NAN);
    if value.abs() > TURN {
        let message = format!("an angle is {value} rad");
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
                "a rounded right angle leaves a {} of {} in the equations and in the code \
                 instead of 0",
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

/// Whether the value is the multiple of π/2 with some digits left out, rather than an angle of its
/// own, such as a calibration finds.
fn is_rounded(value: f64, quarters: f64, miss: f64) -> bool {
    let miss = miss.abs();
    if miss <= NOISE || miss <= SINGLE * value.abs() {
        return true;
    }
    let text = format!("{value}");
    let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let decimals = i32::try_from(decimals).unwrap_or(i32::MAX);
    // Rounded or cut off, it misses by less than one of its last place.
    quarters != 0.0 && decimals >= DECIMALS && miss < 10.0_f64.powi(-decimals)
}

/// The power of ten above the miss.
fn tolerance(miss: f64) -> String {
    format!("1e{}", miss.abs().log10().ceil())
}

/// `π/2`, `-3π/2`.
fn multiple(quarters: f64) -> String {
    // Angles beyond a turn are shown as degrees: quarters are few.
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
        .help(format!("give angles in radians; {value} degrees are {} rad", value.to_radians()))
}
