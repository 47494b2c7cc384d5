//! Robot files with identified values.

mod toml;
mod urdf;

use nalgebra::{Matrix3, Vector3};
use robot_build::Source;
use robot_check::doctor;
use robot_dynamics::base_parameters::{Quantity, StandardParameter};
use robot_model::description::Options;
use robot_model::robot::LINK_PARAMETERS;

use super::consistent::Consistent;
use super::estimate::Estimate;
use super::parameters::Parameters;
use crate::error::Error;
use crate::robots::Model;

/// The most by which base parameters of the written file may differ from the intended ones, relative to the largest
/// of them.
const ROUNDING: f64 = 1e-9;

impl Estimate {
    /// Writes the robot file with the consistent values of this estimate: masses, centers of mass and inertias of
    /// all moving links, and the friction and armatures that the file has. If the new name ends with `.urdf`, the
    /// result is the URDF file with other inertials, otherwise TOML. Comments contain the estimates with their
    /// deviations. Bodies of fixed links are merged into the moving link that carries them. The second text
    /// contains the warnings of the doctor about the file under its new name.
    ///
    /// # Errors
    ///
    /// A file with parts that cannot be written back: standard Denavit-Hartenberg rows, gyroscopic rotors;
    /// URDF from a file that is not URDF; a result that is not a robot file.
    pub fn robot_file(
        &self,
        model: &Model,
        consistent: &Consistent,
        new: &str,
    ) -> Result<(String, String), Error> {
        let Source { name, text } = &model.source;
        let failed = |reason: String| Error::Robot { robot: name.clone(), reason };
        let parameters = Parameters::of(model)?;
        let identified = Identified { parameters: &parameters, values: &consistent.values };
        let links = &model.robot.links;
        let comments: Vec<Vec<String>> = (0..links.len()).map(|link| self.comments(link)).collect();
        let text = if new.ends_with(".urdf") {
            if !text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']).starts_with('<') {
                let reason = "a URDF file can be written only from a URDF file; name a .toml file";
                return Err(failed(reason.to_owned()));
            }
            let bodies: Result<Vec<Body>, String> =
                (0..links.len()).map(|link| identified.body(link)).collect();
            let bodies = bodies.map_err(failed)?;
            urdf::with_bodies(text, links, &bodies, &comments).map_err(failed)?
        } else {
            toml::with_values(name, text, links, &identified, &comments).map_err(failed)?
        };
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
        let complaints = if found.is_empty() { String::new() } else { found.to_string() };
        Ok((text, complaints))
    }

    /// The text with the estimates of a link's base parameters.
    fn comments(&self, link: usize) -> Vec<String> {
        let ending = format!("_{}", link + 1);
        let own = self.names.iter().enumerate().filter(|(_, name)| name.ends_with(&ending));
        let line = |(place, name): (usize, &String)| {
            let (value, nominal) = (self.values[place], self.nominal[place]);
            let deviation = match self.deviations[place] {
                Some(deviation) => format!("{value:.6} +- {deviation:.6}"),
                None if self.fixed.contains(name) => format!("{value:.6}, fixed"),
                None => "not identifiable".to_owned(),
            };
            format!("{name}: {deviation} (before: {nominal:.6})")
        };
        own.map(line).collect()
    }
}

/// The identified values of all standard parameters.
struct Identified<'a> {
    parameters: &'a Parameters,
    values: &'a [f64],
}

/// A body of a link: kg, m, kg m² about the center of mass, in the link's frame.
struct Body {
    mass: f64,
    center: Vector3<f64>,
    inertia: Matrix3<f64>,
}

impl Identified<'_> {
    fn body(&self, link: usize) -> Result<Body, String> {
        let own = self.values.iter().skip(link * LINK_PARAMETERS).take(LINK_PARAMETERS);
        let own: Vec<f64> = own.copied().collect();
        let &[mass, x, y, z, xx, xy, yy, xz, yz, zz] = own.as_slice() else {
            return Err("its parameters are incomplete".to_owned());
        };
        let center = Vector3::new(x, y, z) / mass;
        let about_origin = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let square = Matrix3::identity() * center.norm_squared() - center * center.transpose();
        Ok(Body { mass, center, inertia: about_origin - square * mass })
    }

    /// A parameter of a link's drive, if the regressor has it.
    fn of_drive(&self, link: usize, quantity: Quantity) -> Option<f64> {
        let wanted = StandardParameter { link, quantity };
        let place = self.parameters.standard.iter().position(|parameter| *parameter == wanted)?;
        self.values.get(place).copied()
    }
}
