//! Parse errors with their positions.

use std::ops::Range;

/// The error for a text that is not a formula.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct ParseError {
    /// The bytes of the text that are wrong; an empty range if something is missing.
    pub span: Range<usize>,
    /// The problem and what was expected.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

impl ParseError {
    /// Creates an error for these bytes of the text.
    #[must_use]
    pub fn new(span: Range<usize>, message: impl Into<String>) -> ParseError {
        ParseError { span, message: message.into(), help: None }
    }

    /// Returns the error with a remedy.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> ParseError {
        self.help = Some(help.into());
        self
    }
}
