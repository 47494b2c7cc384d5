//! Masses and inertias: which values no body can have, and whether they are errors or warnings.
//!
//! A file that was not written for this program cannot state that an impossible value is intended. Impossible values
//! are errors nevertheless, with three exceptions that published values require:
//!
//! - moments of inertia of a massless body that is fixed to a moving link cause a warning;
//! - principal moments that violate the triangle inequality by at most [`PUBLISHED`] of the largest moment cause a
//!   warning, because measured moments often do;
//! - a massless link with a moment of inertia only about its joint axis causes a warning if its joint is on the base
//!   and the axis is vertical, because no other property of the link has an effect.

use robot_symbolic::Formula;

use super::super::draft::{Draft, DraftLink, Parent};
use super::super::options::Options;
use super::super::reader::Reader;
use super::link::{Inertial, UrdfLink};
use crate::diagnostic::significant;
use crate::diagnostic::{Diagnostic, Severity, Span, code};
use crate::physics::{Verdict, judge};
use crate::robot::{Axis, JointKind, Move, Placement};
use crate::space::{
    IDENTITY, Matrix, Vector, apply, cross, direction, dot, product, rotation_about, transpose,
};

/// The fraction of the largest moment by which measured moments may violate the triangle inequality.
const PUBLISHED: f64 = 0.1;

