//! Placements of frames: `origin` with xyz and rpy, or `dh` with a Denavit–Hartenberg row.

use robot_symbolic::{Formula, Rational};

use super::reader::Reader;
use super::shape::{CONVENTIONS, DH_ROW, ORIGIN};
use super::table::{Entry, Table, Value};
use super::value::{Quantity, quantity};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::robot::{Axis, DhConvention, JointKind, Move, Placement};

/// Angles about the fixed axes x, y, z: R = Rz(yaw) Ry(pitch) Rx(roll).
pub(super) const RPY: Quantity = quantity("the roll, pitch and yaw angles", 0, 0, 0);

/// The placements of a joint: one before its motion and one after it.
#[derive(Default)]
pub(super) struct Frames {
    pub(super) before: Placement,
    pub(super) after: Placement,
    /// The Denavit–Hartenberg row that gives the placements, with its convention.
    pub(super) dh: Option<(DhConvention, Row)>,
    /// The place of `origin` or `dh`.
    pub(super) place: Option<Span>,
}

/// The angles and lengths of a row.
#[derive(Clone)]
pub(super) struct Row {
    pub(super) a: Formula,
    pub(super) alpha: Formula,
    pub(super) d: Formula,
    pub(super) theta: Formula,
}

pub(super) fn zero() -> Formula {
    Formula::number(&Rational::ZERO)
}

pub(super) fn zeros() -> [Formula; 3] {
    [zero(), zero(), zero()]
}

/// Reads `origin` or `dh` of a link. Without either, the link's frame coincides with the parent's at joint position 0.
pub(super) fn of_link(
    reader: &mut Reader<'_>,
    table: &mut Table<'_>,
    kind: Option<JointKind>,
) -> Frames {
    let origin = table.get("origin");
    match (origin, table.get("dh")) {
        (Some(origin), Some(dh)) => {
            reader.report(
                Diagnostic::error(code::CONFLICT, "the link has both `origin` and `dh`")
                    .at(&dh.key, "the frame is given twice")
                    .and_at(&origin.key, "already given here")
                    .help("keep one of them"),
            );
            Frames::default()
        }
        (Some(entry), None) => Frames {
            before: origin_of(reader, entry.value),
            place: Some(entry.value.span()),
            ..Frames::default()
        },
        (None, Some(entry)) => dh(reader, &entry, kind),
        (None, None) => Frames::default(),
    }
}

/// Reads `{ xyz = [x, y, z], rpy = [roll, pitch, yaw] }`; both default to zero.
pub(super) fn origin_of(reader: &mut Reader<'_>, value: Value<'_>) -> Placement {
    let Some(mut table) = reader.table(value, &ORIGIN) else {
        return Placement::default();
    };
    let xyz = table
        .get("xyz")
        .map_or_else(zeros, |entry| reader.vector(entry.value, quantity("the origin", 0, 1, 0)));
    let rpy = table.get("rpy").map_or_else(zeros, |entry| reader.angle_vector(entry.value, RPY));
    table.finish(reader);
    without_zero_moves(Placement::from_xyz_rpy(xyz, rpy))
}

fn dh(reader: &mut Reader<'_>, entry: &Entry<'_>, kind: Option<JointKind>) -> Frames {
    let Some(mut table) = reader.table(entry.value, &DH_ROW) else {
        return Frames::default();
    };
    let convention = convention(reader, &mut table);
    let row = row(reader, &mut table);
    table.finish(reader);
    match convention {
        Some(convention) => frames_of_row(convention, row, kind, entry.value.span()),
        None => Frames::default(),
    }
}

/// Reads the convention. It has no default, because the two conventions give different robots.
pub(super) fn convention(reader: &mut Reader<'_>, table: &mut Table<'_>) -> Option<DhConvention> {
    let help = "add `convention = \"standard\"` if the frame of a link is at its far end, on the next joint's axis, or \
                `convention = \"modified\"` if it is on the link's own joint axis";
    let entry = table.require_with(reader, "convention", help)?;
    let word = reader.word(entry.value, "a DH convention", CONVENTIONS)?;
    DhConvention::ALL.into_iter().find(|convention| convention.name() == word)
}

/// Reads `a`, `alpha`, `d` and `theta`, which default to zero.
pub(super) fn row(reader: &mut Reader<'_>, table: &mut Table<'_>) -> Row {
    let mut length_or_angle = |key: &'static str, what: Quantity, is_angle: bool| {
        let read = if is_angle { Reader::angle } else { Reader::formula };
        table.get(key).map_or_else(zero, |entry| read(reader, entry.value, what))
    };
    Row {
        a: length_or_angle("a", quantity("the length `a`", 0, 1, 0), false),
        alpha: length_or_angle("alpha", quantity("the twist `alpha`", 0, 0, 0), true),
        d: length_or_angle("d", quantity("the offset `d`", 0, 1, 0), false),
        theta: length_or_angle("theta", quantity("the angle `theta`", 0, 0, 0), true),
    }
}

/// The frames of a row. Moves about and along z commute with the motion of the joint.
pub(super) fn frames_of_row(
    convention: DhConvention,
    row: Row,
    kind: Option<JointKind>,
    place: Span,
) -> Frames {
    let Row { a, alpha, d, theta } = row.clone();
    let rotate_z = Move::Rotate(Axis::Z, theta);
    let shift_z = Move::Translate([zero(), zero(), d]);
    let shift_x = Move::Translate([a, zero(), zero()]);
    let rotate_x = Move::Rotate(Axis::X, alpha);
    let moves = match convention {
        DhConvention::Standard => vec![rotate_z, shift_z, shift_x, rotate_x],
        DhConvention::Modified => vec![rotate_x, shift_x, rotate_z, shift_z],
    };
    let moves = without_zero_moves(Placement(moves));
    let (before, after) = match (convention, kind) {
        (DhConvention::Standard, Some(_)) => (Placement::default(), moves),
        _ => (moves, Placement::default()),
    };
    Frames { before, after, dh: Some((convention, row)), place: Some(place) }
}

/// The placement without the moves that are zero.
pub(super) fn without_zero_moves(placement: Placement) -> Placement {
    let moves = placement.0.into_iter().filter(|step| match step {
        Move::Translate(vector) => !vector.iter().all(Reader::is_zero),
        Move::Rotate(_, angle) => !Reader::is_zero(angle),
    });
    Placement(moves.collect())
}
