//! A page about a robot: a single HTML file that needs no other files.
//!
//! [`report`] is pure: from a robot file and the evidence about its code it makes the text of the page, with the same
//! bytes for the same input. All content from the robot file stays text, because only [`robot_document::markup`] turns
//! text into markup. The page's policy allows a browser to run and load only what the page itself contains: styles and
//! scripts, by their hashes, the font of equations and a WebAssembly module. Only [`reloading`] also allows pictures,
//! of which it loads the one beside the page.

mod costs;
mod drawing;
mod equations;
mod evidence;
mod folded;
mod formula;
mod live;
mod motion;
mod page;
mod parts;
mod plot;
mod reload;
pub mod scheme;
mod structure;
mod table;
mod tables;
mod text;

pub use evidence::{Accuracy, Compiled};
pub use scheme::{scheme_pdf, scheme_picture};

use robot_build::ablation::ablation;
use robot_build::{
    Effects, Errors, FunctionKind, Functions, Options, Programs, Source, programs, unsolvable,
};
use robot_document::markup::{Element, Node, element, holding};
use robot_dynamics::mechanism::{self, Snap};
use robot_model::robot::Robot;
use robot_model::snap;

use folded::folded;
use formula::Symbols;
use live::{Live, live};
use page::{Section, page};
use reload::Stamp;
use structure::Structure;

/// The input of a page.
#[derive(Clone, Debug)]
pub struct Input<'a> {
    /// The robot file.
    pub source: &'a Source,
    /// The options for generating the robot's code; the page chooses the functions.
    pub options: &'a Options,
    /// The tolerance in rad within which constant angles are shown as multiples of π/2 in tables and equations, unless
    /// the options or the file set one. The code then uses its own, smaller default; a tolerance that is set holds for
    /// both.
    pub snap: f64,
    /// The evidence from the compiler about the code.
    pub compiled: &'a Compiled,
    /// Compares the programs with an independent solver, or returns the reason why it cannot.
    pub compare: fn(&Programs) -> Result<Accuracy, String>,
    /// Whether the page contains a moving robot, provided that this adds at most 80 kB.
    pub live: bool,
}

/// The function whose operations are shown by pass and by option.
const FUNCTION: FunctionKind = FunctionKind::InverseDynamics(Effects::NONE);

/// The functions whose operations are shown.
const FUNCTIONS: [FunctionKind; 9] = [
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::InverseDynamics(Effects::WRENCH),
    FunctionKind::InverseDynamics(Effects::FRICTION),
    FunctionKind::LinkWrenches,
    FunctionKind::MassMatrix,
    FunctionKind::CoriolisMatrix,
    FunctionKind::Gravity,
    FunctionKind::Bias,
    FunctionKind::ForwardDynamics(Effects::NONE),
];

/// Makes the page about the robot of a file, as HTML that is also well-formed XML.
///
/// # Errors
///
/// All errors in the file and in the options.
pub fn report(input: &Input<'_>) -> Result<String, Errors> {
    let (robot, live, sections) = sections(input)?;
    Ok(page(&robot, live.as_ref(), sections, None))
}

/// The page about the robot of a file that is being edited.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reloading {
    /// The page, which reloads itself when the picture with [`Reloading::stamp`] beside it is replaced or removed.
    pub page: String,
    /// An SVG picture that identifies the page. It must be written after the page and beside it, under the page's name
    /// followed by `.svg`.
    pub stamp: String,
    /// The page of [`report`], without the script that reloads it.
    pub still: String,
}

/// Makes the page of [`report`] with a script that reloads it when a new page replaces it.
///
/// # Errors
///
/// The errors of [`report`].
pub fn reloading(input: &Input<'_>) -> Result<Reloading, Errors> {
    let (robot, live, sections) = sections(input)?;
    let still = page(&robot, live.as_ref(), sections.clone(), None);
    let stamp = Stamp::of(&still);
    let page = page(&robot, live.as_ref(), sections, Some(stamp));
    Ok(Reloading { page, stamp: stamp.picture(), still })
}

