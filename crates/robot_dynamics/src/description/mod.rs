//! Robots from files.
//!
//! A reader turns the text of a file into a checked [`Robot`] and a side table of places
//! ([`Locations`]), or into everything that is wrong with it ([`Diagnostics`]). No value is ever
//! replaced or repaired in silence.
//!
//! The way through: [`read_toml`] parses the text, `file` lowers its tables to a draft whose
//! names are unresolved, `tree` puts the links in order, `assemble` merges fixed links and builds
//! the robot.

mod assemble;
mod body;
mod dh;
mod draft;
mod drive;
mod file;
mod frames;
mod inertia;
mod joint;
mod latex;
mod link;
mod locations;
mod names;
mod parameters;
mod placement;
mod reader;
mod strings;
mod syntax;
mod table;
mod tree;
mod value;

pub use locations::{BodyLocation, FrameLocation, LinkLocation, Locations, ParameterLocation};

use crate::diagnostic::{Diagnostic, Diagnostics, Source, code};
use crate::model::Robot;

/// A robot file of more bytes than this is refused.
pub const MAX_BYTES: usize = 1 << 20;
/// A robot of more joints than this is refused.
pub const MAX_JOINTS: usize = 64;
/// A robot file of more links, fixed ones and all, is refused; so many frames and tips, too.
pub const MAX_LINKS: usize = 512;
/// A robot of more parameters than this is refused.
pub const MAX_PARAMETERS: usize = 4096;

/// What a robot file gives.
#[derive(Clone, Debug)]
pub struct Described {
    /// The robot.
    pub robot: Robot,
    /// Where in the file its parts are.
    pub locations: Locations,
    /// What looks like a slip, with the source.
    pub warnings: Diagnostics,
}

/// Reads a robot file in TOML.
///
/// `name` is shown in messages, usually the path; `text` is the file's text. A byte order mark and
/// CRLF line ends are accepted.
///
/// # Errors
///
/// Everything that is wrong with the file, in the order of the places.
pub fn read_toml(name: &str, text: &str) -> Result<Described, Diagnostics> {
    let source = || Source { name: name.to_owned(), text: text.to_owned() };
    if text.len() > MAX_BYTES {
        return Err(too_large(name, text.len()));
    }
    let (described, list) = file::read(text);
    let found = Diagnostics::new(source(), list);
    match described {
        Some((robot, locations)) if !found.has_errors() => {
            Ok(Described { robot, locations, warnings: found })
        }
        _ => Err(found),
    }
}

/// The bytes of a robot file as text, whatever its format.
///
/// # Errors
///
/// A file that is too large, or no UTF-8.
pub fn decode(name: &str, bytes: Vec<u8>) -> Result<String, Diagnostics> {
    if bytes.len() > MAX_BYTES {
        return Err(too_large(name, bytes.len()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        let diagnostic = Diagnostic::error(code::NOT_TEXT, "the file is not UTF-8 text")
            .at(&(valid..valid), "no UTF-8 from here on")
            .help("save the file as UTF-8");
        let source = Source { name: name.to_owned(), text };
        Diagnostics::new(source, vec![diagnostic])
    })
}

/// The source is left out: nobody wants it in a message.
fn too_large(name: &str, bytes: usize) -> Diagnostics {
    let message = format!("the file has {bytes} bytes; a robot file has at most {MAX_BYTES}");
    let diagnostic = Diagnostic::error(code::TOO_LARGE, message)
        .because("a robot of 64 joints with every figure and a comment takes a tenth of that")
        .help("leave out what does not describe the robot: meshes, logs, trajectories");
    let source = Source { name: name.to_owned(), text: String::new() };
    Diagnostics::new(source, vec![diagnostic])
}
