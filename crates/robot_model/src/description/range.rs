//! Checks for values that are too large or too small to compute with.
//!
//! Torques are products of masses, squared lengths and other values. Beyond these bounds such products could overflow
//! or underflow, and the values would be meaningless for a robot.

use robot_symbolic::Formula;

use super::locations::{BodyLocation, LinkLocation, Locations};
use super::reader::Reader;
use crate::diagnostic::significant;
use crate::diagnostic::{Diagnostic, Span, code};
use crate::robot::{Body, Drive, Friction, Joint, JointKind, Link, Move, Placement, Robot};

/// The largest magnitude of a value in SI units; for comparison, the mass of the Sun is 2e30 kg.
pub const LARGEST: f64 = 1e30;
/// The smallest magnitude of a mass, kg, of a component of a translation, m, of the largest entry of a tensor, kg m²,
/// and of every other divisor, in SI units.
pub const LEAST: f64 = 1e-100;
/// The largest magnitude of an angle, rad: larger angles have fewer than ten significant digits within a turn.
const ANGLE: f64 = 1e6;

/// Reports all values that are out of range at the nominal values of the parameters.
pub(super) fn check(reader: &mut Reader<'_>, robot: &Robot, locations: &Locations) {
    let mut range = Range { reader };
    let of_gravity = locations.gravity.as_ref().unwrap_or(&locations.name);
    range.all(&robot.gravity, "gravity", of_gravity);
    for (link, place) in robot.links.iter().zip(&locations.links) {
        range.link(link, place);
        // A joint that mimics another has no limits of its own.
        let own = robot.coordinates.iter().find(|one| one.joint == link.joint.name);
        if let Some(limits) = own.and_then(|one| one.limits.as_ref()) {
            let limits = limits.each_ref().map(Formula::number);
            let at = place.limits.as_ref().unwrap_or(&place.joint);
            range.all(&limits, &format!("a limit of `{}`", link.joint.name), at);
        }
    }
    for (frame, place) in robot.frames.iter().zip(&locations.frames) {
        let at = place.origin.as_ref().unwrap_or(&place.name);
        let pose = format!("the pose of `{}`", frame.name);
        range.placement(&frame.placement, (&pose, at), (&pose, at));
    }
}

struct Range<'r, 'a> {
    reader: &'r mut Reader<'a>,
}

impl Range<'_, '_> {
    fn link(&mut self, link: &Link, place: &LinkLocation) {
        let at = place.origin.as_ref().unwrap_or(&place.name);
        let pose = format!("the pose of `{}`", link.name);
        self.placement(&link.placement, (&pose, at), (&pose, at));
        self.joint(&link.joint, place);
        let of_friction = place.friction.as_ref().unwrap_or(&place.joint);
        self.friction(&link.friction, &link.joint.name, of_friction);
        let Drive { armature, rotor_inertia, gear_ratio, .. } = &link.drive;
        let of_drive = place.drive.as_ref().unwrap_or(&place.joint);
        let what = format!("the drive of `{}`", link.joint.name);
        self.all([armature, rotor_inertia, gear_ratio], &what, of_drive);
        for (body, place) in link.bodies.iter().zip(&place.bodies) {
            self.body(body, place);
        }
    }

    fn joint(&mut self, joint: &Joint, place: &LinkLocation) {
        let at = place.axis.as_ref().unwrap_or(&place.joint);
        self.axis(&joint.axis, &joint.name, at);
        let what = format!("the ratio of `{}`", joint.name);
        self.all([&joint.ratio], &what, &place.joint);
        self.divisor([&joint.ratio], &what, &place.joint);
        let what = format!("the offset of `{}`", joint.name);
        match joint.kind {
            JointKind::Revolute => self.angle(&joint.offset, &what, &place.joint),
            JointKind::Prismatic => self.all([&joint.offset], &what, &place.joint),
        }
    }

    /// Checks the magnitudes of the components of an axis. An axis of exact numbers may have any length. An axis of
    /// expressions is normalized at run time, so the square of its length must be in range. No axis may have a
    /// component that is negligible compared with the others.
    fn axis(&mut self, axis: &[Formula; 3], joint: &str, at: &Span) {
        let known = axis.each_ref().map(|component| self.reader.known(component));
        let [Some(x), Some(y), Some(z)] = known.map(|known| known.map(f64::abs)) else { return };
        let largest = x.max(y).max(z);
        let is_exact =
            axis.iter().all(|one| one.as_number().is_some_and(|n| n.as_rational().is_some()));
        if !is_exact && !(LEAST..=1.0 / LEAST).contains(&largest) {
            let message =
                format!("the axis of `{joint}` has a component of {}", significant(largest));
            self.reader.report(
                Diagnostic::error(code::NUMBER, message)
                    .at(at, "the square of an axis's length may overflow or underflow")
                    .help("give a direction with a length near 1"),
            );
        }
        let hidden = [x, y, z].into_iter().find(|one| *one != 0.0 && one / largest < LEAST);
        if let Some(hidden) = hidden {
            let message = format!(
                "the axis of `{joint}` has components of {} and {}",
                significant(hidden),
                significant(largest)
            );
            self.reader.report(
                Diagnostic::error(code::NUMBER, message)
                    .at(at, "the smaller one is lost to rounding")
                    .help("replace the negligible component with 0"),
            );
        }
    }

