//! TOML text to tables, and errors of TOML in the words of robot files.

use toml::Spanned;
use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, Span, code};

/// Parses the text; the tables are of use only where no diagnostic is found.
pub(super) fn parse(text: &str) -> (Spanned<DeTable<'_>>, Vec<Diagnostic>) {
    let (table, errors) = DeTable::parse_recoverable(text);
    let found = errors
        .iter()
        .map(|error| {
            let end = text.len()..text.len();
            let span = error.span().unwrap_or(end);
            let (message, help) = words(text, error.message(), &span);
            let mut diagnostic = Diagnostic::error(code::SYNTAX, message).at(&span, "");
            diagnostic.help = help.map(str::to_owned);
            diagnostic
        })
        .collect();
    (table, found)
}

/// What the parser says, and what to do in the cases that occur most.
fn words(text: &str, message: &str, span: &Span) -> (String, Option<&'static str>) {
    let rest = text.get(span.start..).unwrap_or_default();
    let help = if message.starts_with("unexpected key or value") && rest.starts_with(',') {
        Some("a decimal number has a point: write `0.5` for `0,5`")
    } else if message.starts_with("duplicate key") {
        Some("keep one of them; several links are `[[link]]`, each with two brackets")
    } else if message.starts_with("string values must be quoted") {
        Some("put names and expressions in quotes: \"l1/2\"")
    } else if message.starts_with("missing escaped value") {
        Some(
            "in a basic string a backslash is written `\\\\`; a literal string '…' takes it as it is",
        )
    } else if message.contains("recursion") {
        Some("a robot file needs no more than four levels")
    } else {
        None
    };
    let message = match message {
        "recursion limit" => "the file is nested too deep".to_owned(),
        _ => format!("this is not TOML: {message}"),
    };
    (message, help)
}
