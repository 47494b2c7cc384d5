//! Diagnostics without the lines that they are about: names, lines and columns.

use super::super::group::Group;
use super::super::{Label, Source, quote};
use super::Style;

/// Diagnostics of the same kind as one text, without a newline at the end; it has no colors in any style.
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
    match &diagnostic.primary {
        Some(primary) => {
            let labels = std::iter::once(primary).chain(&diagnostic.secondary);
            text.extend(labels.map(place));
        }
        None => text.push_str(&format!("\n --> {name}")),
    }
    let notes = [found.others(source), diagnostic.why.as_ref().map(ToString::to_string)];
    for note in notes.into_iter().flatten() {
        text.push_str(&format!("\n = note: {note}"));
    }
    if let Some(help) = &diagnostic.help {
        text.push_str(&format!("\n = help: {help}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagnostic_has_its_place_its_reason_and_its_remedy() {
        let text = "format = 1\n[robot]\nname = 1\n";
        let errors = crate::description::read_toml("arm.toml", text).unwrap_err();
        let groups = errors.groups();
        let shown = group(errors.source(), &groups[0], Style::Plain);
        assert!(shown.starts_with("error[R"), "{shown}");
        assert!(shown.contains("\n --> arm.toml:3:8: "), "{shown}");
        assert!(shown.contains("\n = help: "), "{shown}");
    }
}
