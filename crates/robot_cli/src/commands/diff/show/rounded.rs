//! Long numbers in texts, rounded so that they can be read.

use robot_model::diagnostic::number;
use robot_symbolic::Rational;

/// The longest number that is printed with all digits.
const LONGEST: usize = 24;
/// The significant digits of longer ones: as few of these as show that two values differ.
const DIGITS: [usize; 2] = [10, 15];
/// The longest number whose digits are printed if only all of them show a difference.
const LONGEST_EXACT: usize = 50;

/// A factor 1 in a text that is compared.
const ONE: char = '\u{1}';

/// The two texts with rounded numbers. If these would have the same values, the texts keep all digits; a number of more
/// than [`LONGEST_EXACT`] characters is then written as the other one plus or minus the change.
pub(super) fn pair(exact: &[Option<String>; 2]) -> [Option<String>; 2] {
    let of = |write: fn(&str, usize) -> String, digits| {
        exact.each_ref().map(|one| one.as_ref().map(|text| write(text, digits)))
    };
    let differ = |digits: &usize| {
        let [a, b] = of(values, *digits);
        a != b
    };
    match DIGITS.into_iter().find(differ) {
        Some(digits) => of(rounded, digits),
        None => by_change(exact).unwrap_or_else(|| exact.clone()),
    }
}

/// A text in which decimals and quotients of more than [`LONGEST`] characters have ten significant digits.
pub(super) fn one(text: &str) -> String {
    rounded(text, DIGITS[0])
}

fn rounded(text: &str, digits: usize) -> String {
    // A number that would become 1 keeps its digits: products do not show a factor 1.
    let short = |word: &str| value(word, digits).filter(|_| word.len() > LONGEST);
    with_numbers(text, |word| short(word).filter(|value| *value != 1.0).map(number))
}

/// The text with every number rounded, in one notation and without factors 1: equal texts have equal values.
fn values(text: &str, digits: usize) -> String {
    let with_ones = with_numbers(text, |word| match value(word, digits) {
        Some(1.0) => Some(ONE.to_string()),
        rounded => rounded.map(number),
    });
    [format!("*{ONE}"), format!("{ONE}*")].iter().fold(with_ones, |text, one| text.replace(one, ""))
}

/// Replaces the words of a text that `write` returns a text for.
fn with_numbers(text: &str, write: impl Fn(&str) -> Option<String>) -> String {
    let mut shown = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(is_word) {
        let (before, word) = rest.split_at(start);
        let (word, after) = word.split_at(end_of_word(word));
        shown.push_str(before);
        shown.push_str(&write(word).unwrap_or_else(|| word.to_owned()));
        rest = after;
    }
    shown + rest
}

/// The length of the name, decimal or quotient at the beginning of a text.
fn end_of_word(text: &str) -> usize {
    let end = |text: &str| text.find(|character| !is_word(character)).unwrap_or(text.len());
    let length = end(text);
    let (word, after) = text.split_at(length);
    // The sign of an exponent.
    match (word.strip_suffix('e').is_some_and(is_number), after.strip_prefix('-')) {
        (true, Some(exponent)) => length + 1 + end(exponent),
        _ => length,
    }
}

/// Whether a name, a decimal or a quotient of integers may have this character.
fn is_word(character: char) -> bool {
    character.is_alphanumeric() || "_./".contains(character)
}

fn is_number(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit())
        && word.chars().all(|character| character.is_ascii_digit() || "./".contains(character))
}

/// The value of a decimal or quotient, rounded to this number of significant digits; `None` for names, for 0, and for what
/// `f64` cannot hold.
fn value(word: &str, digits: usize) -> Option<f64> {
    let mantissa = word.split_once("e-").map_or(word, |(mantissa, _)| mantissa);
    let value = exact_value(word).filter(|_| is_number(mantissa))?.to_f64();
    let rounded = format!("{value:.*e}", digits - 1).parse::<f64>().ok()?;
    (value != 0.0 && value.is_finite()).then_some(rounded)
}

/// A very long number as the other one plus or minus the change; `None` if none is so long, or if the texts are not
/// numbers.
fn by_change(exact: &[Option<String>; 2]) -> Option<[Option<String>; 2]> {
    let [Some(before), Some(after)] = exact else { return None };
    if before.len().max(after.len()) <= LONGEST_EXACT {
        return None;
    }
    let change = &exact_value(after)? + &-&exact_value(before)?;
    let sign = if change.is_negative() { '-' } else { '+' };
    let before = with_numbers(before, |word| value(word, DIGITS[0]).map(number));
    let after = format!("{before} {sign} {}", magnitude(&change.abs()));
    Some([Some(before), Some(after)])
}

fn exact_value(text: &str) -> Option<Rational> {
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    let divisor = Rational::from_decimal(denominator)?.recip()?;
    Some(&Rational::from_decimal(numerator)? * &divisor)
}

/// A positive number with two digits, also if it is below the range of `f64`: `1.5e-600`.
fn magnitude(value: &Rational) -> String {
    /// The digits of a 64-bit number.
    const MOST: usize = 18;
    let (numerator, denominator) = value.to_digits();
    let leading = |digits: &str| {
        let leading = digits.get(..MOST).unwrap_or(digits);
        (leading.parse::<f64>().unwrap_or_default(), (digits.len() - leading.len()) as i64)
    };
    let ((above, above_zeros), (below, below_zeros)) = (leading(&numerator), leading(&denominator));
    let scientific = format!("{:.1e}", above / below);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent = exponent.parse::<i64>().unwrap_or_default() + above_zeros - below_zeros;
    format!("{}e{exponent}", mantissa.strip_suffix(".0").unwrap_or(mantissa))
}
