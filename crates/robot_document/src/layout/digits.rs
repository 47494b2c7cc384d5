//! Numbers for readers: fractions that people write, decimals instead of long fractions, and rounding.

use robot_symbolic::Rational;
use robot_symbolic::print::{exact_text, scientific};

use super::math::{Math, Script};

/// The number of significant digits of decimals for readers: many more than the known digits of any parameter, but
/// without the rounding errors of doubles, as in 1.1550000000000002.
pub const DIGITS: usize = 10;

/// The largest number of digits of a fraction, above and below together; longer fractions are printed as decimals.
const MOST_DIGITS: usize = 8;
/// The largest number of digits of exact decimals; longer ones are printed with the digits of the nearest double.
const DOUBLE: usize = 17;
/// The denominators of fractions that can replace decimals.
const DENOMINATORS: [u64; 2] = [2, 4];
/// The largest denominator of fractions of π and of roots, and the largest numerator of other fractions.
const LARGEST: u64 = 12;

/// Writes the numbers of a formula as people do: `√2/2` for `0.5 √2`, and `1/2` in sums and products if all decimals of
/// the formula are such fractions. With `digits`, numbers are rounded to that many significant digits first.
pub(crate) fn tidied(math: &Math, digits: Option<usize>) -> Math {
    let tidy = mapped(math.clone(), &|piece| rounded(piece, digits));
    // A number that was rounded is not exactly a fraction.
    let simple = is_simple(math) && (digits.is_none() || tidy == *math);
    let tidy = mapped(tidy, &|piece| fractions(piece, simple, digits));
    mapped(tidy, &|piece| match piece {
        Math::Number(text) => number(&text),
        other => other,
    })
}

/// The layout of a number; a small one, or one with an exponent, is a product with a power of ten.
pub(crate) fn number(text: &str) -> Math {
    let Some((mantissa, exponent)) = power_of_ten(text) else {
        return Math::Number(text.to_owned());
    };
    let exponent = match exponent.strip_prefix('-') {
        Some(digits) => Math::Row(vec![Math::Sign('-'), Math::Number(digits.to_owned())]),
        None => Math::Number(exponent),
    };
    let power = Math::Number("10".to_owned()).with_upper(exponent);
    match mantissa.as_str() {
        "1" => power,
        _ => Math::Row(vec![Math::Number(mantissa), Math::Sign('·'), power]),
    }
}

/// Splits a small decimal, or a number with an exponent, into a mantissa and the exponent of ten.
fn power_of_ten(text: &str) -> Option<(String, String)> {
    if let Some((mantissa, exponent)) = text.split_once('e') {
        return Some((mantissa.to_owned(), exponent.to_owned()));
    }
    scientific(text)
}

/// Whether a formula has decimals of more than `digits` significant digits.
pub(crate) fn has_longer(math: &Math, digits: usize) -> bool {
    let longer = std::cell::Cell::new(false);
    mapped(tidied(math, None), &|piece| {
        if let Math::Number(text) = &piece
            && text.contains('.')
            && significant(text) > digits
        {
            longer.set(true);
        }
        piece
    });
    longer.get()
}

/// Writes the numbers of a text for readers, as [`tidied`] does in a formula: `sqrt(2)/2` for `0.5*sqrt(2)`, and no
/// factor 1. With `digits`, decimals, except exponents, and long quotients are rounded to that many significant digits;
/// otherwise only those with more digits than a double.
pub(crate) fn tidied_text(text: &str, digits: Option<usize>) -> String {
    let mut shown = String::new();
    let mut rest = text;
    let mut in_name = false;
    while let Some(first) = rest.chars().next() {
        if in_name || !first.is_ascii_digit() {
            in_name = first.is_ascii_alphanumeric() || matches!(first, '_' | '.');
            shown.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let (number, after) = text_number(rest, &shown, digits);
        rest = after;
        if shown.ends_with(['^', '/']) {
            shown.push_str(&number);
        } else if let Some((product, after)) = times_constant(&number, rest, digits) {
            shown.push_str(&product);
            rest = after;
        } else if let Some(after) = rest.strip_prefix('*').filter(|_| number == "1") {
            rest = after;
        } else {
            shown.push_str(&number);
        }
    }
    shown
}

/// The number at the beginning of a text, for readers, and the text after it; `before` is the text before it.
fn text_number<'t>(text: &'t str, before: &str, digits: Option<usize>) -> (String, &'t str) {
    let (number, after) = split_number(text);
    let is_power = before.ends_with('^');
    let below = after.strip_prefix('/').map(split_number);
    let below = below.filter(|(below, after)| {
        !below.is_empty() && !after.starts_with('^') && !is_power && !before.ends_with('/')
    });
    let (short, after) = match below {
        Some((below, after)) if is_long(number, below) => {
            (short(&quotient(number, below), digits), after)
        }
        Some((below, after)) if fraction_of(number, below).is_some() => {
            return (format!("{number}/{below}"), after);
        }
        _ => (short(number, digits.filter(|_| !is_power)), after),
    };
    match power_of_ten(&short) {
        Some((mantissa, exponent)) => (format!("{mantissa}e{exponent}"), after),
        None => (short, after),
    }
}

