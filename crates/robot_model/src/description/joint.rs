//! The joint of a link: its type, axis, limits, and the joint that it mimics.

use std::array;

use robot_symbolic::{Formula, Rational};
use toml::de::DeValue;

use super::draft::{DraftJoint, Mimic};
use super::locations::LinkLocation;
use super::names::Kind;
use super::placement::zero;
use super::reader::{Named, Reader};
use super::shape::{AXES, JOINT, JOINT_TYPES, MIMIC};
use super::table::{Entry, Table, Value};
use super::value::{Quantity, is_hidden, quantity};
use crate::diagnostic::{Diagnostic, code};
use crate::robot::JointKind;

/// Reads `type`: `Some(None)` for a fixed link, `None` if the type is invalid.
pub(super) fn kind(reader: &mut Reader<'_>, entry: &Entry<'_>) -> Option<Option<JointKind>> {
    if let DeValue::String(word) = entry.value.get_ref()
        && let Some(help) = elsewhere(word)
    {
        reader.report(
            Diagnostic::error(code::UNKNOWN_WORD, format!("`{word}` is not a joint type"))
                .at(&entry.value.span(), "")
                .help(help),
        );
        return None;
    }
    reader.word(entry.value, "a joint type", JOINT_TYPES).map(of_type)
}

/// The kind of joint for a word of [`JOINT_TYPES`]; `None` for a fixed link.
fn of_type(word: &str) -> Option<JointKind> {
    match word {
        "revolute" => Some(JointKind::Revolute),
        "prismatic" => Some(JointKind::Prismatic),
        _ => None,
    }
}

/// The kind of joint for which the rest of a link is checked if its type is wrong: the one that is probably meant.
pub(super) fn probable_kind(reader: &Reader<'_>, entry: &Entry<'_>) -> JointKind {
    let DeValue::String(word) = entry.value.get_ref() else { return JointKind::Revolute };
    let is_slide = SLIDES.contains(&word.as_ref())
        || reader.nearest(word, JOINT_TYPES.iter().copied()) == Some("prismatic");
    if is_slide { JointKind::Prismatic } else { JointKind::Revolute }
}

/// Words for a prismatic joint in other formats.
const SLIDES: &[&str] = &["translation", "translational", "linear", "slide", "slider", "P"];

/// The advice for a joint type that other formats use.
fn elsewhere(word: &str) -> Option<&'static str> {
    match word {
        "continuous" => Some("write \"revolute\" and leave out `limits`"),
        "rotation" | "rotational" | "hinge" | "R" => Some("write \"revolute\""),
        word if SLIDES.contains(&word) => Some("write \"prismatic\""),
        "floating" | "free" => Some(
            "use three prismatic and three revolute joints, with massless links between \
            them",
        ),
        "planar" => Some(
            "use two prismatic joints and a revolute one, with massless links \
            between them",
        ),
        "spherical" | "ball" => Some("use three revolute joints, with massless links between them"),
        "cylindrical" => {
            Some("use a revolute and a prismatic joint, with a massless link between them")
        }
        "universal" => Some("use two revolute joints, with a massless link between them"),
        "screw" => Some(
            "use a revolute joint with a massless link, and a prismatic joint that mimics it, \
            with its travel per radian as `ratio`",
        ),
        _ => None,
    }
}

