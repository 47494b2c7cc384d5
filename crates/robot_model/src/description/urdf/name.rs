//! Converts names of URDF, which may be any text, to names of robot files.

use super::super::names::{Kind, reserved};
use super::super::reader::{Named, Reader};
use super::element::Attribute;
use crate::diagnostic::{Diagnostic, code, is_invisible, quote};

/// A name as it is written in the file, and as it is here.
#[derive(Clone, Debug)]
pub(super) struct Name<'a> {
    pub(super) written: &'a str,
    pub(super) named: Named,
}

/// The name of a link or joint. Each character that names cannot have becomes `_`, and `_` is put before a leading `-`
/// or `.`. The name `base` denotes the base itself, so a link with this name is renamed.
pub(super) fn label<'a>(
    reader: &mut Reader<'_>,
    attribute: &Attribute<'a>,
    what: &str,
) -> Option<Name<'a>> {
    let written = attribute.text;
    let mut name = plain(written, |character| {
        character.is_ascii_alphanumeric() || matches!(character, '_' | '-' | '.')
    });
    if name.starts_with(['-', '.']) {
        name.insert(0, '_');
    }
    if name == "base" {
        // `base_link` and `base_joint` often occur in the same file.
        name = "base_frame".to_owned();
    }
    let named = reader.check_name(&name, &attribute.span, what, Kind::Label)?;
    Some(Name { written, named })
}

impl Name<'_> {
    /// Reports a note if the name has changed.
    pub(super) fn tell(&self, reader: &mut Reader<'_>) {
        tell(reader, self.written, &self.named);
    }
}

/// The name of the robot, an identifier. `-` and `.` also become `_`. A name that begins with a digit or has only
/// underscores gets the prefix `robot_`, and a reserved name the suffix `_robot`.
pub(super) fn identifier(reader: &mut Reader<'_>, attribute: &Attribute<'_>) -> Option<Named> {
    let mut name =
        plain(attribute.text, |character| character.is_ascii_alphanumeric() || character == '_');
    let nameless = !name.is_empty() && name.bytes().all(|byte| byte == b'_');
    if nameless || name.starts_with(|first: char| first.is_ascii_digit()) {
        name.insert_str(0, "robot_");
    }
    if reserved(&name).is_some() {
        name.push_str("_robot");
    }
    let named = reader.check_name(&name, &attribute.span, "a robot", Kind::Identifier)?;
    tell(reader, attribute.text, &named);
    Some(named)
}

fn tell(reader: &mut Reader<'_>, written: &str, named: &Named) {
    if written == named.name {
        return;
    }
    let message = format!("`{}` is renamed `{}`", quote(written), named.name);
    reader.report(
        Diagnostic::note(code::TAKEN_NAME, message)
            .at(&named.span, "not a valid name in equations, code and files"),
    );
}

/// The text with `_` in place of characters that are not allowed. Text with invisible characters is returned unchanged,
/// so that it will be refused.
fn plain(text: &str, allowed: impl Fn(char) -> bool) -> String {
    let hides = |character: char| {
        (character.is_control() && !character.is_whitespace()) || is_invisible(character)
    };
    if text.contains(hides) {
        return text.to_owned();
    }
    text.chars().map(|character| if allowed(character) { character } else { '_' }).collect()
}
