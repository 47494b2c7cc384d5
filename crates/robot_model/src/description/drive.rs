//! Friction and drive of a joint.

use robot_symbolic::Formula;
use toml::de::DeValue;

use super::joint::by_kind;
use super::reader::Reader;
use super::shape::{DRIVE, FRICTION};
use super::table::{Entry, Table};
use super::value::{Quantity, quantity};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::robot::{Drive, Friction, JointKind};

/// The admissible signs of a value.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sign {
    Any,
    NotNegative,
    Positive,
    NotZero,
}

/// The entries of one table that is being read.
struct Entries<'r, 'f, 'a> {
    reader: &'r mut Reader<'f>,
    table: Table<'a>,
}

impl Entries<'_, '_, '_> {
    /// Stores the value of a key in `target` if the file has the key; returns the place of the key.
    fn read(
        &mut self,
        key: &'static str,
        target: &mut Formula,
        what: Quantity,
        sign: Sign,
    ) -> Option<Span> {
        let entry = self.table.get(key)?;
        *target = self.reader.formula(entry.value, what);
        let Some(value) = self.reader.known(target) else {
            return Some(entry.key);
        };
        let (wrong, must) = match sign {
            Sign::Any => (false, ""),
            Sign::NotNegative => (value < 0.0, "must not be negative"),
            Sign::Positive => (value <= 0.0, "must be positive"),
            Sign::NotZero => (value == 0.0, "must not be 0"),
        };
        if wrong {
            let message = format!("{} is {value}", what.what);
            self.reader.report(
                Diagnostic::error(code::FRICTION, message)
                    .at(&entry.value.span(), must)
                    .help("correct the value, or leave out the key if no other key needs it"),
            );
        }
        Some(entry.key)
    }

    fn conflict(&mut self, span: &Span, message: &str, help: &str) {
        let diagnostic = Diagnostic::error(code::CONFLICT, message);
        self.reader.report(diagnostic.at(span, "").help(help));
    }
}

/// The keys that give a joint dry friction.
const KEYS_OF_DRY_FRICTION: [&str; 5] =
    ["coulomb", "coulomb_positive", "coulomb_negative", "coulomb_torque", "coulomb_force"];

/// Reports a table without keys, which has no effect.
fn check_not_empty(entries: &mut Entries<'_, '_, '_>, entry: &Entry<'_>, name: &str) {
    if matches!(entry.value.get_ref(), DeValue::Table(table) if table.is_empty()) {
        let message = format!("`{name}` is empty");
        entries.conflict(&entry.key, &message, "add a key, or remove the table");
    }
}

/// Reads `friction`.
pub(super) fn friction(reader: &mut Reader<'_>, entry: &Entry<'_>, kind: JointKind) -> Friction {
    use Sign::{Any, NotNegative, Positive};
    let mut friction = Friction::none();
    let Some(table) = reader.table(entry.value, &FRICTION) else {
        return friction;
    };
    let mut entries = Entries { reader, table };
    check_not_empty(&mut entries, entry, "friction");
    let is_dry = KEYS_OF_DRY_FRICTION.iter().any(|key| entries.table.has(key));
    let force = |what| by_kind(what, kind, (1, 2, -2), (1, 1, -2));
    let viscous = by_kind("the viscous friction coefficient", kind, (1, 2, -1), (1, 0, -1));
    entries.read("viscous", &mut friction.viscous, viscous, NotNegative);
    let coulomb = quantity("the Coulomb friction coefficient", 0, 0, 0);
    let coulomb = entries.read("coulomb", &mut friction.coulomb, coulomb, NotNegative);
    let diameter = quantity("the journal diameter", 0, 1, 0);
    let diameter =
        entries.read("spindle_diameter", &mut friction.spindle_diameter, diameter, Positive);
    spindle(&mut entries, kind, coulomb, diameter);
    let what = force("the Coulomb friction");
    let positive =
        entries.read("coulomb_positive", &mut friction.coulomb_positive, what, NotNegative);
    let negative =
        entries.read("coulomb_negative", &mut friction.coulomb_negative, what, NotNegative);
    let (symmetric, other, joint) = match kind {
        JointKind::Revolute => ("coulomb_torque", "coulomb_force", "revolute"),
        JointKind::Prismatic => ("coulomb_force", "coulomb_torque", "prismatic"),
    };
    let mut both = Friction::none().coulomb_positive;
    if let Some(span) = entries.read(symmetric, &mut both, what, NotNegative) {
        if positive.or(negative).is_some() {
            let message = format!("`{symmetric}` already sets both directions");
            let help = format!("keep `{symmetric}`, or the two directions");
            entries.conflict(&span, &message, &help);
        }
        friction.coulomb_positive = both.clone();
        friction.coulomb_negative = both;
    } else if positive.is_some() != negative.is_some() {
        let message = "Coulomb friction is given for one direction only";
        let help = format!("give the other direction too, or use `{symmetric}` for both");
        entries.conflict(&positive.or(negative).unwrap_or_default(), message, &help);
    }
    if let Some(entry) = entries.table.get(other) {
        let message = format!("`{other}` does not apply to a {joint} joint");
        entries.conflict(&entry.key, &message, &format!("write `{symmetric}`"));
    }
    entries.read("offset", &mut friction.offset, force("the friction offset"), Any);
    let width = by_kind("the smoothing width", kind, (0, 0, -1), (0, 1, -1));
    let mut smoothing = Friction::none().offset;
    let smooth = entries.read("smoothing", &mut smoothing, width, Positive);
    friction.smoothing = smooth.clone().map(|_| smoothing);
    if let Some(span) = smooth.filter(|_| !is_dry) {
        let message = "`smoothing` has no effect without Coulomb friction";
        let help = format!("add `{symmetric}`, or remove `smoothing`");
        entries.conflict(&span, message, &help);
    }
    entries.table.finish(entries.reader);
    friction
}

