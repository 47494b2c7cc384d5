//! Renders diagnostics as text.

#[cfg(feature = "excerpts")]
mod excerpts;
#[cfg(any(not(feature = "excerpts"), test))]
mod places;

#[cfg(feature = "excerpts")]
use excerpts::group;
#[cfg(not(feature = "excerpts"))]
use places::group;

use super::group::{Group, groups};
use super::{Diagnostic, Severity, Source, quote};

/// The maximum number of diagnostics that are shown; further ones are only counted.
const MAX_SHOWN: usize = 40;

/// The style in which diagnostics are rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Plain text.
    Plain,
    /// Text with the colors of a terminal.
    Terminal,
}

/// Renders one diagnostic, without a trailing newline.
#[must_use]
pub fn render(source: &Source, diagnostic: &Diagnostic, style: Style) -> String {
    render_group(source, &Group { first: diagnostic, others: vec![] }, style)
}

/// Renders diagnostics of the same kind as one text, without a trailing newline. If the crate has the feature
/// `excerpts`, the text contains the lines that they concern.
#[must_use]
pub fn render_group(source: &Source, found: &Group<'_>, style: Style) -> String {
    group(source, found, style)
}

pub(super) fn render_all(source: &Source, list: &[Diagnostic], style: Style) -> String {
    let groups = groups(list);
    let (shown, left) = groups.split_at(groups.len().min(MAX_SHOWN));
    let mut parts: Vec<String> =
        shown.iter().map(|group| render_group(source, group, style)).collect();
    let count = |severity| list.iter().filter(|found| found.severity == severity).count();
    let counts = [
        (count(Severity::Error), "error"),
        (count(Severity::Warning), "warning"),
        (count(Severity::Note), "note"),
    ];
    let counts: Vec<String> = counts
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}{}", if *count == 1 { "" } else { "s" }))
        .collect();
    let more = match left.iter().map(Group::count).sum::<usize>() {
        0 => String::new(),
        more => format!(" ({more} more not shown)"),
    };
    let name = quote(&source.name);
    parts.push(format!("{name}: {}{more}\n", counts.join(", ")));
    parts.join("\n\n")
}
