//! Numbers in attributes: decimal numbers separated by spaces, read exactly.

use robot_symbolic::{Formula, Rational};

use super::super::reader::Reader;
use super::element::Attribute;
use super::xml::template;
use crate::diagnostic::{Diagnostic, Span, code, quote};

/// Reads exactly `N` numbers from an attribute. For messages, `what` names the quantity and `example` is a valid value.
pub(super) fn numbers<const N: usize>(
    reader: &mut Reader<'_>,
    attribute: &Attribute<'_>,
    what: &str,
    example: &str,
) -> Option<[Rational; N]> {
    let words = words(reader, attribute);
    let mut found = Vec::new();
    let mut failed = false;
    for (word, place) in &words {
        match number(word) {
            Some(number) => found.push(number),
            None => {
                reader.report(wrong(word, place));
                failed = true;
                // With more than `N` numbers, one wrong word is enough to report: the attribute may not be a list of
                // numbers at all.
                if found.len() > N {
                    break;
                }
            }
        }
    }
    if failed {
        return None;
    }
    let count = found.len();
    if let Ok(numbers) = found.try_into() {
        return Some(numbers);
    }
    let (expected, between) = match N {
        1 => ("one number".to_owned(), ""),
        _ => (format!("{N} numbers"), ", with spaces between"),
    };
    let message = format!("expected {expected} for {what}; found {count}");
    reader.report(
        Diagnostic::error(code::WRONG_COUNT, message)
            .at(&attribute.span, "")
            .help(format!("write \"{example}\"{between}")),
    );
    None
}

/// Reads numbers like [`numbers`], as formulas.
pub(super) fn formulas<const N: usize>(
    reader: &mut Reader<'_>,
    attribute: &Attribute<'_>,
    what: &str,
    example: &str,
) -> Option<[Formula; N]> {
    let numbers = numbers::<N>(reader, attribute, what, example)?;
    Some(numbers.each_ref().map(Formula::number))
}

/// The words of an attribute with their places in the file.
pub(super) fn words<'t>(reader: &Reader<'t>, attribute: &Attribute<'t>) -> Vec<(&'t str, Span)> {
    let raw = reader.text.get(attribute.span.clone()).unwrap_or_default();
    // The places of words cannot be determined in text with character references.
    let followed = !raw.contains('&');
    let text = if followed { raw } else { attribute.text };
    let mut words = Vec::new();
    let mut start = None;
    for (index, character) in text.char_indices().chain([(text.len(), ' ')]) {
        let space = matches!(character, ' ' | '\t' | '\r' | '\n');
        match (start, space) {
            (None, false) => start = Some(index),
            (Some(from), true) => {
                let place = attribute.span.start + from..attribute.span.start + index;
                let place = if followed { place } else { attribute.span.clone() };
                words.push((text.get(from..index).unwrap_or_default(), place));
                start = None;
            }
            _ => {}
        }
    }
    words
}

fn number(word: &str) -> Option<Rational> {
    let number = Rational::from_decimal(word).filter(|_| !word.contains('_'));
    number.filter(|number| {
        let float = number.to_f64();
        float.is_finite() && (float != 0.0 || number.is_zero())
    })
}

/// The part of a word before its exponent, if it has one.
fn without_exponent(word: &str) -> &str {
    match word.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => {
            let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
            let is_exponent = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
            if is_exponent { mantissa } else { word }
        }
        None => word,
    }
}

fn wrong(word: &str, place: &Span) -> Diagnostic {
    if word.contains("${") || word.contains("$(") {
        return template(place);
    }
    let lower = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    let is_number = |text: &str| Rational::from_decimal(text).is_some() && !text.contains('_');
    let shown = quote(word);
    let (message, help) = if lower.starts_with("nan")
        || lower.contains("#qnan")
        || lower.contains("#ind")
    {
        (format!("`{shown}` is not a number"), "give a number")
    } else if lower.starts_with("inf") || lower.contains("#inf") {
        (format!("`{shown}` is infinite"), "give a finite value")
    } else if word.contains(',') && is_number(&word.replacen(',', ".", 1)) && !word.ends_with(',') {
        (format!("`{shown}` has a decimal comma"), "use a decimal point: `0.5` instead of `0,5`")
    } else if word.contains(',') {
        (format!("`{shown}` is not a number"), "separate numbers with spaces, not commas")
    } else if is_number(without_exponent(word)) {
        (
            format!("`{shown}` is outside the range of floating-point numbers"),
            "magnitudes may be at most 1e30; write 0 for a value that is negligible",
        )
    } else {
        (
            format!("`{shown}` is not a number"),
            "write a number as `12`, `-0.35` or `1.5e-3`, in SI units, without the unit",
        )
    };
    Diagnostic::error(code::NUMBER, message).at(place, "").help(help)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_with_a_number_is_reported() {
        for (word, reason) in [
            ("1_500", "is not a number"),
            ("1e", "is not a number"),
            ("1e5.5", "is not a number"),
            ("1e309", "is outside the range of floating-point numbers"),
            ("1e-999999999", "is outside the range of floating-point numbers"),
            ("-2E+99999999999999999999", "is outside the range of floating-point numbers"),
            ("0,5", "has a decimal comma"),
        ] {
            assert!(number(word).is_none(), "{word}");
            let message = wrong(word, &(0..1)).message;
            assert_eq!(message, format!("`{word}` {reason}"));
        }
    }
}
