//! Checks for values in units other than kg, m and s.

use std::f64::consts::PI;

use robot_model::diagnostic::significant;
use robot_model::diagnostic::{Diagnostic, Span, code};
use robot_model::robot::JointKind;

use super::facts::{BodyFacts, LinkFacts, RobotFacts};

/// The largest plausible radius of gyration, m. That of a rod of 10 m is 2.9 m; the largest industrial arms reach 5 m.
const WIDEST: f64 = 3.0;
/// The density of osmium, the densest material, kg/m³.
const DENSEST: f64 = 22_590.0;
/// The largest plausible length of a link of a robot on a fixed base, m; 20 mm that are read as m reach it.
const LONGEST: f64 = 20.0;
/// The largest plausible position of a prismatic joint, m; few cranes travel farther.
const FARTHEST: f64 = 100.0;
/// The largest plausible acceleration of gravity, m/s²; that of Jupiter is 24.8 m/s².
const HEAVIEST: f64 = 30.0;

/// The units in which CAD programs give moments of inertia, with their values in kg m².
const MOMENTS: &[(&str, f64)] =
    &[("g m^2", 1e-3), ("kg cm^2", 1e-4), ("kg mm^2", 1e-6), ("g cm^2", 1e-7), ("g mm^2", 1e-9)];

pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    for link in &facts.links {
        if let Some((distance, row)) = long_row(link) {
            found.push(long("the frame of", &link.link.name, distance, row));
        }
        let is_end_of_row = |parent: usize| facts.links.get(parent).and_then(long_row).is_some();
        if link.arm > LONGEST && !link.link.parent.is_some_and(is_end_of_row) {
            let place = link.place.origin.as_ref().unwrap_or(&link.place.name);
            found.push(long("the frame of", &link.link.name, link.arm, place));
        }
        found.extend(far(facts, link));
        for body in &link.bodies {
            let (name, distance) = (&body.body.name, body.center.norm());
            if distance > LONGEST && long_row(link).is_none() {
                found.push(long("the center of mass of", name, distance, body.of_center()));
            }
            if !body.has_tensor() {
                continue;
            }
            if body.gyration() > WIDEST {
                found.push(wide(body, link.size()));
            } else if density(body) > DENSEST {
                found.push(dense(body));
            }
        }
    }
    let gravity = facts.gravity.norm();
    if gravity > HEAVIEST {
        let place = facts.locations.gravity.as_ref().unwrap_or(&facts.locations.name);
        let message = format!("gravity is {} m/s^2", significant(gravity));
        found.push(
            Diagnostic::warning(code::UNITS, message)
                .at(place, "in mm/s^2 or cm/s^2?")
                .because("on Earth it is 9.81 m/s^2, on Jupiter 24.8")
                .help("give it in m/s^2"),
        );
    }
}

/// The length and the place of a standard Denavit-Hartenberg row that is too long. It also moves the center of mass of
/// its link and the frames of the links that follow.
fn long_row<'d>(link: &LinkFacts<'d>) -> Option<(f64, &'d Span)> {
    link.end.filter(|(distance, _)| *distance > LONGEST)
}

/// The warning about the limits of a prismatic joint.
fn far(facts: &RobotFacts<'_>, link: &LinkFacts<'_>) -> Option<Diagnostic> {
    let limit = link.farthest_limit(facts.robot, JointKind::Prismatic);
    let (farthest, place) = limit.filter(|(farthest, _)| *farthest > FARTHEST)?;
    let message = format!("a limit of `{}` is {} m", link.link.joint.name, significant(farthest));
    Some(
        Diagnostic::warning(code::UNITS, message)
            .at(place, "in mm, or in degrees?")
            .because("the joint is prismatic, and few machines travel as far")
            .help("give the limits in m; leave out `limits` if the joint has none"),
    )
}

/// Whether one of the values of a body is reported by this module.
pub(super) fn is_suspect(body: &BodyFacts<'_>) -> bool {
    let of_tensor = body.gyration() > WIDEST || density(body) > DENSEST;
    body.center.norm() > LONGEST || (body.has_tensor() && of_tensor)
}