/// Adds the bodies to the links of the draft and reports errors in them. `sources` contains the link of the file for
/// each link of the draft.
pub(super) fn add(
    reader: &mut Reader<'_>,
    draft: &mut Draft,
    order: &[usize],
    sources: &[&UrdfLink<'_>],
    options: &Options,
) {
    let mut carriers: Vec<Option<usize>> = vec![None; draft.links.len()];
    // Whether a body with mass or inertia moves with each link.
    let mut moved = vec![false; draft.links.len()];
    for index in order {
        let (Some(link), Some(source)) = (draft.links.get(*index), sources.get(*index)) else {
            continue;
        };
        let carrier = match (link.joint.kind, &link.parent) {
            (Some(_), _) => Some(*index),
            (None, Parent::Link(parent)) => carriers.get(*parent).copied().flatten(),
            (None, _) => None,
        };
        if let Some(slot) = carriers.get_mut(*index) {
            *slot = carrier;
        }
        let Some(inertial) = &source.inertial else { continue };
        if let Some(carrier) = carrier {
            let own = carrier == *index;
            let vertical = if own { vertical_axis(draft, *index) } else { None };
            judge_body(reader, inertial, own, vertical, options);
            if let Some(slot) = moved.get_mut(carrier) {
                *slot |= !inertial.is_empty();
            }
        }
        if let Some(link) = draft.links.get_mut(*index).filter(|_| !inertial.is_empty()) {
            link.body = Some((inertial.body.clone(), inertial.place.clone()));
        }
    }
    for index in order {
        let (Some(link), Some(source)) = (draft.links.get(*index), sources.get(*index)) else {
            continue;
        };
        let missing = link.joint.kind.is_some() && !moved.get(*index).copied().unwrap_or(true);
        if missing && !source.has_errors {
            reader.report(massless(source, options));
        }
    }
}

/// The error for a moving link that has no mass to move.
fn massless(link: &UrdfLink<'_>, options: &Options) -> Diagnostic {
    let name = &link.name.named.name;
    let (place, label): (&Span, _) = match &link.inertial {
        Some(Inertial { place, .. }) => {
            (place.mass.as_ref().unwrap_or(&place.name), "the mass is 0")
        }
        None => (&link.tag, "`<inertial>` is missing"),
    };
    let mut diagnostic = Diagnostic::error(code::MASS, format!("the link `{name}` has no mass"))
        .at(place, label)
        .because("a massless link silently drops out of the equations")
        .help(
            "add its `<inertial>`; if the link is massless, read the file with the option \
             `allow_massless`",
        );
    if options.allow_massless {
        diagnostic.severity = Severity::Warning;
        diagnostic.help = None;
    }
    diagnostic
}

fn negative_mass(mass: f64) -> Diagnostic {
    Diagnostic::error(code::MASS, format!("the mass is {mass} kg"))
        .because("the mass of a body is positive; otherwise the mass matrix may not be positive definite")
        .help("correct the value")
}

/// Reports values that no body can have. `own` is whether the body belongs to the moving link itself rather than to a
/// link fixed to it. `vertical` is the joint axis if only the moment of inertia about it has an effect.
fn judge_body(
    reader: &mut Reader<'_>,
    inertial: &Inertial,
    own: bool,
    vertical: Option<Vector>,
    options: &Options,
) {
    let of_mass = inertial.place.mass.clone().unwrap_or_default();
    let of_tensor = inertial.place.inertia.clone().unwrap_or_default();
    if inertial.mass < 0.0 {
        reader.report(negative_mass(inertial.mass).at(&of_mass, "below 0"));
    }
    if inertial.mass == 0.0 && !inertial.is_empty() {
        let moment = vertical.and_then(|axis| alone_about(inertial, &axis));
        if let Some(moment) = moment {
            reader.report(alone_acts(&of_mass, moment));
            return;
        }
        let mut diagnostic =
            Diagnostic::error(code::MASS, "a body of mass 0 has moments of inertia")
                .at(&of_mass, "the mass is 0")
                .because("a moment of inertia is a sum of mass times distance squared");
        let is_warning = options.allow_massless || !own;
        if is_warning {
            diagnostic.severity = Severity::Warning;
        }
        reader.report(diagnostic.help(match is_warning {
            true => "correct the mass, or remove the moments of inertia",
            false => "correct the mass, or read the file with the option `allow_massless`",
        }));
    }
    let verdict = judge(inertial.tensor);
    let mut diagnostic = Diagnostic::error(verdict.code(), verdict.message());
    let excess = match verdict {
        Verdict::Possible => return,
        Verdict::Negative(_) => {
            diagnostic = diagnostic
                .because("a moment of inertia is a sum of mass times distance squared, so it is never negative")
                .help(
                    "check the signs of the products of inertia (entries of the tensor) and \
                    that all values are in kg m^2",
                );
            f64::INFINITY
        }
        Verdict::Triangle(_, excess) => {
            diagnostic = diagnostic.because(format!(
                "x² + y² ≤ (y² + z²) + (z² + x²) for every point of a body; here the inequality \
                 is violated by {} % of the largest moment, while measured and rounded values \
                 violate it by less than {} %",
                significant((excess * 1000.0).round() / 10.0),
                PUBLISHED * 100.0
            ));
            diagnostic = diagnostic.help(match options.allow_unphysical || excess <= PUBLISHED {
                true => "correct the values, unless they are published this way",
                false => {
                    "correct the values; if they are published this way, read the file with the \
                     option `allow_unphysical`"
                }
            });
            excess
        }
    };
    if options.allow_unphysical || excess <= PUBLISHED {
        diagnostic.severity = Severity::Warning;
    }
    reader.report(diagnostic.at(&of_tensor, verdict.label()));
}

fn alone_acts(of_mass: &Span, moment: f64) -> Diagnostic {
    Diagnostic::warning(code::MASS, "a moving link has mass 0")
        .at(of_mass, "the mass is 0")
        .because(format!(
            "the joint is on the base and its axis is vertical, so only the link's moment of \
             inertia about the axis has an effect; it is {} kg m^2",
            significant(moment)
        ))
        .help(
            "add the mass and the other moments if they are known: the forces in the joint \
            depend on them",
        )
}

/// The joint axis of a link in the link's frame, if the joint is revolute, on the base, and parallel to gravity.
fn vertical_axis(draft: &Draft, index: usize) -> Option<Vector> {
    let link = draft.links.get(index)?;
    match link.joint.kind {
        Some(JointKind::Revolute) => {}
        Some(JointKind::Prismatic) | None => return None,
    }
    let mut rotation = rotation(&link.before);
    let mut below: &DraftLink = link;
    // Follows the fixed links between the joint and the base. The loop is bounded, because a link has fewer ancestors
    // than there are links.
    for _ in 0..draft.links.len() {
        let Parent::Link(parent) = below.parent else { break };
        below = draft.links.get(parent)?;
        if below.joint.kind.is_some() {
            return None;
        }
        rotation = product(&self::rotation(&below.before), &rotation);
    }
    let axis = direction(&vector(&link.joint.axis));
    let gravity = vector(&draft.gravity);
    if gravity == [0.0; 3] {
        return None;
    }
    let across = cross(&apply(&rotation, &axis), &direction(&gravity));
    let is_vertical = dot(&across, &across).sqrt() < 1e-6;
    is_vertical.then_some(axis)
}

/// The moment of inertia about the axis, if all other entries of the tensor are 0.
fn alone_about(inertial: &Inertial, axis: &Vector) -> Option<f64> {
    let [xx, yy, zz, xy, xz, yz] = inertial.tensor;
    let turn = rotation(&inertial.body.placement);
    let own = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let tensor = product(&turn, &product(&own, &transpose(&turn)));
    let moment = dot(axis, &apply(&tensor, axis));
    let mut rest = 0.0_f64;
    for (row, a) in tensor.iter().zip(axis) {
        for (entry, b) in row.iter().zip(axis) {
            rest = rest.hypot(entry - a * b * moment);
        }
    }
    (moment > 0.0 && rest <= 1e-6 * moment).then_some(moment)
}

fn vector(formulas: &[Formula; 3]) -> Vector {
    formulas.each_ref().map(|formula| formula.evaluate(|_| f64::NAN))
}

/// The rotation matrix of a placement without symbols.
fn rotation(placement: &Placement) -> Matrix {
    let turn = |step: &Move| match step {
        Move::Translate(_) => IDENTITY,
        Move::Rotate(axis, angle) => {
            let axis = match axis {
                Axis::X => 0,
                Axis::Y => 1,
                Axis::Z => 2,
            };
            rotation_about(axis, angle.evaluate(|_| f64::NAN))
        }
    };
    placement.0.iter().fold(IDENTITY, |rotation, step| product(&rotation, &turn(step)))
}
