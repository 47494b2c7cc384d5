//! Translates the LaTeX of published formulas to infix text that [`Formula`](robot_symbolic::Formula) reads.
//!
//! It accepts the LaTeX of papers and of `robot_document`: symbols with indices and accents, products by juxtaposition,
//! fractions, roots, brackets, and sines and cosines in three spellings: `\sin q_2`, `s_2` or `c_{23}`, and `sq_2` or
//! `c^2q_5`.

mod lexer;
mod symbol;
#[cfg(test)]
mod tests;
mod translate;
mod words;

use std::ops::Range;

use robot_symbolic::ParseError;

/// Returns the name of a symbol for its [`symbol_key`].
pub(super) type Names<'a> = dyn Fn(&str) -> Option<String> + 'a;

/// A formula as infix text, with the places of its parts in the LaTeX.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Infix {
    text: String,
    /// The start of each piece of the text, and the bytes of the LaTeX from which it was translated.
    pieces: Vec<(usize, Range<usize>)>,
    /// The end of the LaTeX.
    end: usize,
}

impl Infix {
    /// The infix text.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// The bytes of the LaTeX from which a range of the infix text was translated.
    pub(super) fn source(&self, span: &Range<usize>) -> Range<usize> {
        let last = self.pieces.partition_point(|(start, _)| *start < span.end.max(span.start + 1));
        let first = self.pieces.partition_point(|(start, _)| *start <= span.start);
        let pieces = self.pieces.get(first.saturating_sub(1)..last).unwrap_or_default();
        let start = pieces.iter().map(|(_, source)| source.start).min();
        let end = pieces.iter().map(|(_, source)| source.end).max();
        match start.zip(end) {
            Some((start, end)) if span.start < self.text.len() => start..end,
            _ => self.end..self.end,
        }
    }
}

/// Translates a formula in LaTeX to infix text.
///
/// `names` returns the name of a symbol for its [`symbol_key`]. A symbol for which it returns `None` is named by the
/// letters and digits of its LaTeX. A superscript is part of a symbol if `names` returns a name for both, and otherwise
/// a power if it is an integer. If a plus or minus sign is repeated at a line break, as in `a + \\ + b`, it counts only
/// once.
///
/// # Errors
///
/// The first thing that cannot be read, with its bytes and a remedy.
pub(super) fn to_infix(latex: &str, names: &Names<'_>) -> Result<Infix, ParseError> {
    translate::translate(latex, names)
}

/// The key that identifies a symbol in LaTeX: its text without spaces, braces and fonts, such as `F_l_x^5` for
/// `F_{l_x}^{5}`.
pub(super) fn symbol_key(latex: &str) -> String {
    lexer::key(&lexer::tokens(latex))
}
