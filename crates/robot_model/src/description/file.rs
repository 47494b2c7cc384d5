//! Reads a whole file: `format`, `[robot]`, `[parameters]`, `[dh]`, `[[link]]`, tips, frames, `[payload]`, `[code]` and
//! budgets.

use robot_symbolic::{Formula, Rational};
use toml::de::DeValue;

use super::Lowered;
use super::draft::{Draft, DraftLink};
use super::frames::tables;
use super::names::Kind;
use super::placement::zero;
use super::reader::{Named, Reader};
use super::shape::{BASE_FRAMES, LINK, ROBOT, ROBOT_FILE};
use super::table::{Table, Value};
use super::value::quantity;
use super::{budget, dh, frames, link, parameters, payload, syntax, tree, wanted};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::robot::BaseFrames;
use crate::snap;

/// The version of the format that this reader accepts.
const FORMAT: i64 = 1;

/// Lowers the text of a file and reports the errors in it.
pub(super) fn lower(reader: &mut Reader<'_>) -> Option<Lowered> {
    let (tables, found) = syntax::parse(reader.text);
    if !found.is_empty() {
        reader.found.extend(found);
        return None;
    }
    lower_tables(reader, Table::new(tables.get_ref(), 0..0, &ROBOT_FILE))
}

fn lower_tables(reader: &mut Reader<'_>, mut root: Table<'_>) -> Option<Lowered> {
    if !format(reader, &mut root) {
        return None;
    }
    let mut parameters = parameters::read(reader, &mut root);
    let head = head(reader, &mut root);
    let mut dh = dh::read(reader, &mut root);
    let (links, complete) = links(reader, &mut root, &mut dh);
    let frames = frames::read(reader, &mut root, links.len());
    let payload = payload::read(reader, &mut root, &links, &frames, &mut parameters);
    let wanted = wanted::read(reader, &mut root);
    let budgets = budget::read(reader, &mut root, &wanted.bundle_names());
    root.finish(reader);
    if let Some(dh) = dh {
        dh.finish(reader);
    }
    // A link without a name cannot be a parent; the errors that would follow from this are not reported.
    if !complete {
        return None;
    }
    let Head { name, description, gravity, gravity_place, snap, base_frames } = head;
    let mut draft = Draft {
        name,
        description,
        gravity,
        gravity_place,
        snap,
        base_frames,
        links,
        frames,
        payload,
    };
    let order = tree::order(reader, &mut draft)?;
    Some(Lowered { draft, order, parameters, wanted, budgets })
}

/// Checks `format`; returns false if it is another format, of which nothing else is read.
fn format(reader: &mut Reader<'_>, root: &mut Table<'_>) -> bool {
    let Some(entry) = root.require_with(
        reader,
        "format",
        "add `format = 1` as the first line, before all tables",
    ) else {
        return true;
    };
    let number = match entry.value.get_ref() {
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix()).ok(),
        _ => {
            reader.wrong_type(entry.value, "the format number, `format = 1`");
            return true;
        }
    };
    if number == Some(FORMAT) {
        return true;
    }
    let (message, label, help) = if root.has("fingerprint") && root.has("digest") {
        (
            "this is a pinned plan, not a robot file",
            "the format of a pinned plan".to_owned(),
            "name the robot file that the plan belongs to",
        )
    } else {
        (
            "unknown file format",
            format!("robot files have format {FORMAT}"),
            "write `format = 1`, or use a version of this program that knows the format",
        )
    };
    reader
        .report(Diagnostic::error(code::FORMAT, message).at(&entry.value.span(), label).help(help));
    false
}

struct Head {
    name: Named,
    description: Option<String>,
    gravity: [Formula; 3],
    gravity_place: Option<Span>,
    snap: Option<f64>,
    base_frames: BaseFrames,
}

/// Reads `[robot]`.
fn head(reader: &mut Reader<'_>, root: &mut Table<'_>) -> Head {
    let down = Rational::new(-981, 100).unwrap_or(Rational::ZERO);
    let mut head = Head {
        name: Named { name: String::new(), span: 0..0 },
        description: None,
        gravity: [zero(), zero(), Formula::number(&down)],
        gravity_place: None,
        snap: None,
        base_frames: BaseFrames::File,
    };
    let entry = root.require(reader, "robot", "[robot]");
    let Some(mut table) = entry.and_then(|entry| reader.table(entry.value, &ROBOT)) else {
        return head;
    };
    let name = table.require(reader, "name", "name = \"arm\"");
    let name = name.and_then(|entry| reader.name(entry.value, "a robot", Kind::Identifier));
    head.name = name.unwrap_or(head.name);
    let description = table.get("description");
    head.description = description.and_then(|entry| reader.prose(entry.value));
    if let Some(entry) = table.get("gravity") {
        let what = quantity("the acceleration of gravity", 0, 1, -2);
        head.gravity = reader.vector(entry.value, what);
        head.gravity_place = Some(entry.value.span());
    }
    head.snap = table.get("snap").and_then(|entry| tolerance(reader, entry.value));
    if let Some(entry) = table.get("base_frames") {
        let word = reader.word(entry.value, "frames for the base parameters", BASE_FRAMES);
        head.base_frames = word.and_then(BaseFrames::from_name).unwrap_or_default();
    }
    table.finish(reader);
    head
}

/// Reads `snap`, an angle in rad, such as `snap = 1e-6`.
fn tolerance(reader: &mut Reader<'_>, value: Value<'_>) -> Option<f64> {
    let tolerance = reader.number(value, "an angle in radians, `snap = 1e-6`")?.to_f64();
    if snap::check(tolerance).is_ok() {
        return Some(tolerance);
    }
    let most = snap::MAX;
    reader.report(
        Diagnostic::error(
            code::NUMBER,
            format!("{tolerance} rad is not a valid snapping tolerance"),
        )
        .at(&value.span(), format!("not between 0 and {most}"))
        .because("angles this close to a multiple of π/2 are snapped to it")
        .help("give a small angle in radians, such as 1e-6, or 0 to snap none"),
    );
    None
}

/// Reads every `[[link]]`. The flag is whether all of them could be read.
fn links(
    reader: &mut Reader<'_>,
    root: &mut Table<'_>,
    dh: &mut Option<dh::Table>,
) -> (Vec<DraftLink>, bool) {
    let Some(entry) = root.require(reader, "link", "[[link]]") else {
        return (Vec::new(), false);
    };
    if !matches!(entry.value.get_ref(), DeValue::Array(_)) {
        reader.wrong_type(entry.value, "a list of links, each headed `[[link]]`");
        return (Vec::new(), false);
    }
    let tables = tables(reader, &entry, &LINK);
    let count = tables.len();
    let links: Vec<DraftLink> = tables
        .into_iter()
        .enumerate()
        .filter_map(|(index, table)| link::read(reader, table, index, dh))
        .collect();
    let complete = links.len() == count && count > 0;
    (links, complete)
}