/// Checks that the keys of equation (5) occur together: dry friction of a revolute joint acts at the surface of the
/// journal.
fn spindle(
    entries: &mut Entries<'_, '_, '_>,
    kind: JointKind,
    coulomb: Option<Span>,
    diameter: Option<Span>,
) {
    match (kind, coulomb, diameter) {
        (JointKind::Revolute, Some(span), None) => entries.conflict(
            &span,
            "`coulomb` of a revolute joint needs `spindle_diameter`",
            "add `spindle_diameter`, the journal diameter in m; for a friction torque that does \
             not depend on the contact force, use `coulomb_torque`",
        ),
        (JointKind::Revolute, None, Some(span)) => entries.conflict(
            &span,
            "`spindle_diameter` has no effect without `coulomb`",
            "add `coulomb`, or remove `spindle_diameter`",
        ),
        (JointKind::Prismatic, _, Some(span)) => entries.conflict(
            &span,
            "`spindle_diameter` has no effect on a prismatic joint",
            "remove it",
        ),
        (JointKind::Revolute, Some(_), Some(_))
        | (JointKind::Revolute, None, None)
        | (JointKind::Prismatic, _, None) => {}
    }
}

/// Reads `drive`.
pub(super) fn drive(reader: &mut Reader<'_>, entry: &Entry<'_>, kind: JointKind) -> Drive {
    let mut drive = Drive::none();
    let Some(table) = reader.table(entry.value, &DRIVE) else {
        return drive;
    };
    let mut entries = Entries { reader, table };
    check_not_empty(&mut entries, entry, "drive");
    let armature = by_kind("the armature", kind, (1, 2, 0), (1, 0, 0));
    entries.read("armature", &mut drive.armature, armature, Sign::NotNegative);
    let inertia = quantity("the rotor inertia", 1, 2, 0);
    let inertia =
        entries.read("rotor_inertia", &mut drive.rotor_inertia, inertia, Sign::NotNegative);
    let ratio = by_kind("the gear ratio", kind, (0, 0, 0), (0, -1, 0));
    let ratio = entries.read("gear_ratio", &mut drive.gear_ratio, ratio, Sign::NotZero);
    let gyroscopic = entries.table.get("gyroscopic");
    if let Some(entry) = &gyroscopic {
        drive.gyroscopic = entries.reader.boolean(entry.value).unwrap_or_default();
    }
    if inertia.is_none() {
        let lonely = [ratio, gyroscopic.filter(|_| drive.gyroscopic).map(|entry| entry.key)];
        for span in lonely.into_iter().flatten() {
            entries.conflict(
                &span,
                "this key has no effect without `rotor_inertia`",
                "add `rotor_inertia`, in kg m^2 about the rotor's axis, or remove this key",
            );
        }
    }
    entries.table.finish(entries.reader);
    drive
}
