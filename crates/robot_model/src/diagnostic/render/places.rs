//! Renders diagnostics without the lines that they concern: only with names, lines and columns.

use super::super::group::Group;
use super::super::{Label, Source, quote};
use super::Style;

/// Renders diagnostics of the same kind as one text, without a trailing newline and, in any style, without colors.
pub(super) fn group(source: &Source, found: &Group<'_>, _: Style) -> String {
    let diagnostic = found.first;
    let name = quote(&source.name);
    let mut text =
        format!("{}[{}]: {}", diagnostic.severity.name(), diagnostic.code, found.message());
    let place = |label: &Label| {
        let (line, column) = source.position(label.span.start);
        let gap = if label.text.is_empty() { "" } else { ": " };
        format!("\n --> {name}:{line}:{column}{gap}{}", label.text)
    };
    let (secondary, listed) = found.secondary(source);
    match &diagnostic.primary {
        Some(primary) => {
            let labels = std::iter::once(primary).chain(secondary);
            text.extend(labels.map(place));
        }
        None => text.push_str(&format!("\n --> {name}")),
    }
    for note in listed.iter().chain(&found.others(source)).chain(&diagnostic.why) {
        text.push_str(&format!("\n = note: {note}"));
    }
    if let Some(help) = &diagnostic.help {
        text.push_str(&format!("\n = help: {help}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::super::{Diagnostic, code};
    use super::*;

    #[test]
    fn a_diagnostic_has_its_place_its_reason_and_its_remedy() {
        let source = Source { name: "arm.toml".to_owned(), text: "a = 1\nmass = nan\n".to_owned() };
        let found = Diagnostic::error(code::NUMBER, "wrong").at(&(13..16), "here");
        let found = found.because("a reason").help("a remedy");
        let shown = group(&source, &Group { first: &found, others: vec![] }, Style::Plain);
        let expected =
            "error[R0301]: wrong\n --> arm.toml:2:8: here\n = note: a reason\n = help: a remedy";
        assert_eq!(shown, expected);
    }
}
