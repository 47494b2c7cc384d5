//! Long numbers in texts, rounded so that they can be read.

use robot_model::diagnostic::number;

/// The longest number that is printed with all digits.
const LONGEST: usize = 24;
/// The significant digits of longer ones: as few of these as show that two values differ.
const DIGITS: [usize; 2] = [10, 15];

/// The two texts with rounded numbers. If they would be the same, they keep all digits.
pub(super) fn pair(exact: &[Option<String>; 2]) -> [Option<String>; 2] {
    DIGITS
        .into_iter()
        .map(|digits| exact.each_ref().map(|one| one.as_ref().map(|text| rounded(text, digits))))
        .find(|[a, b]| a != b)
        .unwrap_or_else(|| exact.clone())
}

/// A text in which decimals and quotients of more than [`LONGEST`] characters have ten significant digits.
pub(super) fn one(text: &str) -> String {
    rounded(text, DIGITS[0])
}

fn rounded(text: &str, digits: usize) -> String {
    let mut shown = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|character: char| is_word(character)) {
        let (before, word) = rest.split_at(start);
        let end = word.find(|character| !is_word(character)).unwrap_or(word.len());
        let (word, after) = word.split_at(end);
        shown.push_str(before);
        match (word.len() > LONGEST).then(|| shortened(word, digits)).flatten() {
            Some(short) => shown.push_str(&short),
            None => shown.push_str(word),
        }
        rest = after;
    }
    shown + rest
}

/// Whether a name, a decimal without an exponent or a quotient of integers may have this character.
fn is_word(character: char) -> bool {
    character.is_alphanumeric() || "_./".contains(character)
}

/// A decimal or a quotient with this number of significant digits; `None` for names and for what `f64` cannot hold, and
/// for a number that would become 1, a factor that other texts do not have.
fn shortened(word: &str, digits: usize) -> Option<String> {
    if !word.chars().all(|character| character.is_ascii_digit() || "./".contains(character)) {
        return None;
    }
    let (numerator, denominator) = word.split_once('/').unwrap_or((word, "1"));
    let value = numerator.parse::<f64>().ok()? / denominator.parse::<f64>().ok()?;
    let rounded = format!("{value:.*e}", digits - 1).parse::<f64>().ok()?;
    (value.is_normal() && rounded != 1.0).then(|| number(rounded))
}
