//! Numbers as text.

use super::Level;
use crate::number::Number;
use crate::rational::Rational;

/// The largest number of decimal places; fractions with more are printed as quotients.
const MAX_PLACES: usize = 40;

/// The number of zeros after the point from which a decimal is printed with a power of ten.
const ZEROS: usize = 4;

/// Writes the exact value: `7`, or `-0.35` if the denominator divides a power of ten, otherwise `2/3`.
#[must_use]
pub fn exact_text(value: &Rational) -> String {
    let (numerator, denominator) = value.to_digits();
    if denominator == "1" {
        return numerator;
    }
    decimal_places(value)
        .and_then(|(digits, places)| place_point(&digits.to_digits(), places))
        .unwrap_or_else(|| format!("{numerator}/{denominator}"))
}

/// Writes a coefficient of a term: like [`exact_text`], but decimals below 0.0001 with a power of ten, such as
/// `-1.5e-12`, and long quotients as decimals. A floating-point number is the shortest decimal that rounds to it.
#[must_use]
pub fn coefficient_text(number: &Number) -> String {
    let Some(value) = number.as_rational() else {
        let value = number.to_f64();
        let is_small = value != 0.0 && value.abs() < 1e-4;
        return if is_small { format!("{value:e}") } else { value.to_string() };
    };
    let text = exact_text(value);
    if text.contains('/') && value.to_small().is_none() {
        return coefficient_text(&Number::real(value.to_f64()));
    }
    let (sign, decimal) = match text.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", text.as_str()),
    };
    match scientific(decimal) {
        Some((mantissa, exponent)) => format!("{sign}{mantissa}e{exponent}"),
        None => text,
    }
}

/// Splits a decimal below 0.0001, without a sign, into a mantissa and the exponent of ten, such as `1.5` and `-12`;
/// `None` for other texts.
#[must_use]
pub fn scientific(decimal: &str) -> Option<(String, String)> {
    let decimals = decimal.strip_prefix("0.")?;
    let digits = decimals.trim_start_matches('0');
    let zeros = decimals.len() - digits.len();
    let (first, others) = digits.split_at_checked(1).filter(|_| zeros >= ZEROS)?;
    let point = if others.is_empty() { "" } else { "." };
    Some((format!("{first}{point}{others}"), format!("-{}", zeros + 1)))
}

/// The absolute value of a number, in the form that a printer needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Magnitude {
    /// Digits, possibly with a decimal point: `7`, `0.35`.
    Decimal(String),
    /// A quotient of integers, if the value is not a decimal.
    Quotient([String; 2]),
    /// Digits and the exponent of the power of ten that they are multiplied by: `1.5` and `-7`.
    Scientific([String; 2]),
    /// An infinity or NaN.
    NotANumber,
}

impl Magnitude {
    /// The absolute value of a number. A floating-point constant becomes the shortest decimal number that rounds to it.
    #[must_use]
    pub fn new(number: &Number) -> Magnitude {
        let pair = |(a, b): (&str, &str)| [a.to_owned(), b.to_owned()];
        match number {
            Number::Rational(value) => {
                let text = exact_text(&value.abs());
                match text.split_once('/') {
                    Some(parts) => Magnitude::Quotient(pair(parts)),
                    None => Magnitude::Decimal(text),
                }
            }
            Number::Real(real) if real.value().is_finite() => {
                let text = format!("{:?}", real.value().abs());
                match text.split_once('e') {
                    Some(parts) => Magnitude::Scientific(pair(parts)),
                    None => Magnitude::Decimal(text),
                }
            }
            Number::Real(_) => Magnitude::NotANumber,
        }
    }
}

/// The absolute value as text that can be parsed again, and how tightly it binds. Infinities and NaN become `(0/0)`,
/// which is a NaN when it is parsed.
pub(crate) fn magnitude_text(number: &Number) -> (String, Level) {
    match Magnitude::new(number) {
        Magnitude::Decimal(digits) => (digits, Level::Atom),
        Magnitude::Quotient([above, below]) => (format!("{above}/{below}"), Level::Product),
        Magnitude::Scientific([digits, exponent]) => (format!("{digits}e{exponent}"), Level::Atom),
        Magnitude::NotANumber => ("(0/0)".to_owned(), Level::Atom),
    }
}

/// Returns `(n, k)` such that the value is `n / 10^k` with the smallest `k` ≥ 1, if there is one up to [`MAX_PLACES`].
fn decimal_places(value: &Rational) -> Option<(Rational, usize)> {
    let ten = Rational::integer(10);
    let mut scaled = value.clone();
    for places in 1..=MAX_PLACES {
        scaled = &scaled * &ten;
        if scaled.to_digits().1 == "1" {
            return Some((scaled, places));
        }
    }
    None
}

fn place_point((numerator, _): &(String, String), places: usize) -> Option<String> {
    let (sign, digits) = match numerator.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", numerator.as_str()),
    };
    let padded = format!("{digits:0>width$}", width = places + 1);
    let (whole, fraction) = padded.split_at_checked(padded.len() - places)?;
    Some(format!("{sign}{whole}.{fraction}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_print_exactly() {
        let text =
            |numerator, denominator| exact_text(&Rational::new(numerator, denominator).unwrap());
        assert_eq!(text(7, 1), "7");
        assert_eq!(text(-7, 20), "-0.35");
        assert_eq!(text(2, 3), "2/3");
        assert_eq!(text(-1, 3000), "-1/3000");
        assert_eq!(text(1, 1_000_000_000), "0.000000001");
        assert_eq!(text(12345, 100), "123.45");
    }

    #[test]
    fn small_coefficients_have_powers_of_ten() {
        for (decimal, expected) in [
            ("0.0001", "0.0001"),
            ("-0.00012", "-0.00012"),
            ("0.00001", "1e-5"),
            ("-0.000099", "-9.9e-5"),
            ("0.000000000000000000000001", "1e-24"),
            ("-12.5", "-12.5"),
            ("0", "0"),
        ] {
            let number = Number::Rational(Rational::from_decimal(decimal).unwrap());
            assert_eq!(coefficient_text(&number), expected);
        }
        assert_eq!(
            coefficient_text(&Number::Rational(Rational::new(-1, 3000).unwrap())),
            "-1/3000"
        );
        let number = |text: &str| Number::Rational(Rational::from_decimal(text).unwrap());
        let long = &number("1.5e-60") * &number("3").recip();
        assert_eq!(coefficient_text(&long), "5e-61");
        for (value, expected) in
            [(-2.5e-12, "-2.5e-12"), (0.0001, "0.0001"), (2.0, "2"), (0.0, "0")]
        {
            assert_eq!(coefficient_text(&Number::real(value)), expected);
        }
    }

    #[test]
    fn every_printed_decimal_reads_back() {
        for text in ["0.000123", "-12.5", "98765432109876543210.123456789", "0.0625"] {
            assert_eq!(exact_text(&Rational::from_decimal(text).unwrap()), text);
        }
    }
}
