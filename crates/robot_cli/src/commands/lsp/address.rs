//! The addresses of documents: URIs, most of which name files.

use std::path::{Path, PathBuf};

use percent_encoding::percent_decode_str;
use robot_build::RobotFile;
use robot_model::description::shape::ROBOT_FILE;
use robot_model::diagnostic::Source;

/// The path that a `file` URI names; `None` for other URIs, such as those of documents that have never been saved, and
/// for names that are not UTF-8.
fn path(uri: &str) -> Option<PathBuf> {
    let (scheme, rest) = uri.split_once("://")?;
    let rest = rest.split(['?', '#']).next()?;
    let (host, encoded) = rest.split_at(rest.find('/')?);
    if !scheme.eq_ignore_ascii_case("file") {
        return None;
    }
    let path = percent_decode_str(encoded).decode_utf8().ok()?.into_owned();
    if !cfg!(windows) {
        return matches!(host, "" | "localhost").then(|| PathBuf::from(path));
    }
    // `/c:/robots/arm.toml`.
    let is_drive = path.as_bytes().get(2) == Some(&b':');
    match (host, path.strip_prefix('/')) {
        ("" | "localhost", Some(of_drive)) if is_drive => Some(PathBuf::from(of_drive)),
        ("" | "localhost", _) => Some(PathBuf::from(path)),
        _ => Some(PathBuf::from(format!("//{host}{path}"))),
    }
}

/// A document: a file with the text of the editor, or a text that is not a file.
pub(super) enum Addressed {
    File(RobotFile),
    Text(Source),
}

/// The document with this address and text.
pub(super) fn addressed(uri: &str, text: &str) -> Addressed {
    let source = |name: &str| Source { name: name.to_owned(), text: text.to_owned() };
    match path(uri) {
        Some(path) => {
            let source = source(&path.to_string_lossy());
            // A file that has never been saved has no other path.
            Addressed::File(RobotFile { path: path.canonicalize().unwrap_or(path), source })
        }
        None => Addressed::Text(source(uri)),
    }
}

/// Whether a document is meant as a robot file. Editors send every TOML and XML file, also those of other programs.
///
/// A URDF file is known by the extension `.urdf` or `.xacro`, or by an element `robot`; a robot file in TOML by a table
/// of its own or by `format` with a number.
pub(super) fn is_robot_file(uri: &str, text: &str) -> bool {
    let extension = Path::new(uri).extension().and_then(|extension| extension.to_str());
    let extension = extension.map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("urdf" | "xacro") => return true,
        Some("toml") => {}
        _ if text.trim_start_matches('\u{feff}').trim_start().starts_with('<') => {
            return text.contains("<robot");
        }
        _ => {}
    }
    text.lines().any(|line| is_of_robot(line.trim_start_matches('\u{feff}').trim()))
}

/// Tables that files of other programs have as well.
const COMMON: [&str; 4] = ["parameters", "code", "frame", "budget"];

/// Whether a line of TOML belongs to a robot file.
fn is_of_robot(line: &str) -> bool {
    if let Some(header) = line.strip_prefix('[') {
        let name = header.trim_start_matches('[').trim_start();
        let end = name.find(['.', ']', ' ', '\t']).unwrap_or(name.len());
        let name = name.get(..end).unwrap_or_default();
        return ROBOT_FILE.keys.iter().any(|key| key.name == name) && !COMMON.contains(&name);
    }
    let value = line.strip_prefix("format").and_then(|rest| rest.trim_start().strip_prefix('='));
    value.is_some_and(|value| value.trim_start().starts_with(|first: char| first.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn file_uris_are_paths() {
        for (uri, expected) in [
            ("file:///robots/arm.toml", Some("/robots/arm.toml")),
            ("file:///my%20robots/%C3%A9%23%25.toml", Some("/my robots/é#%.toml")),
            ("FILE://localhost/arm.toml#part", Some("/arm.toml")),
            ("file:///100%.toml", Some("/100%.toml")),
            ("file:///%ff.toml", None),
            ("file://elsewhere/arm.toml", None),
            ("untitled:Untitled-1", None),
            ("https://example.org/arm.toml", None),
            ("file://", None),
            ("", None),
        ] {
            assert_eq!(path(uri), expected.map(PathBuf::from), "{uri}");
        }
    }

    #[test]
    fn files_of_other_programs_are_known() {
        for (uri, text, expected) in [
            ("file:///arm.toml", "format = 1\n", true),
            ("file:///arm.toml", "\u{feff}format=1", true),
            ("untitled:1", "# arm\n[robot]\n", true),
            ("file:///arm.toml", "  [[ link ]]\n", true),
            ("file:///arm.toml", "[link.joint]\n", true),
            ("file:///arm.toml", "format = 2\n", true),
            ("file:///arm.toml", "", false),
            ("file:///Cargo.toml", "[package]\nname = \"robot\"\n[dependencies]\n", false),
            ("file:///starship.toml", "format = \"$all\"\n", false),
            ("file:///rustfmt.toml", "format_strings = true\n", false),
            ("file:///arm.urdf", "", true),
            ("file:///arm.XACRO", "", true),
            ("file:///arm.xml", "<?xml version=\"1.0\"?><robot name=\"a\">", true),
            ("file:///package.xml", "<package format=\"3\">", false),
        ] {
            assert_eq!(is_robot_file(uri, text), expected, "{uri} {text:?}");
        }
    }
}
