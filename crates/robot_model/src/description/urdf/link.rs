//! `<link>`: its name and its `<inertial>`.

use robot_symbolic::Formula;
use roxmltree::Node;

use super::super::locations::BodyLocation;
use super::super::reader::Reader;
use super::element::{Attribute, Element, LINK};
use super::name::{self, Name};
use super::number::formulas;
use super::origin;
use crate::diagnostic::{Severity, Span};
use crate::robot::{Body, Inertia};

/// A link of the file.
pub(super) struct UrdfLink<'a> {
    pub(super) name: Name<'a>,
    /// The place of the element's tag.
    pub(super) tag: Span,
    pub(super) inertial: Option<Inertial>,
    /// Whether the element contains errors, so that content which seems to be missing may be present.
    pub(super) has_errors: bool,
}

/// An `<inertial>` in which all values are known.
pub(super) struct Inertial {
    /// The body, placed in the link's frame.
    pub(super) body: Body,
    pub(super) place: BodyLocation,
    pub(super) mass: f64,
    /// The tensor about the center of mass in the axes of the body's placement: xx, yy, zz, xy, xz, yz.
    pub(super) tensor: [f64; 6],
}

impl Inertial {
    /// Whether the mass and all moments of inertia are 0.
    pub(super) fn is_empty(&self) -> bool {
        self.mass == 0.0 && self.tensor.iter().all(|entry| *entry == 0.0)
    }
}

/// Reads a link; `None` if its name is wrong or missing.
pub(super) fn read<'a>(reader: &mut Reader<'_>, node: Node<'a, '_>) -> Option<UrdfLink<'a>> {
    let before = reader.found.len();
    let element = &Element::new(reader, node, &LINK);
    let attribute = element.require(reader, "name", "link_1");
    let name = attribute.and_then(|attribute| name::label(reader, &attribute, "a link"));
    let inertial = element.child(reader, "inertial");
    let inertial = inertial.and_then(|inertial| body(reader, &inertial, name.as_ref()));
    let found = reader.found.get(before..).unwrap_or_default();
    let has_errors = found.iter().any(|found| found.severity == Severity::Error);
    Some(UrdfLink { name: name?, tag: element.tag(), inertial, has_errors })
}

fn body(
    reader: &mut Reader<'_>,
    element: &Element<'_, '_>,
    name: Option<&Name<'_>>,
) -> Option<Inertial> {
    let origin = origin::read(reader, element);
    let mass = mass(reader, element);
    let inertia = element.require_child(
        reader,
        "inertia",
        "<inertia ixx=\"…\" ixy=\"0\" ixz=\"0\" iyy=\"…\" iyz=\"0\" izz=\"…\"/>",
    );
    let tensor = inertia.and_then(|inertia| Some((tensor(reader, &inertia)?, inertia.span())));
    let (origin, (mass, of_mass), (inertia, of_inertia), name) = (origin?, mass?, tensor?, name?);
    let number = |formula: &Formula| formula.evaluate(|_| f64::NAN);
    let Inertia { xx, yy, zz, xy, xz, yz } = &inertia;
    let values = [xx, yy, zz, xy, xz, yz].map(number);
    let place = BodyLocation {
        name: name.named.span.clone(),
        mass: Some(of_mass),
        center_of_mass: origin.xyz,
        inertia: Some(of_inertia),
        axes: origin.rpy,
        unchecked: false,
    };
    Some(Inertial {
        mass: number(&mass),
        tensor: values,
        body: Body { name: name.named.name.clone(), mass, placement: origin.placement, inertia },
        place,
    })
}

fn mass(reader: &mut Reader<'_>, element: &Element<'_, '_>) -> Option<(Formula, Span)> {
    let element = element.require_child(reader, "mass", "<mass value=\"…\"/>")?;
    let attribute = element.require(reader, "value", "1.5")?;
    let [mass] = formulas::<1>(reader, &attribute, "the mass", "1.5")?;
    Some((mass, attribute.span))
}

/// Reads the tensor. The products of inertia in URDF are entries of the tensor, as in this project.
fn tensor(reader: &mut Reader<'_>, element: &Element<'_, '_>) -> Option<Inertia> {
    let moments = ["ixx", "iyy", "izz"].map(|name| element.require(reader, name, "0.01"));
    let products = ["ixy", "ixz", "iyz"].map(|name| element.require(reader, name, "0"));
    let mut entry = |attribute: &Option<Attribute<'_>>| {
        let [entry] = formulas::<1>(reader, attribute.as_ref()?, "a moment of inertia", "0.01")?;
        Some(entry)
    };
    let [xx, yy, zz] = moments.each_ref().map(&mut entry);
    let [xy, xz, yz] = products.each_ref().map(&mut entry);
    let (Some(xx), Some(yy), Some(zz)) = (xx, yy, zz) else { return None };
    let (Some(xy), Some(xz), Some(yz)) = (xy, xz, yz) else { return None };
    Some(Inertia { xx, yy, zz, xy, xz, yz })
}
