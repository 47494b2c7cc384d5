//! Breaks within long words, such as names of links, which a line could not hold otherwise.

/// The number of letters after which a longer word can be broken.
const LONG_WORD: usize = 12;
/// The number of letters up to which a word that is not a name stays whole.
const LONG_PLAIN_WORD: usize = 20;

/// The pieces of a text between which lines may break without a space or a hyphen. Words of letters alone stay whole, and
/// of words with hyphens the parts, unless they are very long.
pub(super) fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = vec![];
    let mut start = 0;
    let mut letters = 0;
    let mut is_whole = is_plain(text.split(' ').next().unwrap_or_default());
    for (place, character) in text.char_indices() {
        if character == ' ' {
            letters = 0;
            let rest = text.get(place + 1..).unwrap_or_default();
            is_whole = is_plain(rest.split(' ').next().unwrap_or_default());
            continue;
        }
        letters += 1;
        if letters > LONG_WORD && !is_whole {
            pieces.extend(text.get(start..place));
            (start, letters) = (place, 1);
        }
    }
    pieces.extend(text.get(start..));
    pieces
}

/// The longest part of a word that stays on one line.
pub(super) fn longest_part(word: &str) -> &str {
    let parts: Vec<&str> =
        if is_plain(word) { word.split_inclusive('-').collect() } else { pieces(word) };
    parts.into_iter().max_by_key(|part| part.chars().count()).unwrap_or_default()
}

/// Whether a word consists of letters, punctuation and hyphens, with no long part.
fn is_plain(word: &str) -> bool {
    let is_of_prose = |c: char| c.is_alphabetic() || ".,;:()'-".contains(c);
    word.chars().all(is_of_prose)
        && word.split('-').all(|part| part.chars().count() <= LONG_PLAIN_WORD)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_broken_and_words_are_not() {
        assert_eq!(pieces("abcdefghijk12 a"), ["abcdefghijk1", "2 a"]);
        assert_eq!(
            pieces("accelerations, Armstrong-Helouvry"),
            ["accelerations, Armstrong-Helouvry"]
        );
        assert_eq!(pieces("left_front_upper_leg"), ["left_front_u", "pper_leg"]);
        assert_eq!(pieces(&"a".repeat(30)).len(), 3);
        assert_eq!(pieces(""), [""]);
        assert_eq!(longest_part("Armstrong-Helouvry"), "Armstrong-");
        assert_eq!(longest_part("left_front_upper_leg"), "left_front_u");
    }
}
