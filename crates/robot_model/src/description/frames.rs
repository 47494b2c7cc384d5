//! `[tip]`, `[[tip]]` and `[[frame]]`: named frames, with and without a wrench.

use toml::de::DeValue;

use super::draft::{DraftFrame, Parent};
use super::input_limits::MAX_LINKS;
use super::link::{LINK, named_parent};
use super::locations::FrameLocation;
use super::names::{Kind, Registry};
use super::placement::origin_of;
use super::reader::{Named, Reader};
use super::shape::{COMPONENT, FRAME, Shape, TIP, WRENCH};
use super::table::{Entry, Table, Value};
use crate::diagnostic::{Diagnostic, code};
use crate::robot::{Placement, Wrench};

/// Reads tips, then frames. `links` is the number of links of the file.
pub(super) fn read(reader: &mut Reader<'_>, root: &mut Table<'_>, links: usize) -> Vec<DraftFrame> {
    let mut found = Vec::new();
    if let Some(entry) = root.get("tip") {
        let tables = tables(reader, &entry, &TIP);
        let alone = tables.len() == 1;
        let mut names = Registry::exact("tip");
        for table in tables {
            found.extend(tip(reader, table, links, alone, &mut names));
        }
    }
    if let Some(entry) = root.get("frame") {
        for table in tables(reader, &entry, &FRAME) {
            found.extend(frame(reader, table));
        }
    }
    found
}

/// The tables of a key whose value is one table or a list of tables.
pub(super) fn tables<'a>(
    reader: &mut Reader<'_>,
    entry: &Entry<'a>,
    shape: &'static Shape,
) -> Vec<Table<'a>> {
    let values: Vec<Value<'a>> = match entry.value.get_ref() {
        DeValue::Array(values) => values.iter().collect(),
        _ => vec![entry.value],
    };
    if values.len() > MAX_LINKS {
        let message = format!("at most {MAX_LINKS} entries are allowed; found {}", values.len());
        let diagnostic = Diagnostic::error(code::LIMIT, message).at(&entry.key, "this list");
        reader.report(diagnostic.help("describe one robot per file"));
        return Vec::new();
    }
    let tables = values.into_iter().filter_map(|value| reader.table(value, shape));
    tables.collect()
}

fn tip(
    reader: &mut Reader<'_>,
    mut table: Table<'_>,
    links: usize,
    alone: bool,
    names: &mut Registry,
) -> Option<DraftFrame> {
    let name = if alone && !table.has("name") {
        table.get("name");
        Some(Named { name: "tip".to_owned(), span: table.span.clone() })
    } else {
        frame_name(reader, &mut table)
    };
    // Components of wrenches are named after the tip, so they would be reported, too.
    let name = name.filter(|name| match names.add(name) {
        None => true,
        Some(twice) => {
            reader.report(twice);
            false
        }
    });
    let last = links.checked_sub(1).map_or(Parent::Base, Parent::Link);
    let parent = table.get("parent").map_or(Some(last), |entry| named_parent(reader, &entry, LINK));
    let (placement, origin) = origin(reader, &mut table);
    let wrench = table.get("wrench");
    let place = wrench.as_ref().map(|entry| entry.value.span());
    let wrench = match wrench {
        Some(entry) => named_wrench(reader, entry.value),
        None => name.as_ref().and_then(|name| plain_wrench(reader, name, alone)),
    };
    let span = table.span.clone();
    table.finish(reader);
    let name = name?;
    Some(DraftFrame {
        parent: parent?,
        placement,
        wrench: Some(wrench?),
        places: FrameLocation { name: name.span.clone(), origin, wrench: place.or(Some(span)) },
        name,
    })
}

fn frame(reader: &mut Reader<'_>, mut table: Table<'_>) -> Option<DraftFrame> {
    let name = frame_name(reader, &mut table);
    let parent = table.require(reader, "parent", "parent = \"name of a link\"");
    let parent = parent.and_then(|entry| named_parent(reader, &entry, LINK));
    let (placement, origin) = origin(reader, &mut table);
    if let Some(entry) = table.misplaced("wrench") {
        reader.report(
            Diagnostic::error(code::CONFLICT, "a frame cannot have a wrench")
                .at(&entry.key, "only tips have wrenches")
                .help("write `[[tip]]` instead of `[[frame]]`"),
        );
    }
    table.finish(reader);
    let name = name?;
    Some(DraftFrame {
        parent: parent?,
        placement,
        wrench: None,
        places: FrameLocation { name: name.span.clone(), origin, wrench: None },
        name,
    })
}

