//! Checks for bodies that are too large for their links.

use nalgebra::Vector3;
use robot_model::diagnostic::significant;
use robot_model::diagnostic::{Diagnostic, code};

use super::facts::{BodyFacts, LinkFacts, RobotFacts};

/// The factor by which a body may exceed the size of its link. If the body extended from the link's origin to its end,
/// neither the distance of its center of mass nor its radius of gyration could exceed the size of the link. But motors
/// and housings overhang, and links are often longer than the frames on them indicate.
const TIMES: f64 = 3.0;

pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let reach = facts.reach();
    for link in &facts.links {
        for body in link.bodies.iter().filter(|body| body.is_in_units()) {
            if let Some(size) = too_wide(link, body) {
                found.push(wide(body, size));
            } else if let Some((distance, size)) = too_far(link, body, reach) {
                found.push(far(body, distance, size));
            }
        }
    }
}

/// The size of the link, if the body's radius of gyration is more than [`TIMES`] this size.
fn too_wide(link: &LinkFacts<'_>, body: &BodyFacts<'_>) -> Option<f64> {
    let size = link.size().max(body.center.norm());
    let is_wide = body.has_tensor() && size > 0.0 && body.gyration() > TIMES * size;
    is_wide.then_some(size)
}

/// The distance of the center of mass from the box around the origin and the points on the link, if it is too large,
/// and the size with which it is compared: the box's diagonal plus travel and radius of gyration or, if these are 0,
/// the robot's reach.
fn too_far(link: &LinkFacts<'_>, body: &BodyFacts<'_>, reach: f64) -> Option<(f64, f64)> {
    let (mut low, mut high) = (Vector3::zeros(), Vector3::zeros());
    for point in &link.points {
        (low, high) = (low.inf(point), high.sup(point));
    }
    let outside = body.center - body.center.sup(&low).inf(&high);
    let gyration = if body.has_tensor() { body.gyration() } else { 0.0 };
    let own = (high - low).norm() + link.travel + gyration;
    let size = if own > 0.0 { own } else { reach };
    let distance = outside.norm();
    (size > 0.0 && distance > TIMES * size).then_some((distance, size))
}

fn wide(body: &BodyFacts<'_>, size: f64) -> Diagnostic {
    let name = &body.body.name;
    let message = format!(
        "the radius of gyration of `{name}` is {} m, but the link is {} m long",
        significant(body.gyration()),
        significant(size)
    );
    Diagnostic::warning(code::TOO_WIDE, message)
        .at(body.of_tensor(), "fits a far larger body")
        .and_at(body.of_mass(), format!("{} kg", significant(body.mass)))
        .because(format!(
            "on average, the mass would lie more than {TIMES} times as far out as the link extends"
        ))
        .help(
            "check that mass and tensor are those of the same body, and that the tensor is about \
             the center of mass, in kg m^2",
        )
}

fn far(body: &BodyFacts<'_>, distance: f64, size: f64) -> Diagnostic {
    let name = &body.body.name;
    let message =
        format!("the center of mass of `{name}` lies {} m outside the link", significant(distance));
    let facts = if body.has_tensor() { "frames and inertia" } else { "frames" };
    Diagnostic::warning(code::CENTER_FAR, message)
        .at(body.of_center(), "in the link frame?")
        .because(format!(
            "judging by its {facts}, the size of the link is {} m, and a link's center of \
             mass is normally near its joint",
            significant(size)
        ))
        .help("give it in m and in the link frame, not in that of the base or of a drawing")
}
