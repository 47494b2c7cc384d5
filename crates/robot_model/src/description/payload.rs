//! `[payload]`: a body that the robot may carry; its ten parameters are set at run time.

use robot_symbolic::{Formula, Rational};

use super::draft::{DraftFrame, DraftLink, DraftPayload, Parent};
use super::link::named_parent;
use super::locations::{BodyLocation, ParameterLocation};
use super::names::Kind;
use super::range::{too_large, too_small};
use super::reader::{Named, Reader};
use super::shape::PAYLOAD;
use super::table::Table;
use crate::diagnostic::{Diagnostic, Span, code};
use crate::physics::{Verdict, judge};
use crate::robot::{Body, Inertia, Link, Move, Parameter, Payload, Placement};
use crate::unit::Unit;

/// Parameters and their places.
type Parameters = (Vec<Parameter>, Vec<ParameterLocation>);

/// What the parent of a payload is.
const CARRIER: &str = "the name of a moving link, of a tip or of a frame";

/// The keys of the body of a link, which a payload does not have, and the remedy for them.
const BODY: [&str; 3] = ["mass", "center_of_mass", "inertia"];
const BODY_HELP: &str = "the mass, center of mass and inertia of a payload are parameters, `payload_mass` and so on, \
                         whose values are set where the equations are used; write a body that is always there as a \
                         fixed `[[link]]`";

/// Reads the table and adds the parameters of the payload. They are 0 by default: the robot carries nothing.
pub(super) fn read(
    reader: &mut Reader<'_>,
    root: &mut Table<'_>,
    links: &[DraftLink],
    frames: &[DraftFrame],
    parameters: &mut Parameters,
) -> Option<DraftPayload> {
    let entry = root.get("payload")?;
    let span = entry.key.clone();
    let mut table = reader.table(entry.value, &PAYLOAD)?;
    let last = links.len().checked_sub(1).map_or(Parent::Base, Parent::Link);
    let parent =
        table.get("parent").map_or(Some(last), |entry| named_parent(reader, &entry, CARRIER));
    for key in BODY {
        if let Some(entry) = table.misplaced(key) {
            let message = format!("`{key}` is not a key of {}", PAYLOAD.what);
            let error = Diagnostic::error(code::UNKNOWN_KEY, message);
            reader.report(error.at(&entry.key, "unknown key").help(BODY_HELP));
        }
    }
    table.finish(reader);
    let frame = frames
        .iter()
        .find(|frame| matches!(&parent, Some(Parent::Name(name)) if name.name == frame.name.name));
    let (parent, placement) = match frame {
        Some(frame) => (Some(frame.parent.clone()), frame.placement.clone()),
        None => (parent, Placement::default()),
    };
    for mut parameter in payload_parameters() {
        if let Some(value) = reader.options.value(&parameter.name) {
            parameter.value = Some(value.clone());
        }
        let name = &parameter.name;
        let named =
            reader.check_name(name, &span, "a parameter of the payload", Kind::Identifier)?;
        if let Some(diagnostic) = reader.symbols.add(&named) {
            reader.report(diagnostic.help(format!(
                "`[payload]` defines the parameters `payload_…`; rename your own `{name}`"
            )));
        }
        parameters.0.push(parameter);
        let place = ParameterLocation { name: span.clone(), ..ParameterLocation::default() };
        parameters.1.push(place);
    }
    check(reader, &parameters.0, &span);
    Some(DraftPayload { parent: parent?, placement, place: span })
}

