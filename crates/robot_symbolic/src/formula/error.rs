//! Parse errors and their places.

use std::ops::Range;

/// A text that is not a formula.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct ParseError {
    /// The offending bytes of the text; empty at a place where something is missing.
    pub span: Range<usize>,
    /// The problem and what was expected.
    pub message: String,
    /// The replacement to write.
    pub help: Option<String>,
}

impl ParseError {
    /// A problem at a place.
    #[must_use]
    pub fn new(span: Range<usize>, message: impl Into<String>) -> ParseError {
        ParseError { span, message: message.into(), help: None }
    }

    /// The error with what to write instead.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> ParseError {
        self.help = Some(help.into());
        self
    }
}
