//! Adds friction to joints without friction in the robot file: coefficients that are 0 until they are identified.

use robot_build::Source;
use robot_model::description::{self, Options};
use robot_model::robot::{JointKind, Link};
use toml_edit::{DocumentMut, InlineTable, Item, Table, value};

/// The keys of dry friction; a joint with one of them gets no other.
const DRY: [&str; 5] =
    ["coulomb", "coulomb_torque", "coulomb_force", "coulomb_positive", "coulomb_negative"];

/// Returns the robot file, in TOML, with viscous and constant dry friction in every moving joint: that of the file,
/// for URDF that of `<dynamics>`, otherwise parameters whose value is 0.
///
/// # Errors
///
/// Errors of the file; links that are rows of a table.
pub(super) fn with_friction(source: Source) -> Result<Source, String> {
    let options = Options { friction: true, ..Options::default() };
    let import = description::import(&source.name, &source.text, &options)
        .map_err(|errors| errors.to_string())?;
    let mut document: DocumentMut =
        import.toml.parse().map_err(|error: toml_edit::TomlError| error.to_string())?;
    let mut parameters = vec![];
    let tables = document.get_mut("link").and_then(Item::as_array_of_tables_mut);
    let tables =
        tables.ok_or_else(|| "friction is added to [[link]], of which there is none".to_owned())?;
    for (place, link) in import.described.robot.links.iter().enumerate() {
        let is_link = |table: &&mut Table| {
            table.get("name").and_then(Item::as_str) == Some(link.name.as_str())
        };
        let table = tables.iter_mut().find(is_link);
        let table = table.ok_or_else(|| format!("link `{}` is not in the file", link.name))?;
        // A joint that mimics another has no torque of its own.
        let joint = table.get("joint").and_then(Item::as_table_like);
        if joint.is_none_or(|joint| !joint.contains_key("mimic")) {
            complete(link, place + 1, table, &mut parameters)?;
        }
    }
    for name in parameters {
        let known = document.entry("parameters").or_insert_with(|| Item::Table(Table::new()));
        let known = known.as_table_like_mut().ok_or("`parameters` is not a table")?;
        if known.insert(&name, value(0)).is_some() {
            return Err(format!("the name `{name}` is taken; give the parameter another name"));
        }
    }
    let name = match source.name.strip_suffix(".urdf") {
        Some(stem) => format!("{stem}.toml"),
        None => source.name,
    };
    Ok(Source { name, text: document.to_string() })
}

/// Adds the missing friction of a link's joint; names of new parameters are added to `parameters`.
fn complete(
    link: &Link,
    number: usize,
    table: &mut Table,
    parameters: &mut Vec<String>,
) -> Result<(), String> {
    let friction = table.entry("friction").or_insert_with(|| value(InlineTable::new()));
    let friction = friction
        .as_table_like_mut()
        .ok_or_else(|| format!("`friction` of link `{}` is not a table", link.name))?;
    let mut added = vec![];
    if !friction.contains_key("viscous") {
        added.push(("viscous", format!("viscous_friction_{number}")));
    }
    if !DRY.iter().any(|key| friction.contains_key(key)) {
        let key = match link.joint.kind {
            JointKind::Revolute => "coulomb_torque",
            JointKind::Prismatic => "coulomb_force",
        };
        added.push((key, format!("dry_friction_{number}")));
    }
    for (key, name) in added {
        friction.insert(key, value(name.as_str()));
        parameters.push(name);
    }
    Ok(())
}
