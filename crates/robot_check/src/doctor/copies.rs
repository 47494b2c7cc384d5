//! Checks for the same inertia on several links.

use robot_model::diagnostic::{Diagnostic, code};

use super::facts::{BodyFacts, RobotFacts};

/// The number of equal tensors that is suspicious: two modules of an arm may well be equal, but three rarely are.
const ALIKE: usize = 3;
/// The tolerance for equal masses. Tensors that are proportional to the mass differ if the masses differ by more than
/// rounding.
const SAME_MASS: f64 = 0.01;
/// The maximum number of places that are shown.
const MAX_SHOWN: usize = 8;

/// Only tensors that consist of numbers are compared: a parameter on several links states that they are meant to be
/// equal.
pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let bodies = facts.links.iter().flat_map(|link| &link.bodies);
    let bodies: Vec<&BodyFacts<'_>> = bodies
        .filter(|body| {
            let entries = &body.body.inertia.entries();
            body.has_tensor() && entries.iter().all(|entry| entry.is_constant())
        })
        .collect();
    let mut seen = vec![false; bodies.len()];
    for first in 0..bodies.len() {
        let Some(body) = bodies.get(first).filter(|_| seen.get(first) == Some(&false)) else {
            continue;
        };
        let mut group = Vec::new();
        for (slot, other) in seen.iter_mut().zip(&bodies).skip(first) {
            if other.body.inertia == body.body.inertia {
                *slot = true;
                group.push(*other);
            }
        }
        let differs =
            |other: &&BodyFacts<'_>| (other.mass - body.mass).abs() > SAME_MASS * body.mass;
        if group.len() >= ALIKE || group.iter().any(differs) {
            found.push(copied(&group));
        }
    }
}

fn copied(group: &[&BodyFacts<'_>]) -> Diagnostic {
    let names: Vec<String> =
        group.iter().take(MAX_SHOWN).map(|body| format!("`{}`", body.body.name)).collect();
    let more = match group.len().saturating_sub(MAX_SHOWN) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let message = format!("several links have the same inertia: {}{more}", names.join(", "));
    let mut diagnostic = Diagnostic::warning(code::COPIED, message);
    for (index, body) in group.iter().take(MAX_SHOWN).enumerate() {
        diagnostic = match index {
            0 => diagnostic.at(body.of_tensor(), "here"),
            _ => diagnostic.and_at(body.of_tensor(), "and here"),
        };
    }
    diagnostic.because("identical links are rare; copied values are not").help(
        "give each link its own values; if the links are identical, make the values \
             parameters in a robot file, shared by all of them",
    )
}
