//! Parses XML text into a tree of elements and explains XML errors in terms of robot files.

use roxmltree::{Document, Error, ParsingOptions, TextPos};

use super::super::reader::Reader;
use super::guard;
use crate::diagnostic::{Diagnostic, Span, code, quote};

/// Parses the text and reports syntax errors.
pub(super) fn parse<'i>(reader: &mut Reader<'i>) -> Option<Document<'i>> {
    if let Some(diagnostic) = guard::check(reader.text) {
        reader.report(diagnostic);
        return None;
    }
    let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
    match Document::parse_with_options(reader.text, options) {
        Ok(document) => Some(document),
        Err(error) => {
            let diagnostic = words(reader.text, &error);
            reader.report(diagnostic);
            None
        }
    }
}

fn words(text: &str, error: &Error) -> Diagnostic {
    let whole = matches!(error, Error::UnclosedRootNode | Error::UnexpectedEndOfStream);
    let place = match error {
        _ if whole => text.len()..text.len(),
        Error::DtdDetected => text.find("<!DOCTYPE").map_or(0..0, |at| at..at + "<!DOCTYPE".len()),
        _ => byte_of(text, error.pos()),
    };
    let syntax = |message: String| Diagnostic::error(code::SYNTAX, message).at(&place, "");
    if let Some((message, help)) = of_characters(text, &place, error) {
        return syntax(message.to_owned()).help(help);
    }
    match error {
        Error::UnknownNamespace(prefix, _) if prefix == "xacro" => template(&place),
        Error::UnknownNamespace(prefix, _) => {
            syntax(format!("the prefix `{}` is not declared", quote(prefix)))
                .help("declare it in the root element: xmlns:prefix=\"…\", or remove it")
        }
        Error::UnexpectedCloseTag(expected, found, _) => {
            syntax(format!("`</{}>` cannot close `<{}>`", quote(found), quote(expected)))
                .help(format!("close `<{}>` first", quote(expected)))
        }
        Error::DuplicatedAttribute(name, _) => {
            syntax(format!("the attribute `{}` is given twice", quote(name)))
                .help("keep one of them")
        }
        Error::DtdDetected => {
            syntax("the file has a document type declaration: `<!DOCTYPE …>`".to_owned())
                .because("document types can load files and expand to enormous texts")
                .help("remove it")
        }
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            syntax("the file ends inside an element".to_owned())
                .help("close every element: `</robot>` at the end")
        }
        Error::NoRootNode => syntax("the file has no elements".to_owned())
            .help("describe the robot in `<robot name=\"arm\"> … </robot>`"),
        Error::UnknownEntityReference(name, _) => {
            syntax(format!("`&{};` is not a known entity", quote(name)))
                .help("write the character, or `&amp;`, `&lt;`, `&gt;`, `&quot;`, `&apos;`")
        }
        Error::DuplicatedNamespace(name, _) => {
            syntax(format!("the prefix `{}` is declared twice", quote(name)))
                .help("keep one of the declarations")
        }
        Error::UnexpectedDeclaration(_) => syntax(
            "`<?xml …?>` is not at the start of the file".to_owned(),
        )
        .help("remove what precedes it, for example an empty line, or remove the declaration"),
        other => syntax(format!("invalid XML: {}", without_place(other)))
            .help("write an element as `<name attribute=\"value\"/>`"),
    }
}

/// The message and the remedy for characters that cannot stand where they do.
fn of_characters(text: &str, place: &Span, error: &Error) -> Option<(&'static str, &'static str)> {
    let is_number = || text.get(place.start..).is_some_and(|at| at.starts_with("&#"));
    Some(match error {
        Error::MalformedEntityReference(_) if is_number() => (
            "the number after `&#` is not that of a character of XML",
            "write the character itself, or remove the reference",
        ),
        Error::MalformedEntityReference(_) => {
            ("`&` is not escaped", "write the character `&` as `&amp;`")
        }
        Error::InvalidComment(_) => {
            ("the comment contains `--`", "write one dash there; a comment ends with `-->`")
        }
        Error::UnknownToken(_) if !text.trim_start().starts_with('<') => (
            "the file is not XML",
            "the name of a robot file in TOML ends in `.toml`: rename the file",
        ),
        Error::UnknownToken(_) => (
            "here is text that XML does not allow",
            "remove it; neither text nor an element can follow the root element",
        ),
        _ => return None,
    })
}

/// The message of the parser without the line and column, which the diagnostic shows.
fn without_place(error: &Error) -> String {
    error.to_string().replace(&format!(" at {}", error.pos()), "")
}

/// The error for a file that is a template.
pub(super) fn template(place: &Span) -> Diagnostic {
    Diagnostic::error(code::XACRO, "the file is a xacro template, not a robot file")
        .at(place, "not expanded")
        .because(
            "templates are programs that can read files and compute values; this program does not run \
            them",
        )
        .help(
            "expand it and use the result: `xacro robot.urdf.xacro > robot.urdf` (part of ROS, \
             or `pip install xacro`)",
        )
}

/// The byte at a line and column. Both are counted from 1, the column in characters.
fn byte_of(text: &str, position: TextPos) -> Span {
    let line = usize::try_from(position.row).unwrap_or(1).saturating_sub(1);
    let start = match line {
        0 => 0,
        _ => text.match_indices('\n').nth(line - 1).map_or(text.len(), |(at, _)| at + 1),
    };
    let rest = text.get(start..).unwrap_or_default();
    let column = usize::try_from(position.col).unwrap_or(1).saturating_sub(1);
    let at = start + rest.char_indices().nth(column).map_or(rest.len(), |(at, _)| at);
    let length = text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    at..at + length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_errors_keep_the_words_of_the_parser() {
        let text = "<robot name=arm/>";
        let error = Document::parse(text).unwrap_err();
        let message = words(text, &error).message;
        assert_eq!(message, "invalid XML: expected a quote not 'a'");
    }
}