/// Reports values that are too large or too small, a negative mass, and a tensor that no body can have. A mass of 0 is
/// accepted with any possible tensor.
fn check(reader: &mut Reader<'_>, parameters: &[Parameter], span: &Span) {
    let Payload { mass, center_of_mass, inertia } = names();
    let value = |name: &String| {
        let parameter = parameters.iter().find(|parameter| parameter.name == *name);
        parameter.and_then(|parameter| parameter.value.as_ref()).map_or(0.0, Rational::to_f64)
    };
    for name in [&mass].into_iter().chain(&center_of_mass).chain(&inertia) {
        let (what, value) = (format!("`{name}`"), value(name));
        let wrong = too_large(&what, value, span).or_else(|| too_small(&what, value, span));
        if let Some(diagnostic) = wrong {
            reader.report(diagnostic);
        }
    }
    let severity = reader.options.unphysical();
    let carried = value(&mass);
    if carried < 0.0 {
        let diagnostic = Diagnostic::error(code::MASS, format!("the mass is {carried} kg"));
        let diagnostic = diagnostic.at(span, format!("`{mass}`")).help("correct the value");
        reader.report(diagnostic.graded(severity));
    }
    let verdict = judge(inertia.each_ref().map(value));
    if verdict != Verdict::Possible {
        let diagnostic = Diagnostic::error(verdict.code(), verdict.message());
        let diagnostic = diagnostic.at(span, verdict.label()).help("correct the values");
        reader.report(diagnostic.graded(severity));
    }
}

/// The names of the payload's parameters.
fn names() -> Payload {
    let named = |name: &str| format!("payload_{name}");
    Payload {
        mass: named("mass"),
        center_of_mass: ["x", "y", "z"].map(named),
        inertia: Inertia::NAMES.map(named),
    }
}

/// The parameters in the order of [`names`].
fn payload_parameters() -> Vec<Parameter> {
    let Payload { mass, center_of_mass, inertia } = names();
    let parameter = |name: String, letter: &str, upper: &str, unit: &str, doc: &str| Parameter {
        name,
        value: Some(Rational::ZERO),
        unit: Unit::parse(unit).ok(),
        latex: Some(format!("{letter}_{{\\mathrm{{P}}}}{upper}")),
        doc: Some(doc.to_owned()),
    };
    let mut payload_parameters = vec![parameter(mass, "m", "", "kg", "mass of the payload")];
    for (name, axis) in center_of_mass.into_iter().zip(["x", "y", "z"]) {
        let doc = format!("{axis} component of the payload's center of mass");
        payload_parameters.push(parameter(name, axis, "", "m", &doc));
    }
    for (name, axes) in inertia.into_iter().zip(Inertia::NAMES) {
        let doc = "entry of the payload's inertia tensor about its center of mass";
        payload_parameters.push(parameter(name, "J", &format!("^{{{axes}}}"), "kg m^2", doc));
    }
    payload_parameters
}

/// Attaches the payload to the link that carries it; `placement` is in that link's frame.
pub(super) fn attach(
    reader: &mut Reader<'_>,
    carrier: Option<(&mut Link, &mut Vec<BodyLocation>)>,
    placement: Placement,
    place: &Named,
) -> Option<Payload> {
    let Some((link, places)) = carrier else {
        reader.report(
            Diagnostic::error(code::NO_EFFECT, "the payload is fixed to the base")
                .at(&place.span, "it does not move")
                .help("set `parent` to a link that moves, or to a frame on one"),
        );
        return None;
    };
    // The link's own mass must not be 0, because the mass of the payload may be.
    if link.bodies.iter().all(|body| Reader::is_zero(&body.mass)) {
        let message = format!("the link `{}` carries the payload and is massless", link.name);
        reader.report(
            Diagnostic::error(code::MASS, message)
                .at(&place.span, "without the payload this link has no mass")
                .help("give the link a mass, or attach the payload to a link with mass"),
        );
        return None;
    }
    let payload = names();
    let symbol = |name: &String| Formula::symbol(name);
    let [xx, yy, zz, xy, xz, yz] = payload.inertia.each_ref().map(symbol);
    let center = Move::Translate(payload.center_of_mass.each_ref().map(symbol));
    link.bodies.push(Body {
        name: place.name.clone(),
        mass: symbol(&payload.mass),
        placement: placement.then(&Placement(vec![center])),
        inertia: Inertia { xx, yy, zz, xy, xz, yz },
    });
    let location = BodyLocation { name: place.span.clone(), ..BodyLocation::default() };
    places.push(BodyLocation { unchecked: true, ..location });
    Some(payload)
}
