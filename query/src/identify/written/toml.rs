//! Writes identified values into a robot file in TOML: masses, centers of mass and inertias of all moving links,
//! and friction and armatures if the file has them.

use robot_dynamics::base_parameters::Quantity;
use robot_model::description::{self, Options};
use robot_model::robot::{JointKind, Link};
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, TableLike, value};

use super::{Body, Identified};

/// The text with the identified values. A URDF file is converted to TOML first.
pub(super) fn with_values(
    name: &str,
    text: &str,
    links: &[Link],
    identified: &Identified<'_>,
    comments: &[Vec<String>],
) -> Result<String, String> {
    let import = description::import(name, text, &Options::default())
        .map_err(|errors| errors.to_string())?;
    let mut document: DocumentMut =
        import.toml.parse().map_err(|error: toml_edit::TomlError| error.to_string())?;
    if standard_rows(document.as_table()) {
        return Err(
            "values in standard Denavit-Hartenberg frames cannot be written back".to_owned()
        );
    }
    let tables = document.get_mut("link").and_then(Item::as_array_of_tables_mut);
    let tables = tables.ok_or_else(|| "the robot file has no [[link]]".to_owned())?;
    for (place, (link, comments)) in links.iter().zip(comments).enumerate() {
        let merged = link.bodies.iter().filter(|body| body.name != link.name);
        for body in merged {
            if let Some(table) = tables.iter_mut().find(|table| named(table, &body.name)) {
                ["mass", "center_of_mass", "inertia"]
                    .iter()
                    .for_each(|key| drop(table.remove(key)));
            }
        }
        let table = tables.iter_mut().find(|table| named(table, &link.name));
        let table = table.ok_or_else(|| format!("link `{}` is not in the file", link.name))?;
        let own = Written { identified, place };
        own.link(link, table).map_err(|reason| format!("link `{}`: {reason}", link.name))?;
        comment(comments, table);
    }
    drop_unused(&mut document, &import.toml);
    Ok(document.to_string())
}

/// Removes the parameters that the old values used and that nothing uses now.
fn drop_unused(document: &mut DocumentMut, before: &str) {
    let after = document.to_string();
    let times = |text: &str, name: &str| {
        let words = text.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
        words.filter(|word| *word == name).count()
    };
    let Some(parameters) = document.get_mut("parameters").and_then(Item::as_table_like_mut) else {
        return;
    };
    let names: Vec<String> = parameters.iter().map(|(name, _)| name.to_owned()).collect();
    for name in names.iter().filter(|name| times(before, name) > 1 && times(&after, name) == 1) {
        parameters.remove(name);
    }
    if parameters.is_empty() {
        document.remove("parameters");
    }
}

/// Writes comments above a table.
fn comment(comments: &[String], table: &mut Table) {
    let mut text =
        table.decor().prefix().and_then(|prefix| prefix.as_str()).unwrap_or("\n").to_owned();
    comments.iter().for_each(|line| text.push_str(&format!("# {line}\n")));
    table.decor_mut().set_prefix(text);
}

fn named(table: &Table, name: &str) -> bool {
    table.get("name").and_then(Item::as_str) == Some(name)
}

/// Whether a table has Denavit-Hartenberg rows, whose frames are not those of the links.
fn standard_rows(table: &Table) -> bool {
    let rows = table.get("dh").and_then(Item::as_table_like);
    rows.is_some_and(|dh| dh.get("convention").and_then(Item::as_str) != Some("modified"))
}

/// The values of a link.
struct Written<'a> {
    identified: &'a Identified<'a>,
    place: usize,
}

impl Written<'_> {
    /// Replaces the values in the link's table.
    fn link(&self, link: &Link, table: &mut Table) -> Result<(), String> {
        if standard_rows(table) {
            return Err(
                "values in standard Denavit-Hartenberg frames cannot be written back".to_owned()
            );
        }
        let Body { mass, center, inertia } = self.identified.body(self.place)?;
        table.remove("massless");
        table.insert("mass", value(mass));
        table.insert("center_of_mass", value(center.iter().copied().collect::<Array>()));
        let mut entries = InlineTable::new();
        let places =
            [("xx", 0, 0), ("yy", 1, 1), ("zz", 2, 2), ("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)];
        for (name, row, column) in places {
            entries.insert(name, inertia[(row, column)].into());
        }
        table.insert("inertia", value(entries));
        self.friction(link, table)?;
        self.drive(table)
    }

    fn of_drive(&self, quantity: Quantity) -> Option<f64> {
        self.identified.of_drive(self.place, quantity)
    }

    fn friction(&self, link: &Link, table: &mut Table) -> Result<(), String> {
        let constant = match link.joint.kind {
            JointKind::Revolute => "coulomb_torque",
            JointKind::Prismatic => "coulomb_force",
        };
        let entries = [
            (Quantity::ViscousFriction, "viscous"),
            (Quantity::ForwardFriction, "coulomb_positive"),
            (Quantity::BackwardFriction, "coulomb_negative"),
            (Quantity::Offset, "offset"),
        ];
        for (quantity, key) in entries {
            if let Some(found) = self.of_drive(quantity) {
                let friction = part(table, "friction")?;
                friction.remove(constant);
                friction.insert(key, value(found));
            }
        }
        Ok(())
    }

    fn drive(&self, table: &mut Table) -> Result<(), String> {
        if self.of_drive(Quantity::RotorCoupling).is_some() {
            return Err("gyroscopic rotors cannot be written back".to_owned());
        }
        let Some(armature) = self.of_drive(Quantity::ReflectedInertia) else {
            return Ok(());
        };
        let drive = part(table, "drive")?;
        ["rotor_inertia", "gear_ratio"].iter().for_each(|key| drop(drive.remove(key)));
        drive.insert("armature", value(armature));
        Ok(())
    }
}

/// A table within a link's table, which is inline or a table of its own.
fn part<'t>(table: &'t mut Table, name: &str) -> Result<&'t mut dyn TableLike, String> {
    let found = table.get_mut(name).and_then(Item::as_table_like_mut);
    found.ok_or_else(|| format!("`{name}` is not a table of the link"))
}