/// The product of a number with the root or π after the `*` at the beginning of a text, if the number is a fraction, and the text
/// after the product.
fn times_constant<'t>(
    number: &str,
    after: &'t str,
    digits: Option<usize>,
) -> Option<(String, &'t str)> {
    let [above, below] = match number.split_once('/') {
        Some((above, below)) => fraction_of(above, below)?,
        None => fraction(number)?,
    };
    let factor = after.strip_prefix('*')?;
    let end = match factor.strip_prefix("sqrt(") {
        Some(inside) => "sqrt(".len() + closing(inside)? + 1,
        None => factor.strip_prefix("pi").map(|_| "pi".len())?,
    };
    let (factor, after) = factor.split_at_checked(end)?;
    let goes_on = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '^');
    if after.starts_with(goes_on) {
        return None;
    }
    let times = if above > 1 { format!("{above}*") } else { String::new() };
    Some((format!("{times}{}/{below}", tidied_text(factor, digits)), after))
}

/// The place of the parenthesis that closes the one before a text.
fn closing(text: &str) -> Option<usize> {
    let mut open = 1_usize;
    let found = text.char_indices().find(|(_, character)| {
        match character {
            '(' => open += 1,
            ')' => open -= 1,
            _ => {}
        }
        open == 0
    });
    found.map(|(place, _)| place)
}

/// Splits off the number at the beginning of a text, with its point and exponent.
fn split_number(text: &str) -> (&str, &str) {
    let is_digit = |c: char| c.is_ascii_digit() || c == '.';
    let mut end = text.find(|c| !is_digit(c)).unwrap_or(text.len());
    if let Some(exponent) = text[end..].strip_prefix('e') {
        let digits = exponent.trim_start_matches('-');
        let length = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        if length > 0 {
            end = text.len() - digits.len() + length;
        }
    }
    text.split_at(end)
}

fn is_long(above: &str, below: &str) -> bool {
    above.len() + below.len() > MOST_DIGITS
}

/// The quotient of two numbers as a decimal number with the digits of a double.
fn quotient(above: &str, below: &str) -> String {
    let [above_value, below_value] = [above, below].map(Rational::from_decimal);
    match (above_value, below_value) {
        (Some(value), Some(divisor)) => match divisor.recip() {
            Some(reciprocal) => plain((&value * &reciprocal).to_f64()),
            None => format!("{above}/{below}"),
        },
        _ => format!("{above}/{below}"),
    }
}

/// Writes a number without an exponent.
fn plain(value: f64) -> String {
    format!("{value}")
}

/// Rounds a decimal to `digits` significant digits, or to those of a double, if it has more; integers stay as they are.
fn short(number: &str, digits: Option<usize>) -> String {
    let (mantissa, exponent) = number.split_once('e').map_or((number, ""), |(m, e)| (m, e));
    let mantissa = mantissa.strip_suffix(".0").unwrap_or(mantissa);
    let significant = significant(mantissa);
    let decimal = mantissa.parse::<f64>().ok().filter(|_| mantissa.contains('.'));
    let text = match (decimal, digits) {
        (Some(value), Some(digits)) if significant > digits => significantly(value, digits),
        (Some(value), None) if significant > DOUBLE => plain(value),
        _ => mantissa.to_owned(),
    };
    match exponent {
        "" => text,
        exponent => normal(&text, exponent),
    }
}

