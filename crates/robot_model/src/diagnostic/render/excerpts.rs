//! Renders diagnostics with the lines of the file that they concern.

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::super::group::Group;
use super::super::{Label, Severity, Source, Span, quote};
use super::Style;

/// Renders diagnostics of the same kind as one text, without a trailing newline.
pub(super) fn group(source: &Source, found: &Group<'_>, style: Style) -> String {
    let diagnostic = found.first;
    let (message, others) = (found.message(), found.others(source));
    let (secondary, listed) = found.secondary(source);
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let mut group = annotate_snippets::Group::with_title(
        level.primary_title(message.as_str()).id(diagnostic.code),
    );
    match &diagnostic.primary {
        Some(primary) => {
            let mut labels = vec![(primary, AnnotationKind::Primary)];
            labels.extend(secondary.iter().map(|label| (*label, AnnotationKind::Context)));
            for (text, line, labels) in excerpts(source, &labels) {
                group = group.element(
                    Snippet::source(text).path(quote(&source.name)).line_start(line).annotations(
                        labels.into_iter().map(|(kind, span, text)| {
                            let text = (!text.is_empty()).then_some(text);
                            kind.span(span).label(text)
                        }),
                    ),
                );
            }
        }
        None => {
            group = group.element(annotate_snippets::Origin::path(quote(&source.name)));
        }
    }
    for note in listed.iter().chain(&others).chain(&diagnostic.why) {
        group = group.element(Level::NOTE.message(note.as_str()));
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    let renderer = match style {
        Style::Plain => Renderer::plain(),
        Style::Terminal => Renderer::styled(),
    };
    renderer.render(&[group])
}

type Excerpt<'s> = (&'s str, usize, Vec<(AnnotationKind, Span, &'s str)>);

/// The part of the source that contains all labels. It consists of whole lines, so that the columns are right.
fn excerpts<'s>(source: &'s Source, labels: &[(&'s Label, AnnotationKind)]) -> Vec<Excerpt<'s>> {
    let text = source.text.as_str();
    let labels: Vec<_> = labels
        .iter()
        .map(|(label, kind)| (*kind, clamp(text, &label.span), label.text.as_str()))
        .collect();
    let first = labels.iter().map(|(_, span, _)| span.start).min();
    let last = labels.iter().map(|(_, span, _)| span.end).max();
    let (Some(first), Some(last)) = (first, last) else {
        return Vec::new();
    };
    let start = text[..first].rfind('\n').map_or(0, |newline| newline + 1);
    let end = text[last..].find('\n').map_or(text.len(), |newline| last + newline);
    let end = end - usize::from(text[last..end].ends_with('\r'));
    let line = text[..start].bytes().filter(|byte| *byte == b'\n').count() + 1;
    let moved = labels
        .into_iter()
        .map(|(kind, span, text)| (kind, span.start - start..span.end - start, text));
    vec![(&text[start..end], line, moved.collect())]
}

/// The span limited to the text, with both ends on character boundaries.
fn clamp(text: &str, span: &Span) -> Span {
    let floor = |mut byte: usize| {
        byte = byte.min(text.len());
        while !text.is_char_boundary(byte) {
            byte -= 1;
        }
        byte
    };
    let start = floor(span.start);
    start..floor(span.end).max(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_end_on_characters_of_the_text() {
        // The two bytes of ü are 1 and 2.
        let text = "für";
        for (span, clamped) in [(2..2, 1..1), (2..9, 1..4), (0..2, 0..1), (9..9, 4..4)] {
            assert_eq!(clamp(text, &span), clamped, "{span:?}");
        }
    }
}
