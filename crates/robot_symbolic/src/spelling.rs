//! Suggestions for misspelled words.

/// The length above which a word is not compared: a longer word is not a typing mistake.
const MAX_LENGTH: usize = 64;

/// Returns the candidate that a misspelled word most likely means, regardless of case. At most a third of the letters
/// of the longer of the two may differ, but always one of several, and no more than three. A prefix of at least three
/// letters counts as one mistake. Among equally near candidates,
/// it is the first one with the same first letter, or else the first one.
///
/// ```
/// let known = ["revolute", "prismatic", "fixed"];
/// assert_eq!(robot_symbolic::nearest_word("revolut", known), Some("revolute"));
/// assert_eq!(robot_symbolic::nearest_word("Prism", known), Some("prismatic"));
/// assert_eq!(robot_symbolic::nearest_word("hinge", known), None);
/// ```
#[must_use]
pub fn nearest_word<'n>(
    word: &str,
    candidates: impl IntoIterator<Item = &'n str>,
) -> Option<&'n str> {
    let lower = word.to_lowercase();
    let length = word.chars().count();
    if length > MAX_LENGTH {
        return None;
    }
    let compared = candidates.into_iter().map(|candidate| {
        let same = candidate.to_lowercase();
        let distance = strsim::damerau_levenshtein(&lower, &same);
        let edits = match same.starts_with(&lower) && length >= 3 {
            true => distance.min(1),
            false => distance,
        };
        let other_letter = same.chars().next() != lower.chars().next();
        (edits, distance, other_letter, candidate)
    });
    compared
        .min_by_key(|(edits, distance, other_letter, _)| (*edits, *distance, *other_letter))
        .filter(|(edits, .., candidate)| {
            let longest = candidate.len().max(length);
            *edits == 0 || (longest > 1 && *edits <= (longest / 3).clamp(1, 3))
        })
        .map(|(.., candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest_word;

    #[test]
    fn the_first_letter_decides_between_equals() {
        assert_eq!(nearest_word("mX", ["aX", "mY"]), Some("mY"));
        assert_eq!(nearest_word("xy", ["ay", "by"]), Some("ay"));
    }

    #[test]
    fn words_that_are_far_are_not_suggested() {
        assert_eq!(nearest_word("torques", ["Q", "F_l"]), None);
        assert_eq!(nearest_word("a", ["b"]), None);
        assert_eq!(nearest_word("A", ["a"]), Some("a"));
        assert_eq!(nearest_word(&"a".repeat(65), ["a"]), None);
    }
}