fn frame_name(reader: &mut Reader<'_>, table: &mut Table<'_>) -> Option<Named> {
    let entry = table.require(reader, "name", "name = \"flange\"")?;
    reader.name(entry.value, "a frame", Kind::Label)
}

fn origin(
    reader: &mut Reader<'_>,
    table: &mut Table<'_>,
) -> (Placement, Option<crate::diagnostic::Span>) {
    match table.get("origin") {
        Some(entry) => (origin_of(reader, entry.value), Some(entry.value.span())),
        None => (Placement::default(), None),
    }
}

/// The name of a component and its LaTeX, if the file has one.
type Component = (String, Option<String>);

/// Reads names such as `{ force = ["Fx", "Fy", "Fz"], moment = ["Mx", "My", "Mz"] }`.
fn named_wrench(reader: &mut Reader<'_>, value: Value<'_>) -> Option<Wrench> {
    let mut table = reader.table(value, &WRENCH)?;
    let mut names = |key: &'static str, example: &str, expected: &str| {
        let entry = table.require(reader, key, example)?;
        let entries = reader.entries::<3>(entry.value, expected)?;
        let names = entries.map(|entry| component(reader, entry));
        let [Some(x), Some(y), Some(z)] = names else {
            return None;
        };
        Some([x, y, z])
    };
    let force = names(
        "force",
        "force = [\"Fx\", \"Fy\", \"Fz\"]",
        "the names of the force components as `[\"Fx\", \"Fy\", \"Fz\"]`",
    );
    let moment = names(
        "moment",
        "moment = [\"Mx\", \"My\", \"Mz\"]",
        "the names of the moment components as `[\"Mx\", \"My\", \"Mz\"]`",
    );
    table.finish(reader);
    Some(wrench(force?, moment?))
}

fn wrench(force: [Component; 3], moment: [Component; 3]) -> Wrench {
    let [(fx, a), (fy, b), (fz, c)] = force;
    let [(mx, d), (my, e), (mz, f)] = moment;
    Wrench { force: [fx, fy, fz], moment: [mx, my, mz], latex: [a, b, c, d, e, f] }
}

/// Reads a component: `"Fx6"` or `{ name = "Fx6", latex = "F_x^6" }`.
fn component(reader: &mut Reader<'_>, value: Value<'_>) -> Option<Component> {
    let (value, latex) = match value.get_ref() {
        DeValue::Table(_) => {
            let mut table = reader.table(value, &COMPONENT)?;
            let name = table.require(reader, "name", "name = \"Fx\"");
            let latex = table.get("latex").and_then(|entry| reader.latex(entry.value));
            table.finish(reader);
            (name?.value, latex)
        }
        _ => (value, None),
    };
    let named = reader.name(value, "a component of a wrench", Kind::Identifier)?;
    if let Some(diagnostic) = reader.symbols.add(&named) {
        reader.report(diagnostic);
        return None;
    }
    Some((named.name, latex))
}

/// The default names of a wrench, `Fx` … `Mz`, followed by the tip's name if there are several tips.
fn plain_wrench(reader: &mut Reader<'_>, tip: &Named, alone: bool) -> Option<Wrench> {
    let suffix: String = tip
        .name
        .chars()
        .map(|character| if character.is_ascii_alphanumeric() { character } else { '_' })
        .collect();
    let mut component = |component: &str| {
        let name = match alone {
            true => component.to_owned(),
            false => format!("{component}_{suffix}"),
        };
        let named =
            reader.check_name(&name, &tip.span, "a component of a wrench", Kind::Identifier)?;
        match reader.symbols.add(&named) {
            Some(diagnostic) => {
                reader.report(diagnostic.help("name the components of the wrench with `wrench`"));
                None
            }
            None => Some((name, None)),
        }
    };
    let names = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"].map(&mut component);
    let [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] = names else {
        return None;
    };
    Some(wrench([a, b, c], [d, e, f]))
}