/// Reads `joint`. `row` is the type that a DH table gives; `dh` is whether a DH row places the joint, so that its axis
/// is z.
pub(super) fn read(
    reader: &mut Reader<'_>,
    table: &mut Table<'_>,
    link: &Named,
    row: Option<Option<JointKind>>,
    dh: bool,
    places: &mut LinkLocation,
) -> DraftJoint {
    let mut joint = DraftJoint {
        // Without a type, this placeholder lets the rest of the link be checked.
        kind: row.unwrap_or(Some(JointKind::Revolute)),
        name: link.clone(),
        axis: [zero(), zero(), Formula::number(&Rational::ONE)],
        limits: None,
        mimic: None,
    };
    places.joint = table.span.clone();
    let entry = if row.is_some() {
        table.get("joint")
    } else {
        let axis = if dh { "" } else { ", axis = \"z\"" };
        table.require(reader, "joint", &format!("joint = {{ type = \"revolute\"{axis} }}"))
    };
    let Some(entry) = entry else { return joint };
    places.joint = entry.value.span();
    if let DeValue::String(word) = entry.value.get_ref()
        && row.is_none()
        && JOINT_TYPES.contains(&word.as_ref())
    {
        let axis = if dh || word == "fixed" { "" } else { ", axis = \"z\"" };
        let expected = format!("a joint as a table `{{ type = \"{word}\"{axis} }}`");
        reader.wrong_type(entry.value, &expected);
        joint.kind = of_type(word);
        return joint;
    }
    let Some(mut table) = reader.table(entry.value, &JOINT) else {
        return joint;
    };
    if row.is_none() {
        let example = "type = \"revolute\"";
        // Without a type, the other keys of the joint cannot be checked.
        let Some(entry) = table.require(reader, "type", example) else { return joint };
        let Some(kind) = kind(reader, &entry) else {
            joint.kind = Some(probable_kind(reader, &entry));
            return joint;
        };
        joint.kind = kind;
    } else if let Some(entry) = table.get("type") {
        let message = "`type` does not belong here: the DH row gives it";
        reader.report(Diagnostic::error(code::CONFLICT, message).at(&entry.key, "no effect").help(
            "remove it, or write it in the row; a row without `type` is that of a revolute joint",
        ));
    }
    if let Some(entry) = table.get("name") {
        joint.name = reader.name(entry.value, "a joint", Kind::Label).unwrap_or(joint.name);
    }
    if joint.kind.is_some() {
        moving(reader, &mut table, &mut joint, dh, places);
    }
    finish(reader, table, joint.kind, dh || row.is_some());
    joint
}

fn moving(
    reader: &mut Reader<'_>,
    table: &mut Table<'_>,
    joint: &mut DraftJoint,
    dh: bool,
    places: &mut LinkLocation,
) {
    if !dh {
        let entry = table.require(reader, "axis", "axis = \"z\"");
        joint.axis = match &entry {
            Some(entry) => axis(reader, entry.value),
            None => array::from_fn(|_| Reader::unknown()),
        };
        places.axis = entry.map(|entry| entry.value.span());
    }
    if let Some(entry) = table.get("limits") {
        joint.limits = limits(reader, entry.value);
        places.limits = Some(entry.value.span());
    }
    if let Some(entry) = table.get("mimic") {
        joint.mimic = mimic(reader, entry.value, joint.kind);
        if let Some(limits) = &places.limits {
            reader.report(
                Diagnostic::error(code::CONFLICT, "a joint that mimics another cannot have limits")
                    .at(limits, "these limits have no effect")
                    .and_at(&entry.key, "the joint mimics another")
                    .help("put the limits on the leading joint"),
            );
        }
    }
}

/// Reports keys that have no meaning for this joint, with the reason, and then the unknown keys.
fn finish(reader: &mut Reader<'_>, mut table: Table<'_>, kind: Option<JointKind>, dh: bool) {
    let reason = match (kind, dh) {
        (None, _) => "the joint is fixed",
        _ => "the joint axis of a DH row is z",
    };
    let keys: &[&'static str] = match (kind, dh) {
        (None, _) => &["axis", "limits", "mimic"],
        (Some(_), true) => &["axis"],
        (Some(_), false) => &[],
    };
    for key in keys {
        if let Some(entry) = table.get(key) {
            reader.report(
                Diagnostic::error(
                    code::CONFLICT,
                    format!("`{key}` does not belong here: {reason}"),
                )
                .at(&entry.key, "no effect")
                .help("remove it"),
            );
        }
    }
    table.finish(reader);
}