    fn friction(&mut self, friction: &Friction, joint: &str, at: &Span) {
        let what = format!("the friction of `{joint}`");
        let Friction { viscous, coulomb, spindle_diameter, offset, .. } = friction;
        let Friction { coulomb_positive, coulomb_negative, smoothing, .. } = friction;
        let formulas =
            [viscous, coulomb, spindle_diameter, offset, coulomb_positive, coulomb_negative];
        self.all(formulas.into_iter().chain(smoothing), &what, at);
        self.divisor(smoothing, &what, at);
    }

    fn body(&mut self, body: &Body, place: &BodyLocation) {
        let BodyLocation { name, mass, center_of_mass, inertia, axes, .. } = place;
        let of_mass = mass.as_ref().unwrap_or(name);
        let what = format!("the mass of `{}`", body.name);
        self.all([&body.mass], &what, of_mass);
        self.divisor([&body.mass], &what, of_mass);
        let what = format!("the center of mass of `{}`", body.name);
        let of_center = center_of_mass.as_ref().unwrap_or(name);
        let of_inertia = inertia.as_ref().unwrap_or(name);
        let inertia = format!("the inertia of `{}`", body.name);
        let of_axes = axes.as_ref().unwrap_or(of_inertia);
        self.placement(&body.placement, (&what, of_center), (&inertia, of_axes));
        self.all(body.inertia.entries(), &inertia, of_inertia);
        self.divisor(body.inertia.entries(), &inertia, of_inertia);
    }

    /// Checks a placement; its translations and its rotations each have their words and their place.
    fn placement(
        &mut self,
        Placement(moves): &Placement,
        translation: (&str, &Span),
        rotation: (&str, &Span),
    ) {
        for step in moves {
            match step {
                Move::Translate(by) => {
                    self.all(by, translation.0, translation.1);
                    for component in by {
                        self.divisor([component], translation.0, translation.1);
                    }
                }
                Move::Rotate(_, angle) => self.angle(angle, rotation.0, rotation.1),
            }
        }
    }

    /// Reports an angle that is too large.
    fn angle(&mut self, angle: &Formula, what: &str, at: &Span) {
        let known = self.reader.known(angle).filter(|angle| angle.abs() > ANGLE);
        if let Some(angle) = known {
            let message = format!("{what} contains an angle of {} rad", beyond(angle, ANGLE));
            self.reader.report(
                Diagnostic::error(code::NUMBER, message)
                    .at(at, format!("angles may be at most {ANGLE:e} rad"))
                    .because("for larger angles, rounding leaves too few digits within a turn")
                    .help("give the angle within one turn"),
            );
        }
    }

    /// Reports the first value that is too large.
    fn all<'f>(&mut self, formulas: impl IntoIterator<Item = &'f Formula>, what: &str, at: &Span) {
        let known = formulas.into_iter().filter_map(|formula| self.reader.known(formula));
        let diagnostic = known.into_iter().find_map(|value| too_large(what, value, at));
        if let Some(diagnostic) = diagnostic {
            self.reader.report(diagnostic);
        }
    }

    /// Reports values if the largest of them is too small for a divisor or for the square of a length.
    fn divisor<'f>(
        &mut self,
        formulas: impl IntoIterator<Item = &'f Formula>,
        what: &str,
        at: &Span,
    ) {
        let known: Option<Vec<f64>> =
            formulas.into_iter().map(|formula| self.reader.known(formula)).collect();
        let largest =
            known.into_iter().flatten().max_by(|one, other| one.abs().total_cmp(&other.abs()));
        if let Some(diagnostic) = largest.and_then(|largest| too_small(what, largest, at)) {
            self.reader.report(diagnostic);
        }
    }
}

/// A value in a message, with all digits if it would otherwise be printed like the limit that it exceeds.
fn beyond(value: f64, limit: f64) -> String {
    let shown = significant(value);
    if significant(value.abs()) == significant(limit) { format!("{value:e}") } else { shown }
}

/// The message about a number that is too large; `None` if it is in range.
pub(super) fn too_large(what: &str, value: f64, at: &Span) -> Option<Diagnostic> {
    let message = || format!("{what} contains a value of {}", beyond(value, LARGEST));
    (value.abs() > LARGEST).then(|| {
        Diagnostic::error(code::NUMBER, message())
            .at(at, format!("magnitudes may be at most {LARGEST:e}"))
            .because("products of larger values can be outside the range of floating-point numbers")
            .help("give the value in SI units")
    })
}

/// The message about a number that is too small; `None` if it is 0 or in range.
pub(super) fn too_small(what: &str, value: f64, at: &Span) -> Option<Diagnostic> {
    let message = || format!("{what} contains a value of {}", beyond(value, LEAST));
    (value != 0.0 && value.abs() < LEAST).then(|| {
        Diagnostic::error(code::NUMBER, message())
            .at(at, format!("magnitudes must be 0 or at least {LEAST:e}"))
            .because(
                "products and quotients of values with smaller magnitudes can be outside the range of \
                 floating-point numbers",
            )
            .help("give the value in SI units, or 0 if it may be 0")
    })
}
