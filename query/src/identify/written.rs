//! Robot files with identified values.

use nalgebra::{Matrix3, Vector3};
use robot_build::Source;
use robot_check::doctor;
use robot_dynamics::base_parameters::{Quantity, StandardParameter};
use robot_model::description::{self, Options};
use robot_model::robot::{JointKind, LINK_PARAMETERS, Link};
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, TableLike, value};

use super::consistent::Consistent;
use super::estimate::Estimate;
use super::parameters::Parameters;
use crate::error::Error;
use crate::robots::Model;

/// By how much base parameters of the written file may differ from those meant, beside the largest of them.
const ROUNDING: f64 = 1e-9;

impl Estimate {
    /// The robot file, in TOML, with consistent values of this estimate: masses, centers of mass and inertias of all
    /// moving links, and friction and armatures that the file has. The estimates with their deviations are comments. Bodies
    /// of fixed links are joined with the moving link that carries them. The second text has what the doctor says about the
    /// file under its new name.
    ///
    /// # Errors
    ///
    /// A file with what cannot be written back: standard Denavit-Hartenberg rows, gyroscopic rotors, drives given by
    /// rotor inertia; a result that is not a robot file.
    pub fn robot_file(
        &self,
        model: &Model,
        consistent: &Consistent,
        new: &str,
    ) -> Result<(String, String), Error> {
        let Source { name, text } = &model.source;
        let failed = |reason: String| Error::Robot { robot: name.clone(), reason };
        let import = description::import(name, text, &Options::default())
            .map_err(|errors| failed(errors.to_string()))?;
        let mut document: DocumentMut =
            import.toml.parse().map_err(|error: toml_edit::TomlError| failed(error.to_string()))?;
        let parameters = Parameters::of(model)?;
        if standard_rows(document.as_table()) {
            return Err(failed(
                "values in standard Denavit-Hartenberg frames are not written back".to_owned(),
            ));
        }
        let links = document.get_mut("link").and_then(Item::as_array_of_tables_mut);
        let links = links.ok_or_else(|| failed("the robot file has no [[link]]".to_owned()))?;
        for (place, link) in model.robot.links.iter().enumerate() {
            let merged = link.bodies.iter().filter(|body| body.name != link.name);
            for body in merged {
                if let Some(table) = links.iter_mut().find(|table| named(table, &body.name)) {
                    ["mass", "center_of_mass", "inertia"]
                        .iter()
                        .for_each(|key| drop(table.remove(key)));
                }
            }
            let table = links.iter_mut().find(|table| named(table, &link.name));
            let table =
                table.ok_or_else(|| failed(format!("link `{}` is not in the file", link.name)))?;
            let own = Written { parameters: &parameters, values: &consistent.values, place };
            own.link(link, table)
                .map_err(|reason| failed(format!("link `{}`: {reason}", link.name)))?;
            self.comment(place, table);
        }
        let text = document.to_string();
        let found = doctor::check(new, &text, &Options::default()).found;
        let source = Source { name: new.to_owned(), text: text.clone() };
        let options = robot_build::Options { search: false, ..robot_build::Options::default() };
        let written = Model::new(source, options)?;
        let base = Parameters::of(&written)?.nominal;
        let largest = consistent.base.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let same = |(found, wanted): (&f64, &f64)| (found - wanted).abs() <= ROUNDING * largest;
        if base.len() != consistent.base.len() || !base.iter().zip(&consistent.base).all(same) {
            let reason =
                "the file with the identified values has other base parameters; please report this";
            return Err(failed(reason.to_owned()));
        }
        Ok((text, found.to_string()))
    }

    /// Writes the estimates of a link's base parameters above its table.
    fn comment(&self, link: usize, table: &mut Table) {
        let ending = format!("_{}", link + 1);
        let mut text =
            table.decor().prefix().and_then(|prefix| prefix.as_str()).unwrap_or("\n").to_owned();
        for (place, name) in
            self.names.iter().enumerate().filter(|(_, name)| name.ends_with(&ending))
        {
            let (value, nominal) = (self.values[place], self.nominal[place]);
            let deviation = match self.deviations[place] {
                Some(deviation) => format!("{value:.6} +- {deviation:.6}"),
                None => "not identifiable".to_owned(),
            };
            text.push_str(&format!("# {name}: {deviation} (before: {nominal:.6})\n"));
        }
        table.decor_mut().set_prefix(text);
    }
}

fn named(table: &Table, name: &str) -> bool {
    table.get("name").and_then(Item::as_str) == Some(name)
}

/// Whether a table has rows whose frames are not those of the links.
fn standard_rows(table: &Table) -> bool {
    let rows = table.get("dh").and_then(Item::as_table_like);
    rows.is_some_and(|dh| dh.get("convention").and_then(Item::as_str) != Some("modified"))
}

/// The values of a link.
struct Written<'a> {
    parameters: &'a Parameters,
    values: &'a [f64],
    place: usize,
}

impl Written<'_> {
    /// Replaces the values in the link's table.
    fn link(&self, link: &Link, table: &mut Table) -> Result<(), String> {
        if standard_rows(table) {
            return Err(
                "values in standard Denavit-Hartenberg frames are not written back".to_owned()
            );
        }
        let own = &self.values[self.place * LINK_PARAMETERS..][..LINK_PARAMETERS];
        let &[mass, x, y, z, xx, xy, yy, xz, yz, zz] = own else {
            return Err("its parameters are incomplete".to_owned());
        };
        let center = Vector3::new(x, y, z) / mass;
        let about_origin = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let square = Matrix3::identity() * center.norm_squared() - center * center.transpose();
        let inertia = about_origin - square * mass;
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

    /// A parameter of the link's drive, if the regressor has it.
    fn of_drive(&self, quantity: Quantity) -> Option<f64> {
        let wanted = StandardParameter { link: self.place, quantity };
        let place = self.parameters.standard.iter().position(|parameter| *parameter == wanted)?;
        self.values.get(place).copied()
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
            return Err("gyroscopic rotors are not written back".to_owned());
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

/// A table in a link's table, as inline or as a table of its own.
fn part<'t>(table: &'t mut Table, name: &str) -> Result<&'t mut dyn TableLike, String> {
    let found = table.get_mut(name).and_then(Item::as_table_like_mut);
    found.ok_or_else(|| format!("`{name}` is not a table of the link"))
}
