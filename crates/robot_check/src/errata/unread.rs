//! Equations that stand outside of the displays that are read, such as `$Q_1 = …$` in a sentence or an equation in an
//! environment that a paper defines.

use super::entries::{arguments, displays};
use super::printed::{Notation, numbered};
use super::symbols::Symbols;
use super::unprinted::{blanked, printed, without_comments};

/// The bytes at which equations of quantities of the robot begin outside of the displays of a LaTeX text. A text without
/// displays has none: all its lines are read.
pub(super) fn unread(text: &str, symbols: &Symbols) -> Vec<usize> {
    let text = printed(&without_comments(text, Notation::Latex));
    let displays: Vec<_> = displays(&text).into_iter().filter_map(Result::ok).collect();
    if displays.is_empty() {
        return vec![];
    }
    let prose = blanked(&text, &displays);
    let equations = prose.match_indices('=').filter_map(|(place, _)| {
        let before = prose.get(..place)?.trim_end_matches(|c: char| c == '&' || c.is_whitespace());
        let side = left_side(before);
        let (_, quantity) = numbered(side);
        symbols.has_quantity(quantity).then_some(before.len() - side.len())
    });
    equations.collect()
}

/// What stands before an `=` in the same formula.
fn left_side(before: &str) -> &str {
    let ends = ["$", r"\(", r"\\", "\n", "&"].into_iter();
    let start = ends.filter_map(|end| Some(before.rfind(end)? + end.len())).max();
    let mut side = before.get(start.unwrap_or_default()..).unwrap_or_default().trim_start();
    // An environment that begins on the line, with its arguments.
    if let Some(name) = side.find(r"\begin{") {
        side = side.get(name + r"\begin".len()..).unwrap_or_default();
        side = side.get(arguments(side)..).unwrap_or_default().trim_start();
    }
    side
}