/// The density, kg/m³, that some part of the body must have at least. Of all bodies with a given mass and maximum
/// density, the ball has the smallest ∫r² dm, 3/5 m R², so R is at most √(5/3) times the radius of gyration.
fn density(body: &BodyFacts<'_>) -> f64 {
    let radius = (5.0_f64 / 3.0).sqrt() * body.gyration();
    body.mass / (4.0 / 3.0 * PI * radius.powi(3))
}

fn long(what: &str, name: &str, distance: f64, place: &Span) -> Diagnostic {
    let message = format!("{what} `{name}` is {} m away", significant(distance));
    Diagnostic::warning(code::UNITS, message)
        .at(place, "in mm?")
        .because(format!("few arms have a link longer than {LONGEST} m"))
        .help("give lengths in m")
}

fn wide(body: &BodyFacts<'_>, size: f64) -> Diagnostic {
    let name = &body.body.name;
    let gyration = body.gyration();
    // The unit for which the radius of gyration is closest to half the size of the link.
    let expected = if size > 0.0 { size.min(1.0) / 2.0 } else { 0.1 };
    let miss = |factor: f64| (gyration * factor.sqrt() / expected).ln().abs();
    let unit = MOMENTS.iter().min_by(|a, b| miss(a.1).total_cmp(&miss(b.1)));
    let (unit, factor) = unit.copied().unwrap_or(("kg mm^2", 1e-6));
    let message = format!("the radius of gyration of `{name}` is {} m", significant(gyration));
    Diagnostic::warning(code::UNITS, message)
        .at(body.of_tensor(), format!("in {unit}?"))
        .and_at(body.of_mass(), format!("{} kg", significant(body.mass)))
        .because(
            "this is the root-mean-square distance of the mass from the center of mass; for a rod \
             of 10 m it is 2.9 m",
        )
        .help(format!("give moments of inertia in kg m^2: multiply values in {unit} by {factor:e}"))
}

fn dense(body: &BodyFacts<'_>) -> Diagnostic {
    let name = &body.body.name;
    let message = format!(
        "`{name}` is too small for its mass: {} kg with a radius of gyration of {} m",
        significant(body.mass),
        significant(body.gyration())
    );
    Diagnostic::warning(code::UNITS, message)
        .at(body.of_mass(), "in g?")
        .and_at(body.of_tensor(), "in units other than kg m^2, or a placeholder?")
        .because(format!(
            "parts of it would be denser than {} kg/m^3; osmium, the densest element, has {DENSEST} kg/m^3",
            significant(density(body))
        ))
        .help("give the mass in kg, and the tensor about the center of mass in kg m^2")
}

#[cfg(test)]
mod tests {
    use robot_model::diagnostic::code;

    use crate::doctor::{Options, check};

    /// Each row of a table in mm is reported, and nothing else.
    #[test]
    fn rows_in_mm_are_reported_where_they_are() {
        let rows = ["{ d = 0.29, alpha = \"-pi/2\" }", "{ a = 0.27 }", "{ a = 0.07, d = 0.1 }"];
        let links: String = (1..=3)
            .map(|number| {
                format!(
                    "[[link]]\nname = \"{number}\"\nmass = 3\ncenter_of_mass = [0.01, 0, 0.02]\n\
                     inertia = {{ xx = 0.02, yy = 0.03, zz = 0.02 }}\n"
                )
            })
            .collect();
        for (convention, index, long) in [
            ("standard", 0, "{ d = 290, alpha = \"-pi/2\" }"),
            ("standard", 1, "{ a = 270 }"),
            ("standard", 2, "{ a = 70, d = 100 }"),
            ("modified", 0, "{ d = 290, alpha = \"-pi/2\" }"),
            ("modified", 2, "{ a = 70, d = 100 }"),
        ] {
            let mut rows = rows;
            rows[index] = long;
            let text = format!(
                "format = 1\n[robot]\nname = \"arm\"\n[dh]\nconvention = \"{convention}\"\nrows = [{}]\n{links}",
                rows.join(", ")
            );
            let found = check("arm.toml", &text, &Options::default()).found;
            let found = found.iter().filter(|one| one.code == code::UNITS);
            let places = found.filter_map(|one| Some(&text[one.primary.as_ref()?.span.clone()]));
            let places: Vec<&str> = places.collect();
            assert_eq!(places, [long], "{convention}");
        }
    }
}
