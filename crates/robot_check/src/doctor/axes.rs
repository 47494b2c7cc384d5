//! Checks for joint axes that are nearly equal to a coordinate axis of their frame.

use robot_model::diagnostic::significant;
use robot_model::diagnostic::{Diagnostic, code};

use super::facts::RobotFacts;

/// The maximum error of axes that programs write, relative to their length.
const NOISE: f64 = 1e-6;

pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    for link in &facts.links {
        let axis = &link.link.joint.axis;
        if !axis.iter().all(robot_symbolic::Formula::is_constant) {
            continue;
        }
        let components = axis.each_ref().map(|component| component.evaluate(|_| f64::NAN));
        let length = components.iter().fold(0.0_f64, |length, one| length.hypot(*one));
        let small = |one: &&f64| **one != 0.0 && one.abs() <= NOISE * length;
        let Some(least) = components.iter().find(small) else { continue };
        let place = link.place.axis.as_ref().unwrap_or(&link.place.joint);
        let message = format!(
            "the axis of `{}` is nearly aligned with an axis of its frame",
            link.link.joint.name
        );
        found.push(
            Diagnostic::warning(code::AXIS_NEAR, message)
                .at(place, format!("is {} noise?", significant(*least)))
                .because(
                    "noise gives the axis a general direction, with many more terms and operations",
                )
                .help("replace the noise with 0"),
        );
    }
}
