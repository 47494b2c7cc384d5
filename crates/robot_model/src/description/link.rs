//! `[[link]]`: a link with its joint, frame, body, friction and drive.

use super::body;
use super::dh;
use super::draft::{DraftLink, Parent};
use super::drive;
use super::joint;
use super::locations::LinkLocation;
use super::names::Kind;
use super::placement::{Frames, frames_of_row, of_link};
use super::reader::{Named, Reader};
use super::table::Table;
use crate::diagnostic::{Diagnostic, code};
use crate::robot::{Drive, Friction};

/// Reads the link at `index` of the file; `None` if it has no valid name.
pub(super) fn read(
    reader: &mut Reader<'_>,
    mut table: Table<'_>,
    index: usize,
    dh: &mut Option<dh::Table>,
) -> Option<DraftLink> {
    let name = table
        .require(reader, "name", &format!("name = \"{}\"", index + 1))
        .and_then(|entry| reader.name(entry.value, "a link", Kind::Label));
    // A placeholder, so that the rest of the link is checked even if its name is not valid.
    let named = name.clone().unwrap_or(Named { name: String::new(), span: table.span.clone() });
    let mut places = LinkLocation { name: named.span.clone(), ..LinkLocation::default() };
    let parent = parent(reader, &mut table, index, &mut places);
    let own_frame = table.has("origin") || table.has("dh");
    let row = dh.as_mut().filter(|_| !own_frame).map(dh::Table::next_row);
    // If both `origin` and `dh` are given by mistake, an axis belongs to `origin`.
    let is_dh = row.is_some()
        || table.has("dh") && !(table.has("origin") && table.has_within("joint", "axis"));
    let kind = row.as_ref().map(|row| row.kind);
    let joint = joint::read(reader, &mut table, &named, kind, is_dh, &mut places);
    let frames = match row {
        Some(row) => frames_of_row(row.convention, row.row, row.kind, row.place),
        None => of_link(reader, &mut table, joint.kind),
    };
    let Frames { before, after, dh, place } = frames;
    places.origin = place;
    let body = body::read(reader, &mut table, &named, joint.kind.is_some());
    let (friction, drive) = on_joint(reader, &mut table, joint.kind, &mut places);
    table.finish(reader);
    Some(DraftLink {
        name: name?,
        parent,
        joint,
        before,
        after,
        dh,
        body,
        friction,
        left_out: None,
        drive,
        places,
    })
}

/// Reads `parent`: the name of a link, or `base`; the preceding link if it is left out.
fn parent(
    reader: &mut Reader<'_>,
    table: &mut Table<'_>,
    index: usize,
    places: &mut LinkLocation,
) -> Parent {
    match table.get("parent") {
        Some(entry) => {
            places.parent = Some(entry.value.span());
            named_parent(reader, &entry, LINK).unwrap_or(Parent::Base)
        }
        None => index.checked_sub(1).map_or(Parent::Base, Parent::Link),
    }
}

/// What the parent of a link, tip or frame is.
pub(super) const LINK: &str = "the name of a link, or \"base\"";

/// Reads the name of a parent; what is not a name is reported, with what is `expected`.
pub(super) fn named_parent(
    reader: &mut Reader<'_>,
    entry: &super::table::Entry<'_>,
    expected: &str,
) -> Option<Parent> {
    let text = reader.string(entry.value, expected)?;
    Some(match text.as_ref() {
        "base" => Parent::Base,
        name => Parent::Name(Named { name: name.to_owned(), span: entry.value.span() }),
    })
}

fn on_joint(
    reader: &mut Reader<'_>,
    table: &mut Table<'_>,
    kind: Option<crate::robot::JointKind>,
    places: &mut LinkLocation,
) -> (Friction, Drive) {
    let (mut friction, mut drive) = (Friction::none(), Drive::none());
    let entries = [table.get("friction"), table.get("drive")];
    let Some(kind) = kind else {
        for entry in entries.iter().flatten() {
            reader.report(
                Diagnostic::error(code::CONFLICT, "a fixed joint cannot have friction or a drive")
                    .at(&entry.key, "no effect")
                    .help("remove it"),
            );
        }
        return (friction, drive);
    };
    let [of_friction, of_drive] = entries;
    if let Some(entry) = of_friction {
        friction = drive::friction(reader, &entry, kind);
        places.friction = Some(entry.value.span());
    }
    if let Some(entry) = of_drive {
        drive = drive::drive(reader, &entry, kind);
        places.drive = Some(entry.value.span());
    }
    (friction, drive)
}