/// A number with an exponent; a mantissa that was rounded up to 10 becomes 1.
fn normal(mantissa: &str, exponent: &str) -> String {
    let value = exponent.parse::<i64>().ok().filter(|_| mantissa == "10");
    match value.map(|value| value + 1) {
        None => format!("{mantissa}e{exponent}"),
        Some(value @ -4..=0) => plain(10_f64.powi(value as i32)),
        Some(value) => format!("1e{value}"),
    }
}

/// The number of digits of a decimal, without leading zeros.
fn significant(mantissa: &str) -> usize {
    mantissa.trim_start_matches(['0', '.']).replace('.', "").len()
}

/// Rounds a value to this many significant digits.
fn significantly(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let rounded = Rational::from_decimal(&scientific).map(|rounded| exact_text(&rounded));
    // A number with too many decimal places is written as a quotient.
    rounded.filter(|text| !text.contains('/')).unwrap_or(scientific)
}

/// Rounds a piece if it is a number; indices never get here.
fn rounded(piece: Math, digits: Option<usize>) -> Math {
    match piece {
        Math::Number(text) => Math::Number(short(&text, digits)),
        other => other,
    }
}

/// Maps every piece of a formula, inner pieces first; symbols and indices are not mapped.
fn mapped(math: Math, map: &dyn Fn(Math) -> Math) -> Math {
    let inside = |math: Math| mapped(math, map);
    let math = match math {
        Math::Row(pieces) => Math::Row(pieces.into_iter().map(inside).collect()),
        Math::Fenced(fence, part) => Math::Fenced(fence, Box::new(inside(*part))),
        Math::Root(part) => Math::Root(Box::new(inside(*part))),
        Math::Fraction(parts) => Math::Fraction(Box::new(parts.map(inside))),
        Math::Matrix(rows) => {
            let row = |row: Vec<Math>| row.into_iter().map(inside).collect();
            Math::Matrix(rows.into_iter().map(row).collect())
        }
        Math::Script(script) => match script.base {
            Math::Fenced(..) => {
                let Script { base, lower, upper } = *script;
                Math::Script(Box::new(Script { base: inside(base), lower, upper }))
            }
            _ => Math::Script(script),
        },
        other => other,
    };
    map(math)
}

/// Whether every decimal of a formula is a multiple of 1/2 or 1/4 with a small numerator.
fn is_simple(math: &Math) -> bool {
    let simple = std::cell::Cell::new(true);
    mapped(math.clone(), &|piece| {
        if let Math::Number(text) = &piece
            && text.contains('.')
            && fraction(text)
                .is_none_or(|[above, below]| above > LARGEST || !DENOMINATORS.contains(&below))
        {
            simple.set(false);
        }
        piece
    });
    simple.get()
}

/// Writes fractions instead of decimals in products, and decimals, rounded to `digits`, instead of long fractions.
fn fractions(piece: Math, simple: bool, digits: Option<usize>) -> Math {
    match piece {
        Math::Row(pieces) => Math::Row(row(pieces, simple)),
        Math::Fraction(parts) => match parts.as_ref() {
            [Math::Number(above), Math::Number(below)] if is_long(above, below) => {
                Math::Number(short(&quotient(above, below), digits))
            }
            _ => Math::Fraction(parts),
        },
        other => other,
    }
}

fn row(pieces: Vec<Math>, simple: bool) -> Vec<Math> {
    let mut tidy: Vec<Math> = vec![];
    // A row of only a number, possibly with a sign, is a value and keeps its decimals.
    let is_value = |piece: &Math| matches!(piece, Math::Number(_) | Math::Sign(_));
    let simple = simple && !pieces.iter().all(is_value);
    let mut pieces = pieces.into_iter().peekable();
    while let Some(piece) = pieces.next() {
        let is_first = tidy.last().is_none_or(|piece| matches!(piece, Math::Sign('+' | '-')));
        let is_factor = pieces.peek().is_some_and(|next| !matches!(next, Math::Sign(_)));
        if is_first && is_factor && piece == Math::Number("1".to_owned()) {
            continue;
        }
        let Some([above, below]) = parts(&piece) else {
            tidy.push(piece);
            continue;
        };
        let number = |value: u64| Math::Number(value.to_string());
        match pieces.peek() {
            Some(Math::Letter('π')) => {
                tidy.extend((above > 1).then(|| number(above)));
                tidy.extend(pieces.next());
                tidy.extend([Math::Sign('/'), number(below)]);
            }
            Some(Math::Root(_)) => {
                let factors = (above > 1).then(|| number(above)).into_iter().chain(pieces.next());
                let above = Math::row(factors.collect());
                tidy.push(Math::Fraction(Box::new([above, number(below)])));
            }
            _ if simple && matches!(piece, Math::Number(_)) => {
                tidy.push(Math::Fraction(Box::new([number(above), number(below)])));
            }
            _ => tidy.push(piece),
        }
    }
    tidy
}

