//! Mass, center of mass and inertia of a link.

use super::inertia::{self, Tensor};
use super::locations::BodyLocation;
use super::placement::{without_zero_moves, zero, zeros};
use super::reader::{Named, Reader};
use super::table::Table;
use super::value::{Quantity, quantity};
use crate::diagnostic::{Diagnostic, code};
use crate::robot::{Body, Move, Placement};

const MASS: Quantity = quantity("the mass", 1, 0, 0);
const CENTER: Quantity = quantity("the center of mass", 0, 1, 0);

/// Reads the body of a link; `None` if the link has no mass. A moving link without mass must say so explicitly.
pub(super) fn read(
    reader: &mut Reader<'_>,
    table: &mut Table<'_>,
    name: &Named,
    moving: bool,
) -> Option<(Body, BodyLocation)> {
    let mut place = BodyLocation { name: name.span.clone(), ..BodyLocation::default() };
    let massless = table.get("massless");
    let is_massless =
        massless.as_ref().and_then(|entry| reader.boolean(entry.value)).unwrap_or_default();
    let entry = table.get("mass");
    if let (Some(entry), Some(massless), true) = (&entry, &massless, is_massless) {
        reader.report(
            Diagnostic::error(code::CONFLICT, "a massless link cannot have a `mass`")
                .at(&entry.key, "a mass")
                .and_at(&massless.key, "massless")
                .help("keep one of them"),
        );
    }
    let mass = entry.as_ref().map(|entry| {
        let mass = reader.formula(entry.value, MASS);
        place.mass = Some(entry.value.span());
        if let Some(value) = reader.known(&mass).filter(|value| *value <= 0.0) {
            let severity = match value == 0.0 {
                true => reader.options.massless(),
                false => reader.options.unphysical(),
            };
            let diagnostic = not_positive(value, moving).graded(severity);
            reader.report(diagnostic.at(&entry.value.span(), "not above 0"));
        }
        mass
    });
    let present = mass.is_some();
    let others = ["center_of_mass", "inertia"].map(|key| table.has(key));
    let is_missing = !present && !is_massless && !table.misspells(reader, "mass");
    if is_missing && (moving || others.contains(&true)) {
        let missing = mass_missing(&name.name).at(&table.span, "`mass` is missing");
        reader.report(missing.graded(reader.options.massless()));
    }
    let center = match required(reader, table, "center_of_mass", present, "[0, 0, 0]") {
        Some(entry) => {
            place.center_of_mass = Some(entry.value.span());
            reader.vector(entry.value, CENTER)
        }
        None => zeros(),
    };
    let mass = mass.unwrap_or_else(zero);
    let example = "{ xx = …, yy = …, zz = … }";
    let tensor = match required(reader, table, "inertia", present, example) {
        Some(entry) => inertia::read(reader, &entry, &mass, &center, &mut place),
        None => Tensor::none(),
    };
    if !present && place.inertia.is_none() {
        return None;
    }
    let mut moves = vec![Move::Translate(center)];
    moves.extend(tensor.turns);
    let body = Body {
        name: name.name.clone(),
        mass,
        placement: without_zero_moves(Placement(moves)),
        inertia: tensor.inertia,
    };
    Some((body, place))
}

fn mass_missing(link: &str) -> Diagnostic {
    // The name can be missing or invalid, which is another error.
    let link = if link.is_empty() { "a link".to_owned() } else { format!("the link `{link}`") };
    Diagnostic::error(code::MISSING_KEY, format!("{link} has no mass"))
        .because("a massless link silently drops out of the equations")
        .help("add `mass`, or write `massless = true` if the link is meant to be massless")
}

fn required<'a>(
    reader: &mut Reader<'_>,
    table: &mut Table<'a>,
    key: &'static str,
    needed: bool,
    example: &str,
) -> Option<super::table::Entry<'a>> {
    if needed { table.require(reader, key, &format!("{key} = {example}")) } else { table.get(key) }
}

fn not_positive(value: f64, moving: bool) -> Diagnostic {
    let help = match (value == 0.0, moving) {
        (true, true) => "if the link is massless, write `massless = true` instead of `mass`",
        (true, false) => "leave out `mass`: a fixed link does not need it",
        (false, _) => "correct the value",
    };
    Diagnostic::error(code::MASS, format!("the mass is {value} kg"))
        .because("the mass of a body is positive; otherwise the mass matrix may not be positive definite")
        .help(help)
}
