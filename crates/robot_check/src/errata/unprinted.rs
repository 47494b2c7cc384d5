//! What a text contains beside its equations: comments, and LaTeX that is not printed. It becomes spaces, so that all
//! other bytes keep their places.

use std::ops::Range;

use super::printed::Notation;

/// The byte order mark that some editors put before a text.
const BYTE_ORDER_MARK: char = '\u{feff}';
/// What begins and ends text that LaTeX does not print, or not as formulas.
const UNPRINTED: [(&str, &str); 3] = [
    (r"\begin{comment}", r"\end{comment}"),
    (r"\begin{verbatim}", r"\end{verbatim}"),
    (r"\iffalse", r"\fi"),
];

/// The text with comments and a byte order mark replaced by the same number of spaces.
pub(super) fn without_comments(text: &str, notation: Notation) -> String {
    let mut clean = String::with_capacity(text.len());
    let unmarked = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
    clean.extend(std::iter::repeat_n(' ', text.len() - unmarked.len()));
    for line in unmarked.split_inclusive('\n') {
        let comment = match notation {
            Notation::Text => line.find('#'),
            Notation::Latex => percent(line),
        };
        let end = line.trim_end_matches(['\n', '\r']).len();
        let comment = comment.unwrap_or(end).min(end);
        clean.push_str(line.get(..comment).unwrap_or_default());
        clean.extend(std::iter::repeat_n(' ', end - comment));
        clean.push_str(line.get(end..).unwrap_or_default());
    }
    clean
}

/// The text with what LaTeX does not print replaced by spaces.
pub(super) fn printed(text: &str) -> String {
    let (mut ranges, mut place) = (vec![], 0);
    while let Some(rest) = text.get(place..).filter(|rest| !rest.is_empty()) {
        let opens = UNPRINTED.iter().filter_map(|(open, close)| Some((rest.find(open)?, *close)));
        let Some((open, close)) = opens.min_by_key(|(open, _)| *open) else { break };
        let start = place + open;
        let inside = text.get(start..).unwrap_or_default();
        // What follows `\else` is printed; the `\fi` after it is then refused within a formula.
        let end = inside.find(close).map(|end| end + close.len());
        let other =
            inside.find(r"\else").filter(|_| close == r"\fi").map(|end| end + r"\else".len());
        place = end.into_iter().chain(other).min().map_or(text.len(), |end| start + end);
        ranges.push(start..place);
    }
    blanked(text, &ranges)
}

/// The text with a space for each dollar sign alone, which begins or ends a formula in a line.
pub(super) fn without_dollars(text: &str) -> String {
    let alone = text.match_indices('$').map(|(place, _)| place..place + 1).filter(|dollar| {
        let before = text.get(..dollar.start).unwrap_or_default();
        let after = text.get(dollar.end..).unwrap_or_default();
        !before.ends_with(['$', '\\']) && !after.starts_with('$')
    });
    blanked(text, &alone.collect::<Vec<_>>())
}

/// The position of the first percent sign that begins a comment.
fn percent(line: &str) -> Option<usize> {
    let bytes = line.as_bytes();
    let mut escaped = false;
    bytes.iter().position(|byte| {
        let found = *byte == b'%' && !escaped;
        escaped = *byte == b'\\' && !escaped;
        found
    })
}

/// The text with the given ranges, in order, replaced by spaces.
pub(super) fn blanked(text: &str, ranges: &[Range<usize>]) -> String {
    let mut clean = String::with_capacity(text.len());
    for range in ranges {
        clean.push_str(text.get(clean.len()..range.start).unwrap_or_default());
        clean.extend(std::iter::repeat_n(' ', range.end.saturating_sub(clean.len())));
    }
    clean.push_str(text.get(clean.len()..).unwrap_or_default());
    clean
}
