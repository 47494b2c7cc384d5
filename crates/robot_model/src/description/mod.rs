//! Reading of robots from files.
//!
//! A reader turns the text of a file into a checked [`Robot`] and a table of the places of its parts ([`Locations`]),
//! or into a list of all errors ([`Diagnostics`]). No value is ever silently replaced or repaired.
//!
//! `file` lowers the tables of a TOML file, and `urdf` the elements of a URDF file, to a draft in which fixed links are
//! still separate; `tree` puts the links in order; `assemble` merges fixed links and builds the robot. [`import()`]
//! writes the draft as a robot file in TOML.

mod assemble;
mod body;
mod budget;
mod compute;
mod defined;
mod dh;
mod dimensions;
mod draft;
mod drive;
mod export;
mod file;
mod frames;
mod free_base;
pub(crate) mod inertia;
mod input_limits;
mod joint;
mod latex;
mod link;
mod locations;
pub mod meaning;
mod mimic;
mod names;
mod options;
mod parameters;
mod payload;
pub(crate) mod placement;
mod range;
mod reader;
pub mod shape;
mod strings;
mod syntax;
mod table;
mod tree;
mod urdf;
mod value;
mod wanted;

pub use budget::{Budget, Limit};
pub use defined::undefined;
pub use input_limits::{MAX_BUNDLES, MAX_BYTES, MAX_JOINTS, MAX_LINKS, MAX_PARAMETERS};
pub use locations::{
    AngleLocation, BodyLocation, DroppedBody, FrameLocation, LinkLocation, Locations,
    ParameterLocation,
};
pub use options::{Format, Options};
pub use range::{LARGEST, LEAST};
pub use wanted::{Code, check_bundle_name};

use std::path::Path;

use crate::diagnostic::{Diagnostic, Diagnostics, Severity, Source, Span, code};
use crate::robot::{Parameter, Robot};
use draft::Draft;
pub use reader::is_finite;
use reader::{Named, Reader};
use wanted::Wanted;

/// The result of reading a robot file.
#[derive(Clone, Debug)]
pub struct Described {
    /// The robot.
    pub robot: Robot,
    /// The places in the file of the robot's parts.
    pub locations: Locations,
    /// Warnings about likely mistakes, with the source text.
    pub warnings: Diagnostics,
    /// Notes about the choices that the reader made because the format leaves them open, and about content that is not
    /// part of the robot. They are meant for files that were not written for this program.
    pub choices: Diagnostics,
    /// Content of the file that affects the dynamics but is not part of the robot, such as `the friction of 6 joints`.
    pub left_out: Vec<String>,
    /// The functions to generate if the caller names none.
    pub code: Code,
    /// The limits of generated code.
    pub budgets: Vec<Budget>,
    /// The format of the file.
    pub format: Format,
}

/// A description in another format, converted to a robot file.
#[derive(Clone, Debug)]
pub struct Import {
    /// The robot file in TOML.
    pub toml: String,
    /// The robot that the file describes, with its warnings and the reader's choices.
    pub described: Described,
}

/// Reads a robot file. The extension of the name determines the format: `.toml`, or `.urdf`, `.xacro` and `.xml` for
/// URDF. For other names, the text does.
///
/// # Errors
///
/// All errors in the file, in the order of their places.
pub fn read(name: &str, text: &str) -> Result<Described, Diagnostics> {
    read_with(name, text, &Options::default())
}

/// Reads a robot file like [`read`], with options.
///
/// # Errors
///
/// All errors in the file, in the order of their places.
pub fn read_with(name: &str, text: &str, options: &Options) -> Result<Described, Diagnostics> {
    described(format_of(name, text), name, text, options).map(|(described, _)| described)
}

/// Reads a robot file in TOML.
///
/// `name` is the name that messages show, usually the path; `text` is the text of the file. A byte order mark and CRLF
/// line endings are accepted.
///
/// # Errors
///
/// All errors in the file, in the order of their places.
pub fn read_toml(name: &str, text: &str) -> Result<Described, Diagnostics> {
    described(Format::Toml, name, text, &Options::default()).map(|(described, _)| described)
}

/// Reads a robot from URDF, the description format of ROS.
///
/// The base is the root link. Fixed links are merged, and their frames are kept as named frames. A joint that mimics
/// another has no coordinate of its own. Meshes are never opened. [`Described::choices`] lists the choices that the
/// format leaves open.
///
/// # Errors
///
/// All errors in the file, in the order of their places.
pub fn read_urdf(name: &str, text: &str) -> Result<Described, Diagnostics> {
    described(Format::Urdf, name, text, &Options::default()).map(|(described, _)| described)
}

/// Writes a description as a robot file in TOML, with the names and values of the source. Reading the written file
/// gives the same robot, and the same description always gives the same text. A file that already is a robot file is
/// returned unchanged.
///
/// # Errors
///
/// All errors in the file, in the order of their places.
pub fn import(name: &str, text: &str, options: &Options) -> Result<Import, Diagnostics> {
    let (described, lowered) = described(format_of(name, text), name, text, options)?;
    let toml = match described.format {
        Format::Toml => text.to_owned(),
        Format::Urdf => export::to_toml(&lowered, name),
    };
    Ok(Import { toml, described })
}

/// Decodes the bytes of a robot file of any format as text.
///
/// # Errors
///
/// An error if the file is too large or not UTF-8.
pub fn decode(name: &str, bytes: Vec<u8>) -> Result<String, Diagnostics> {
    if bytes.len() > MAX_BYTES {
        return Err(too_large(name));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        let diagnostic = Diagnostic::error(code::NOT_TEXT, "the file is not UTF-8 text")
            .at(&(valid..valid), "not UTF-8 from here on")
            .help("save the file as UTF-8");
        let source = Source { name: name.to_owned(), text };
        Diagnostics::new(source, vec![diagnostic])
    })
}

