//! The LaTeX that a robot file gives for a symbol.

use super::reader::Reader;
use super::strings;
use super::table::Value;
use crate::diagnostic::{Diagnostic, code};
use crate::signs::check_latex;

impl Reader<'_> {
    /// Reads the LaTeX of a symbol.
    pub(super) fn latex(&mut self, value: Value<'_>) -> Option<String> {
        let text = self.string(value, "the LaTeX for a symbol, in quotes")?;
        let Err(error) = check_latex(text) else {
            return Some(text.to_string());
        };
        let span = strings::place(self.text, &value.span(), text, error.span);
        self.report(
            Diagnostic::error(code::LATEX, "not valid LaTeX for a symbol")
                .at(&span, error.message)
                .because("it is printed verbatim, so only symbols are allowed")
                .help(
                    "use a letter, a Greek letter such as `\\theta` or a word such as `\\mathrm{mg}`, \
                     with an accent such as `\\bar{x}` and indices such as `_1` or `^{*1}`; in a \
                     basic string, write each backslash as `\\\\`",
                ),
        );
        None
    }
}
