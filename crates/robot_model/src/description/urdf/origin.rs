//! `<origin xyz="…" rpy="…"/>`.

use robot_symbolic::Formula;

use super::super::locations::AngleLocation;
use super::super::placement::{without_zero_moves, zeros};
use super::super::reader::Reader;
use super::element::Element;
use super::number::{formulas, words};
use crate::diagnostic::Span;
use crate::robot::Placement;

/// A placement with its places in the file.
#[derive(Default)]
pub(super) struct Origin {
    pub(super) placement: Placement,
    /// The place of the element.
    pub(super) span: Option<Span>,
    /// The place of the coordinates.
    pub(super) xyz: Option<Span>,
    /// The place of the angles.
    pub(super) rpy: Option<Span>,
}

/// Reads the `<origin>` of an element; the identity if there is none. Angles are about fixed axes: R = Rz(yaw)
/// Ry(pitch) Rx(roll).
pub(super) fn read(reader: &mut Reader<'_>, of: &Element<'_, '_>) -> Option<Origin> {
    let Some(element) = of.child(reader, "origin") else {
        return Some(Origin::default());
    };
    let attributes = [element.attribute("xyz"), element.attribute("rpy")];
    let mut vectors = [Some(zeros()), Some(zeros())];
    let examples = [("the origin", "0 0 0.1"), ("the roll, pitch and yaw angles", "0 0 1.57")];
    for ((vector, attribute), (what, example)) in vectors.iter_mut().zip(&attributes).zip(examples)
    {
        if let Some(attribute) = attribute {
            *vector = formulas::<3>(reader, attribute, what, example);
        }
    }
    let [Some(xyz), Some(rpy)] = vectors else {
        return None;
    };
    let [of_xyz, of_rpy] = attributes;
    let places = of_rpy.as_ref().map(|attribute| words(reader, attribute)).unwrap_or_default();
    let angles = rpy.iter().zip(places);
    let angles = angles.map(|(value, (_, place))| AngleLocation { value: value.clone(), place });
    reader.angles.extend(angles);
    Some(Origin {
        placement: placement(xyz, rpy),
        span: Some(element.span()),
        xyz: of_xyz.map(|attribute| attribute.span),
        rpy: of_rpy.map(|attribute| attribute.span),
    })
}

fn placement(xyz: [Formula; 3], rpy: [Formula; 3]) -> Placement {
    without_zero_moves(Placement::from_xyz_rpy(xyz, rpy))
}