/// The robot of a file, its moving part, and the sections of the page.
fn sections(input: &Input<'_>) -> Result<(Robot, Option<Live>, Vec<Section>), Errors> {
    let robot = robot_build::read_with(input.source, input.options)?.robot;
    let base_frames = input.options.base_frames.unwrap_or(robot.base_frames);
    let robot = Robot { base_frames, ..robot };
    let tolerance = input.options.snap.or(robot.snap).unwrap_or(input.snap);
    let (shown, snaps) = mechanism::snapped(&robot, tolerance);
    let snapped = changed(&robot, input, &snaps, tolerance);
    let symbols = Symbols::of(&robot);
    let lacking = unsolvable(&robot, input.options);
    let is_available = |kind: &FunctionKind| {
        let lacks = lacking.iter().any(|lacking| lacking.functions.contains(kind));
        !lacks && kind.missing_in(&robot).is_none()
    };
    let functions: Vec<FunctionKind> = FUNCTIONS.into_iter().filter(is_available).collect();
    let (programs, omitted) = programs_within_limits(input, &functions)?;
    let (live, lacks) = match input.live.then(|| live(input, &robot)) {
        None => (None, None),
        Some(Ok(live)) => (Some(live), None),
        Some(Err(reason)) => {
            let words = format!("This robot cannot be moved on the page: {reason}");
            (None, Some(holding("p", words).class("note")))
        }
    };
    let sections = vec![
        kinematics(&shown, &symbols, [snapped, lacks]),
        Section {
            id: "masses",
            title: "Masses",
            body: std::iter::once(tables::masses(&shown, &symbols))
                .chain(tables::drives(&shown, &symbols))
                .map(Node::from)
                .collect(),
        },
        parameters(&shown, &symbols),
        Section { id: "equations", title: "Equations of motion", body: equations::forms(&shown) },
        structure(&shown),
        Section { id: "motion", title: "Joint torques by cause", body: motion::torques(&programs) },
        costs(input, &programs, [lacking.map(|lacking| format!("Note: {lacking}.")), omitted]),
        evidence(input, &programs),
    ];
    Ok((robot, live, sections))
}

/// Makes the programs of the functions and returns a note about omitted ones. If the programs need too many
/// expressions, those for pairs of joints are omitted and, if that is not enough, all except inverse dynamics.
fn programs_within_limits(
    input: &Input<'_>,
    functions: &[FunctionKind],
) -> Result<(Programs, Option<String>), Errors> {
    let made = |functions: &[FunctionKind]| {
        let functions = Functions::Chosen(functions.to_vec());
        programs(input.source, &Options { functions, ..input.options.clone() })
    };
    let is_of_pairs = |kind: &FunctionKind| {
        matches!(kind, FunctionKind::MassMatrix | FunctionKind::CoriolisMatrix)
    };
    let without_pairs: Vec<FunctionKind> =
        functions.iter().copied().filter(|kind| !is_of_pairs(kind)).collect();
    for chosen in [functions, &without_pairs] {
        match made(chosen) {
            Err(errors) if is_too_large(&errors) => {}
            Err(errors) => return Err(errors),
            Ok(programs) => return Ok((programs, omission(functions, chosen))),
        }
    }
    Ok((made(&[FUNCTION])?, omission(functions, &[FUNCTION])))
}

fn is_too_large(errors: &Errors) -> bool {
    errors.as_slice().iter().any(|error| matches!(error, robot_build::Error::TooLarge { .. }))
}

/// The note about functions that the page omits.
fn omission(all: &[FunctionKind], chosen: &[FunctionKind]) -> Option<String> {
    let omitted = all.iter().filter(|kind| !chosen.contains(kind)).map(|kind| kind.name());
    let omitted: Vec<&str> = omitted.collect();
    let words = "not shown: with them, the code of a robot with so many joints would exceed the limit on expressions.";
    (!omitted.is_empty()).then(|| format!("Note: {} are {words}", omitted.join(", ")))
}

