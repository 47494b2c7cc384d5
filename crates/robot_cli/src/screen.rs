//! A terminal that shows results.

use std::fmt::Write as _;

use clap::builder::styling::{AnsiColor, Style};

/// A terminal as standard output.
#[derive(Clone, Copy, Debug)]
pub struct Screen {
    /// The width in columns; `None` if it is unknown.
    pub columns: Option<usize>,
    /// Whether it shows colors; see [`colors`](crate::colors).
    pub colors: bool,
}

/// The style of removed text: red.
pub(crate) const REMOVED: Style = AnsiColor::Red.on_default();
/// The style of added text: green.
pub(crate) const ADDED: Style = AnsiColor::Green.on_default();
/// The style of changed text: yellow.
pub(crate) const CHANGED: Style = AnsiColor::Yellow.on_default();
/// The style of titles: bold.
pub(crate) const TITLE: Style = Style::new().bold();

/// Whether results on a terminal have colors.
pub(crate) fn is_colored(screen: Option<Screen>) -> bool {
    screen.is_some_and(|screen| screen.colors)
}

/// Prints the lines of a text, each in the style that `style` returns for it.
pub(crate) fn styled_lines(text: &str, style: impl Fn(&str) -> Option<Style>) -> String {
    let mut shown = String::with_capacity(text.len());
    for line in text.lines() {
        // Writing to a string does not fail.
        let _ = match style(line) {
            Some(style) => writeln!(shown, "{style}{line}{style:#}"),
            None => writeln!(shown, "{line}"),
        };
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_styled_alone() {
        let shown = styled_lines("+ a\nb\n", |line| line.starts_with('+').then_some(ADDED));
        assert_eq!(shown, "\u{1b}[32m+ a\u{1b}[0m\nb\n");
    }
}