/// A file after lowering, with its links in order: parents before children.
#[derive(Clone)]
struct Lowered {
    draft: Draft,
    order: Vec<usize>,
    parameters: (Vec<Parameter>, Vec<ParameterLocation>),
    wanted: Wanted,
    /// The budgets, with the names of functions of single frames, which are resolved when the robot is known.
    budgets: Vec<(Budget, Option<Named>)>,
}

fn format_of(name: &str, text: &str) -> Format {
    let extension = Path::new(name).extension().and_then(|extension| extension.to_str());
    match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("toml") => Format::Toml,
        Some("urdf" | "xacro" | "xml") => Format::Urdf,
        _ if text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']).starts_with('<') => {
            Format::Urdf
        }
        _ => Format::Toml,
    }
}

fn described(
    format: Format,
    name: &str,
    text: &str,
    options: &Options,
) -> Result<(Described, Lowered), Diagnostics> {
    if text.len() > MAX_BYTES {
        return Err(too_large(name));
    }
    let mut reader = Reader::new(text, options);
    let lowered = match format {
        Format::Toml => file::lower(&mut reader),
        Format::Urdf => urdf::lower(&mut reader, options),
    };
    let built = lowered.and_then(|lowered| {
        let built = build(&mut reader, lowered.clone(), format)?;
        Some((built, lowered))
    });
    let source = Source { name: name.to_owned(), text: text.to_owned() };
    let left_out = std::mem::take(&mut reader.left_out);
    let (choices, found): (Vec<_>, Vec<_>) =
        reader.found.into_iter().partition(|found| found.severity == Severity::Note);
    let found = Diagnostics::new(source.clone(), found);
    match built {
        Some((Built { robot, locations, code, budgets }, lowered)) if !found.has_errors() => {
            let choices = Diagnostics::new(source, choices);
            let warnings = found;
            let described =
                Described { robot, locations, warnings, choices, left_out, code, budgets, format };
            Ok((described, lowered))
        }
        _ => Err(found),
    }
}

/// The result of lowering a file.
struct Built {
    robot: Robot,
    locations: Locations,
    code: Code,
    budgets: Vec<Budget>,
}

/// Builds the robot of a lowered file, if the file has no errors.
fn build(reader: &mut Reader<'_>, lowered: Lowered, format: Format) -> Option<Built> {
    let Lowered { draft, order, parameters, wanted, budgets } = lowered;
    if draft.links.iter().all(|link| link.joint.kind.is_none()) {
        let last = draft.links.last().map(|link| link.places.joint.clone());
        let diagnostic = Diagnostic::error(code::NO_JOINT, "the robot has no moving joint")
            .at(&last.unwrap_or_default(), "");
        reader.report(diagnostic.help(match format {
            Format::Toml => "add a `[[link]]` with a revolute or prismatic joint",
            Format::Urdf => "add a `<joint>` of type revolute, continuous or prismatic",
        }));
    }
    let (robot, mut locations) = assemble::robot(reader, draft, &order, parameters);
    locations.angles = std::mem::take(&mut reader.angles);
    // Parameters may be used in content that could not be read because of an error, so their use is not checked.
    if reader.failed() {
        return None;
    }
    range::check(reader, &robot, &locations);
    let code = wanted.code(reader, &robot);
    let budgets = budget::of_robot(reader, &robot, budgets);
    let stands = free_base::check(reader, &robot, &locations);
    if format == Format::Toml {
        unused(reader);
        if !stands {
            no_effect(reader, &locations);
        }
    }
    wrenches_on_base(reader, &robot, &locations);
    Some(Built { robot, locations, code, budgets })
}

/// Warns about parameters that are not used.
fn unused(reader: &mut Reader<'_>) {
    let unused: Vec<(String, Span)> = reader
        .parameters()
        .iter()
        .filter(|known| !known.used)
        .map(|known| (known.name.clone(), known.span.clone()))
        .collect();
    for (name, span) in unused {
        reader.report(
            Diagnostic::warning(
                code::UNUSED,
                format!("the robot does not use the parameter `{name}`"),
            )
            .at(&span, "")
            .help("remove it, or use it in place of a value"),
        );
    }
}

/// Warns about masses that have no effect because they are fixed to the base.
fn no_effect(reader: &mut Reader<'_>, locations: &Locations) {
    for dropped in &locations.dropped {
        reader.report(dropped.diagnostic());
    }
}

/// Warns about wrenches of tips that are fixed to the base, which do not affect any joint torque.
fn wrenches_on_base(reader: &mut Reader<'_>, robot: &Robot, locations: &Locations) {
    for (frame, places) in robot.frames.iter().zip(&locations.frames) {
        if frame.wrench.is_none() || frame.link.is_some() {
            continue;
        }
        let message = format!("the wrench of `{}` has no effect", frame.name);
        reader.report(
            Diagnostic::warning(code::NO_EFFECT, message)
                .at(&places.name, "fixed to the base")
                .help("choose a link that moves as its `parent`, or write `[[frame]]` if only its pose is wanted"),
        );
    }
}

/// The error for a file that is too large; its text is not shown in the message.
fn too_large(name: &str) -> Diagnostics {
    let message = format!("the file has more than {MAX_BYTES} bytes, the most that are read");
    let diagnostic = Diagnostic::error(code::TOO_LARGE, message)
        .because(
            "a robot of 64 joints, fully commented, needs a tenth of that, and so do all equations of a paper",
        )
        .help("remove everything else, such as meshes, logs and trajectories");
    let source = Source { name: name.to_owned(), text: String::new() };
    Diagnostics::new(source, vec![diagnostic])
}