/// The note about constant angles that are shown as multiples of π/2 although the code uses their values in the file.
fn changed(robot: &Robot, input: &Input<'_>, snaps: &[Snap], tolerance: f64) -> Option<Element> {
    let of_code = input.options.snap.or(robot.snap).unwrap_or(snap::DEFAULT);
    let count = snaps.iter().filter(|snap| snap.change.abs() > of_code).count();
    let (angles, are) = match count {
        0 => return None,
        1 => ("1 constant angle".to_owned(), "is shown as that multiple"),
        count => (format!("{count} constant angles"), "are shown as multiples"),
    };
    let words = format!(
        "In tables and equations, {angles} within {tolerance:e} rad of a multiple of π/2 {are}; the generated code uses \
         the values in the file."
    );
    Some(holding("p", words).class("note"))
}

/// The greatest height of a scheme in pixels that fits a screen with its caption.
const LOW: f64 = 520.0;

fn kinematics(robot: &Robot, symbols: &Symbols, notes: [Option<Element>; 2]) -> Section {
    let caption = holding("figcaption", scheme::CAPTION);
    let scheme::Picture { element: scheme, width, height } = scheme::scheme(robot);
    let is_beside = tables::fits_beside(robot, width);
    let figure = element("figure").with(scheme).with(caption);
    let figure = if height <= LOW { figure.class("low") } else { figure };
    let tables = std::iter::once(tables::kinematics(robot))
        .chain(tables::dh(robot, symbols))
        .chain(tables::frames(robot));
    let beside = element("div").with_all(notes.into_iter().flatten()).with_all(tables);
    let body = element("div").with(figure).with(beside);
    let body = if is_beside { body.class("beside") } else { body };
    Section { id: "kinematics", title: "Kinematics", body: vec![body.into()] }
}

fn parameters(robot: &Robot, symbols: &Symbols) -> Section {
    let none = "The robot file has no parameters: all values are numbers.";
    let table = tables::parameters(robot, symbols);
    let body = table.unwrap_or_else(|| holding("p", none)).into();
    Section { id: "parameters", title: "Parameters", body: vec![body] }
}

/// The explanation of the grids.
const STRUCTURE: &str = "The stronger the color of an entry, the more coordinates it depends on; entries marked \
    const depend only on parameters. An entry counts as independent of a coordinate if no other \
    value of the coordinate changes it, at random values of all symbols, including parameters.";

fn structure(robot: &Robot) -> Section {
    let grids = Structure::of(robot).build().map(Node::from);
    let body = std::iter::once(Node::from(holding("p", STRUCTURE))).chain(grids).collect();
    Section { id: "structure", title: "Structure of the equations", body }
}

fn costs(input: &Input<'_>, programs: &Programs, notes: [Option<String>; 2]) -> Section {
    let functions = Functions::Chosen(vec![FUNCTION]);
    let options = match ablation(input.source, &Options { functions, ..input.options.clone() }) {
        Ok(found) => costs::options(&found, FUNCTION.name())
            .map(|table| folded("Savings of each option and pass", [table])),
        Err(errors) => {
            let words = format!("The savings of the options are not shown: {errors}");
            Some(holding("p", words).class("note"))
        }
    };
    let [lacking, omitted] = notes.map(|note| note.map(|note| holding("p", note).class("note")));
    let parts = [
        costs::summary(&programs.module, FUNCTION.name()),
        lacking,
        omitted,
        Some(folded("Operations of each function", [costs::functions(&programs.module)])),
        costs::passes(&programs.module, FUNCTION.name())
            .map(|table| folded("Operations after each step of the generation", [table])),
        options,
    ];
    let body = parts.into_iter().flatten().map(Node::from).collect();
    Section { id: "costs", title: "Operations", body }
}

fn evidence(input: &Input<'_>, programs: &Programs) -> Section {
    let mut body = evidence::accuracy(&(input.compare)(programs));
    body.extend(evidence::compiled(input.compiled));
    Section { id: "evidence", title: "Evidence", body }
}
