//! Errors, warnings and notes about a robot file: the place, the reason and the remedy.
//!
//! Every reader collects [`Diagnostic`]s and continues, so that all errors in a file are reported at once, in the order
//! of their places. If a file has errors of syntax, only these are reported.

pub mod code;
mod group;
mod render;

use std::fmt;
use std::ops::Range;

pub use group::Group;
pub use render::{Style, render, render_group};

/// A range of bytes of a source text.
pub type Span = Range<usize>;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The file does not describe a robot.
    Error,
    /// The file describes a robot, but perhaps not the intended one.
    Warning,
    /// The file describes a robot; the note describes a choice that the format leaves open.
    Note,
}

impl Severity {
    /// The word for the severity in messages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        }
    }
}

/// A range of bytes of the source with a remark about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The bytes; empty at a place where something is missing.
    pub span: Span,
    /// The remark, which may be empty.
    pub text: String,
}

/// An error, a warning or a note.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// A stable code from the table [`code::TABLE`], such as `R0101`.
    pub code: &'static str,
    /// Error, warning or note.
    pub severity: Severity,
    /// The problem, in one line.
    pub message: String,
    /// The place of the problem; `None` if it concerns the file as a whole.
    pub primary: Option<Label>,
    /// Other relevant places, such as a first definition.
    pub secondary: Vec<Label>,
    /// The reason why the problem matters.
    pub why: Option<String>,
    /// The remedy.
    pub help: Option<String>,
}

impl Diagnostic {
    /// Creates an error without a place.
    #[must_use]
    pub fn error(code: &'static str, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            code,
            severity: Severity::Error,
            message: message.into(),
            primary: None,
            secondary: Vec::new(),
            why: None,
            help: None,
        }
    }

    /// Creates a warning without a place.
    #[must_use]
    pub fn warning(code: &'static str, message: impl Into<String>) -> Diagnostic {
        Diagnostic { severity: Severity::Warning, ..Diagnostic::error(code, message) }
    }

    /// Creates a note without a place.
    #[must_use]
    pub fn note(code: &'static str, message: impl Into<String>) -> Diagnostic {
        Diagnostic { severity: Severity::Note, ..Diagnostic::error(code, message) }
    }

    /// Returns this diagnostic with another severity.
    #[must_use]
    pub fn graded(self, severity: Severity) -> Diagnostic {
        Diagnostic { severity, ..self }
    }

    /// Sets the place of the problem and the remark about it.
    #[must_use]
    pub fn at(mut self, span: &Span, text: impl Into<String>) -> Diagnostic {
        self.primary = Some(Label { span: span.clone(), text: text.into() });
        self
    }

    /// Adds another relevant place.
    #[must_use]
    pub fn and_at(mut self, span: &Span, text: impl Into<String>) -> Diagnostic {
        self.secondary.push(Label { span: span.clone(), text: text.into() });
        self
    }

    /// Sets the reason why the problem matters.
    #[must_use]
    pub fn because(mut self, why: impl Into<String>) -> Diagnostic {
        self.why = Some(why.into());
        self
    }

    /// Sets the remedy.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Diagnostic {
        self.help = Some(help.into());
        self
    }
}

/// A text and the name under which it is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// The name, usually a path.
    pub name: String,
    /// The text.
    pub text: String,
}

impl Source {
    /// The line and column of a byte, both counted from 1. Columns are counted in characters; a tab is one character.
    #[must_use]
    pub fn position(&self, byte: usize) -> (usize, usize) {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        let before = self.text.get(..byte).unwrap_or_default();
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
        let column = before.get(start..).unwrap_or_default().chars().count() + 1;
        (line, column)
    }
}

/// All diagnostics of one source, in the order of their places.
///
/// As an error, this displays every diagnostic with `file:line:column` and the offending text underlined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics {
    source: Source,
    list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Diagnostics of a source, sorted by place; those without a place come first.
    #[must_use]
    pub fn new(source: Source, mut list: Vec<Diagnostic>) -> Diagnostics {
        let place = |diagnostic: &Diagnostic| {
            let span = diagnostic.primary.as_ref().map(|label| &label.span);
            span.map(|span| (span.start, span.end))
        };
        list.sort_by(|a, b| (place(a), a.code).cmp(&(place(b), b.code)));
        list.dedup();
        Diagnostics { source, list }
    }

    /// The source.
    #[must_use]
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The diagnostics in order.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// The number of diagnostics.
    #[must_use]
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether the list is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether one of them is an error.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// The diagnostics in groups: three or more that differ only in names, numbers and places form one group, errors
    /// only if their remedy is the same.
    #[must_use]
    pub fn groups(&self) -> Vec<Group<'_>> {
        group::groups(&self.list)
    }

    /// Renders all diagnostics as text: each group with an excerpt of the source, followed by their number.
    #[must_use]
    pub fn render(&self, style: Style) -> String {
        render::render_all(&self.source, &self.list, style)
    }
}

/// The rendering in [`Style::Plain`].
impl fmt::Display for Diagnostics {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.render(Style::Plain))
    }
}

impl std::error::Error for Diagnostics {}

/// Text from a file in a form that is safe in messages: on one line, without control characters, and with the middle
/// left out if it is long.
#[must_use]
pub fn quote(text: &str) -> String {
    const HEAD: usize = 40;
    const TAIL: usize = 10;
    let length = text.chars().count();
    if length <= HEAD + TAIL {
        return visible(text);
    }
    let head: String = text.chars().take(HEAD).collect();
    let tail: String = text.chars().skip(length - TAIL).collect();
    format!("{}…{}", visible(&head), visible(&tail))
}

/// Text from elsewhere, such as the name of a file, in a form that is safe in messages: on one line, and without
/// control characters, which a terminal would execute.
#[must_use]
pub fn visible(text: &str) -> String {
    let one = |character: char| {
        let plain = !character.is_control() && !is_invisible(character);
        let escaped = (!plain).then(|| character.escape_unicode());
        escaped.into_iter().flatten().chain(plain.then_some(character))
    };
    text.chars().flat_map(one).collect()
}

/// A number as messages show it: with the fewest digits from which the same number is read back, and with an exponent
/// if it is very large or very small.
#[must_use]
pub fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&value.abs()) {
        return value.to_string();
    }
    format!("{value:e}")
}

/// Whether a character is invisible or changes the order of the characters around it.
#[must_use]
pub fn is_invisible(character: char) -> bool {
    matches!(character,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// A number with six significant digits.
#[must_use]
pub fn significant(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) {
        return format!("{rounded:e}");
    }
    rounded.to_string()
}

#[cfg(test)]
mod tests;