/// Reads an axis: `"x"`, `"-z"`, or a nonzero vector.
fn axis(reader: &mut Reader<'_>, value: Value<'_>) -> [Formula; 3] {
    const EXPECTED: &str = "a joint axis: \"x\", \"-z\" or `[x, y, z]`";
    let vector = match value.get_ref() {
        DeValue::Array(_) => {
            let what = Quantity { what: "a joint axis", dimension: None };
            let vector = reader.vector(value, what);
            reader.same_dimension(&vector, what.what, &value.span());
            vector
        }
        DeValue::String(_) => {
            let Some(word) = reader.word(value, "a joint axis", AXES) else {
                return array::from_fn(|_| Reader::unknown());
            };
            let sign = if word.starts_with('-') { -1 } else { 1 };
            let component = |name: &str| {
                let here = word.ends_with(name);
                Formula::number(&Rational::integer(if here { sign } else { 0 }))
            };
            [component("x"), component("y"), component("z")]
        }
        _ => {
            reader.wrong_type(value, EXPECTED);
            return array::from_fn(|_| Reader::unknown());
        }
    };
    if vector.iter().all(|component| reader.vanishes(component)) {
        reader.report(
            Diagnostic::error(code::ZERO_AXIS, "the joint axis is zero")
                .at(&value.span(), "this vector has no direction")
                .because(
                    "a joint rotates about an axis or slides along it, and 0 0 0 is not a \
                    direction",
                )
                .help("write a direction such as \"z\" or [0, 0, 1]; its length does not matter"),
        );
    }
    vector
}

fn limits(reader: &mut Reader<'_>, value: Value<'_>) -> Option<[Rational; 2]> {
    let entries = reader.entries::<2>(value, "limits as `[lower, upper]`")?;
    let [lower, upper] = entries.map(|entry| reader.number(entry, "a limit as a number"));
    let limits = [lower?, upper?];
    let [lower, upper] = &limits;
    if lower < upper {
        return Some(limits);
    }
    reader.report(
        Diagnostic::error(code::LIMITS, "the lower limit is not below the upper limit")
            .at(&value.span(), "expected `[lower, upper]`")
            .help(if lower == upper {
                "write two different limits, or use the type `fixed` for a joint that does not move"
            } else {
                "swap them, or leave out `limits` if the joint has none"
            }),
    );
    None
}

fn mimic(reader: &mut Reader<'_>, value: Value<'_>, kind: Option<JointKind>) -> Option<Mimic> {
    // The dimension is checked once the leading joint is known.
    const RATIO: Quantity = Quantity { what: "the ratio", dimension: None };
    let kind = kind.unwrap_or(JointKind::Revolute);
    let offset_of_joint = by_kind("the offset", kind, (0, 0, 0), (0, 1, 0));
    if let DeValue::String(leader) = value.get_ref()
        && !leader.contains(|character: char| "\"\\`".contains(character) || is_hidden(character))
    {
        reader.wrong_type(value, &format!("a `mimic` table `{{ joint = \"{leader}\" }}`"));
        return None;
    }
    let mut table = reader.table(value, &MIMIC)?;
    let joint = table
        .require(reader, "joint", "joint = \"name of the leading joint\"")
        .and_then(|entry| reader.name(entry.value, "a joint", Kind::Label));
    let mut of_ratio = None;
    let ratio = match table.get("ratio") {
        Some(entry) => {
            of_ratio = Some(entry.value.span());
            let ratio = reader.formula(entry.value, RATIO);
            if reader.known(&ratio) == Some(0.0) {
                reader.report(
                    Diagnostic::error(
                        code::MIMIC,
                        "a joint that mimics another with ratio 0 is \
                        fixed",
                    )
                    .at(&entry.value.span(), "the ratio is 0")
                    .help("write `type = \"fixed\"`, or correct the ratio"),
                );
            }
            ratio
        }
        None => Formula::number(&Rational::ONE),
    };
    let offset = table.get("offset");
    let offset = offset.map_or_else(zero, |entry| reader.formula(entry.value, offset_of_joint));
    table.finish(reader);
    Some(Mimic { joint: joint?, ratio, of_ratio, offset })
}

/// The quantity with the dimension for a revolute or for a prismatic joint.
pub(super) const fn by_kind(
    what: &'static str,
    kind: JointKind,
    rotation: (i8, i8, i8),
    translation: (i8, i8, i8),
) -> Quantity {
    let (mass, length, time) = match kind {
        JointKind::Revolute => rotation,
        JointKind::Prismatic => translation,
    };
    quantity(what, mass, length, time)
}