/// The numerator and denominator of a number that is not an integer.
fn parts(piece: &Math) -> Option<[u64; 2]> {
    match piece {
        Math::Number(digits) => fraction(digits),
        Math::Fraction(parts) => match parts.as_ref() {
            [Math::Number(above), Math::Number(below)] => fraction_of(above, below),
            _ => None,
        },
        _ => None,
    }
}

/// A quotient of integers with a denominator up to [`LARGEST`].
fn fraction_of(above: &str, below: &str) -> Option<[u64; 2]> {
    Some([above.parse().ok()?, below.parse().ok()?]).filter(|[_, below]| *below <= LARGEST)
}

/// A decimal as a fraction with a denominator up to [`LARGEST`]; `None` if there is none or it is an integer.
fn fraction(digits: &str) -> Option<[u64; 2]> {
    let (whole, part) = digits.split_once('.')?;
    let below = 10_u64.checked_pow(u32::try_from(part.len()).ok()?)?;
    let above: u64 = format!("{whole}{part}").parse().ok()?;
    let fraction = (2..=LARGEST).find_map(|denominator| {
        let product = above.checked_mul(denominator)?;
        product.is_multiple_of(below).then_some([product / below, denominator])
    });
    fraction.filter(|_| !above.is_multiple_of(below))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::{formula, read};

    #[test]
    fn exact_parts_are_fractions() {
        for (given, expected) in [
            (r"0.5 \pi", r"\pi/ 2"),
            (r"-0.75 \pi", r"-3 \pi/ 4"),
            (r"\frac{2}{3} \pi", r"2 \pi/ 3"),
            (r"2 \pi + 1.5 \pi", r"2 \pi+ 3 \pi/ 2"),
            (r"0.5 \sqrt{2}", r"\frac{\sqrt{2}}{2}"),
            (r"1.5 \sqrt{2} l_1", r"\frac{3 \sqrt{2}}{2} l_1"),
            (r"l_1 \left(0.25 \pi\right)", r"l_1 \left(\pi/ 4\right)"),
            (r"a - 0.5 c d", r"a-\frac{1}{2} c d"),
            (r"0.123 \pi + 0.5 q", r"0.123 \pi+ 0.5 q"),
            (r"0.5 + 0.25 q", r"\frac{1}{2}+\frac{1}{4} q"),
            (r"-0.5", r"-0.5"),
            (r"63.5 q", r"63.5 q"),
            (r"2.75 q", r"\frac{11}{4} q"),
            (
                r"\frac{745523852833173678489}{559146513121000000000000} q",
                r"0.0013333246927927124 q",
            ),
            (r"\frac{2}{3} q", r"\frac{2}{3} q"),
        ] {
            let shown = formula(&tidied(&read(given).unwrap(), None));
            assert_eq!(shown.replace(' ', ""), expected.replace(' ', ""), "{given}");
        }
    }

    #[test]
    fn texts_have_the_fractions_of_formulas() {
        for (given, expected) in [
            ("0.5*sqrt(2)", "sqrt(2)/2"),
            ("-1.5*sqrt(2)*l1", "-3*sqrt(2)/2*l1"),
            ("a - 2/3*sqrt(3)*b", "a - 2*sqrt(3)/3*b"),
            ("q1 + 0.75*pi", "q1 + 3*pi/4"),
            ("0.25*sqrt(1 + 0.5*sqrt(3))", "sqrt(1 + sqrt(3)/2)/4"),
            ("a*0.5*sqrt(2)/b", "a*sqrt(2)/2/b"),
            ("0.00000000002991*b", "2.991e-11*b"),
            ("2991304605/100000000000000000001*b", "2.991304605e-11*b"),
        ] {
            let shown = tidied_text(given, None);
            assert_eq!(shown, expected);
            let value = |text: &str| {
                let value = |name: &str| match name {
                    "a" => 0.3,
                    "b" => 0.7,
                    "l1" => 1.1,
                    _ => -0.4,
                };
                robot_symbolic::Formula::parse(text).unwrap().evaluate(value)
            };
            assert!((value(given) - value(&shown)).abs() < 1e-15, "{given}");
        }
        for same in ["a/0.5*sqrt(2)", "0.123*sqrt(2)", "0.5*sqrt(2)^3", "x^0.5*sqrt(2)", "0.5*pi_2"]
        {
            assert_eq!(tidied_text(same, None), same);
        }
    }

    #[test]
    fn a_factor_that_rounds_to_one_is_left_out() {
        for (given, expected) in [
            (r"0.96 q - 1.04 \sin q", r"q-\sin q"),
            (r"-0.96 \left(a + 1.02 b\right)", r"-\left(a+b\right)"),
            (r"0.96", "1"),
            (r"a + 0.96", "a+1"),
            (r"\frac{0.96}{a} + \frac{1.03 b}{a}", r"\frac{1}{a}+\frac{b}{a}"),
            (r"a / 1.04 b", "a/1 b"),
            (r"0.0123 q", "0.01 q"),
            (r"\frac{745523852833173678489}{559146513121000000000000} q", r"0.001 q"),
            (r"3.0 q", "3 q"),
            (r"0.0000096 q", r"10^{-5}q"),
        ] {
            let shown = formula(&tidied(&read(given).unwrap(), Some(1)));
            assert_eq!(shown.replace(' ', ""), expected.replace(' ', ""), "{given}");
        }
        for (given, expected) in [
            ("0.96*q1 - 1.04*sin(q2)", "q1 - sin(q2)"),
            ("-0.96*(a + 1.02*b)", "-(a + b)"),
            ("0.96", "1"),
            ("a + 0.96", "a + 1"),
            ("0.96/a + 1.03*b/a", "1/a + b/a"),
            ("a/1.04*b + 2^1.04*c", "a/1*b + 2^1.04*c"),
            ("0.0123*q1", "0.01*q1"),
            ("0.0000096*q1", "1e-5*q1"),
        ] {
            assert_eq!(tidied_text(given, Some(1)), expected);
        }
    }

    #[test]
    fn digits_are_significant_and_indices_stay() {
        let shown = |text: &str| formula(&tidied(&read(text).unwrap(), Some(4))).replace(' ', "");
        assert_eq!(
            shown(r"0.0002338560 q_{12345} + 12.34567 x^{2}"),
            r"0.0002339q_{12345}+12.35x^{2}"
        );
        let rounded = tidied(&read(r"1.49999 q + 0.5").unwrap(), Some(2));
        assert_eq!(formula(&rounded).replace(' ', ""), "1.5q+0.5");
        assert_eq!(
            tidied_text("k_12345 = 0.123456*x^12 - 99999.5 + 0.5", Some(4)),
            "k_12345 = 0.1235*x^12 - 100000 + 0.5"
        );
        let long = "745523852833173678489/559146513121000000000000*q1 + 2/3*q2";
        assert_eq!(tidied_text(long, None), "0.0013333246927927124*q1 + 2/3*q2");
        assert_eq!(tidied_text("F_l5.x = 1.23456e-7*a", Some(3)), "F_l5.x = 1.23e-7*a");
        let tiny = format!("0.{}17766633744571327*a", "0".repeat(41));
        assert_eq!(tidied_text(&tiny, Some(4)), "1.777e-42*a");
        assert_eq!(tidied_text("9.9999999e-6*a - 9.99999999e-5", Some(4)), "1e-5*a - 0.0001");
        let noisy = read("1.1550000000000002 q").unwrap();
        assert_eq!(formula(&tidied(&noisy, Some(10))).replace(' ', ""), "1.155q");
        assert_eq!(formula(&tidied(&noisy, None)).replace(' ', ""), "1.1550000000000002q");
        let small =
            tidied(&read("0.0000000000128770759612 q - 0.00001 r + 0.0001").unwrap(), Some(4));
        assert_eq!(formula(&small).replace(' ', ""), r"{1.288\cdot10^{-11}}q-10^{-5}r+0.0001");
        assert_eq!(tidied_text("0.00001287707596*x^12", Some(4)), "1.288e-5*x^12");
        let longer = |text: &str| has_longer(&read(text).unwrap(), 4);
        assert!(longer("0.00012345 q") && longer(r"\left(a + 12.345\right) q"));
        assert!(!longer("0.0001234 q_{12345}") && !longer("123456 q + 1.234"));
    }
}
