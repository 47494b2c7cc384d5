//! Checks for tensors about the origin of the link's frame that are stated to be about the center of mass.

use nalgebra::{Matrix3, Vector3};
use robot_model::diagnostic::significant;
use robot_model::diagnostic::{Diagnostic, code};
use robot_model::physics::{Verdict, judge};

use super::facts::{BodyFacts, LinkFacts, RobotFacts};

/// The two ends of a body are known only if the farthest point on the link exceeds the distance of the center of mass
/// by this factor, or if there is no other point on the link.
const BETWEEN: f64 = 1.2;

pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    for link in &facts.links {
        let [body] = link.bodies.as_slice() else { continue };
        if let Some(spread) = about_origin(link, body) {
            found.push(suspicion(body, spread));
        }
    }
}

/// The standard deviation of the mass along the line from the origin to the center of mass, and the largest value that
/// it can have, m. `None` unless it exceeds this value and would not exceed it if the tensor were about the origin.
///
/// For a mass between the points a and b of a line, with its center of mass at c, the variance is at most (c − a)(b −
/// c) (Bhatia and Davis 2000). The body is assumed to extend from the link's origin to the farthest point on the link,
/// and beyond both by the radius of the cylinder that has the body's moment about the line. With a tensor about the
/// origin, the variance appears to be larger by c²: that of a rod from the origin to 2c is c²/3, but appears to be
/// 4c²/3, while the maximum is c².
fn about_origin(link: &LinkFacts<'_>, body: &BodyFacts<'_>) -> Option<[f64; 2]> {
    let distance = body.center.norm();
    let far = body.center.amax() > 0.0 && body.has_tensor() && body.is_in_units();
    let direction = body.center.try_normalize(0.0).filter(|_| far)?;
    let along = |point: &Vector3<f64>| point.dot(&direction);
    let reach = link.points.iter().map(along).fold(0.0, f64::max);
    let is_end = link.points.iter().all(|point| point.norm() == 0.0);
    if !is_end && reach < BETWEEN * distance {
        return None;
    }
    let end = reach.max(2.0 * distance) + link.travel;
    let variance = variance(&body.tensor, body.mass, &direction);
    let axial = (body.tensor * direction).dot(&direction).max(0.0);
    let radius = (2.0 * axial / body.mass).sqrt();
    let most = (distance + radius) * (end + radius - distance);
    let steiner =
        Matrix3::identity() * body.center.norm_squared() - body.center * body.center.transpose();
    let shifted = body.tensor - steiner * body.mass;
    let fits = self::variance(&shifted, body.mass, &direction) <= most;
    (variance > most && fits && is_possible(&shifted)).then(|| [variance.sqrt(), most.sqrt()])
}

/// The variance ∫x² dm / m along a direction: half the trace minus the moment about the direction, divided by the mass.
fn variance(tensor: &Matrix3<f64>, mass: f64, direction: &Vector3<f64>) -> f64 {
    (tensor.trace() / 2.0 - (tensor * direction).dot(direction)) / mass
}

fn is_possible(tensor: &Matrix3<f64>) -> bool {
    let entry = |row: usize, column: usize| tensor[(row, column)];
    let entries = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)];
    judge(entries) == Verdict::Possible
}

fn suspicion(body: &BodyFacts<'_>, [spread, most]: [f64; 2]) -> Diagnostic {
    let name = &body.body.name;
    let message = format!("the inertia of `{name}` appears to be about the frame's origin");
    Diagnostic::warning(code::ABOUT_ORIGIN, message)
        .at(body.of_tensor(), "about the center of mass?")
        .and_at(body.of_center(), format!("{} m away", significant(body.center.norm())))
        .because(format!(
            "the positions of the mass along the link would have a standard deviation of {} m, but \
             mass between the ends of the link allows at most {} m; a tensor about the frame's \
             origin would fit",
            significant(spread),
            significant(most)
        ))
        .help(
            "give the tensor about the center of mass, or, in a robot file, write \
             `about = \"origin\"`",
        )
}
