//! Printed decimals, which stand for rounded numbers.

use std::ops::Range;

use robot_symbolic::formula::Step;
use robot_symbolic::{Formula, Number, Rational};

use super::printed::operand_length;

/// What a part of a formula is if one of its numbers stands for a rounded one.
enum Part {
    /// It does not contain the rounded number.
    Exact,
    /// It is a multiple of the rounded number.
    Multiple,
}

/// Half a unit of the last printed digit of a formula's decimal, as a fraction of the decimal: the largest relative
/// error of the formula's coefficients. It is `None` unless the formula is a multiple of exactly one decimal: integers, and
/// quotients of integers, are exact, and so are decimals in sums, such as a denominator.
pub(super) fn of_formula(formula: &Formula) -> Option<Number> {
    let text = formula.text();
    let is_factor = |place: &Range<usize>| is_multiple(text, place) == Some(true);
    let factors: Vec<Range<usize>> = decimals(text).into_iter().filter(is_factor).collect();
    let [place] = &factors[..] else { return None };
    let decimal = text.get(place.clone())?;
    let value = Rational::from_decimal(decimal).filter(|value| !value.is_zero())?;
    let half = Number::Rational(half_unit(decimal)?);
    Some(&half * &Number::Rational(value).recip())
}

/// The largest relative error of a derived coefficient that is computed with floating-point numbers.
const COMPUTED: f64 = 4.0 * f64::EPSILON;

/// Whether a printed coefficient is a derived one that was computed with floating-point numbers, within its error.
pub(super) fn is_computed(printed: &Number, derived: &Number) -> bool {
    match derived {
        Number::Real(real) => {
            is_within(printed, derived, &Number::real(COMPUTED * real.value().abs()))
        }
        Number::Rational(_) => false,
    }
}

/// Whether a printed coefficient, of which `error` is the largest error, stands for a derived one, or for the nearest
/// `f64` to it, from which programs print numbers.
pub(super) fn stands_for(printed: &Number, derived: &Number, error: &Number) -> bool {
    if is_computed(printed, derived) {
        return true;
    }
    let nearest = Rational::from_f64(derived.to_f64()).map(Number::Rational);
    is_within(printed, derived, error)
        || nearest.is_some_and(|nearest| is_within(printed, &nearest, error))
}

/// Whether two numbers differ by at most `width`.
fn is_within(one: &Number, other: &Number, width: &Number) -> bool {
    let difference = one - other;
    let distance = if difference.is_negative() { -&difference } else { difference };
    let beyond = &distance - width;
    beyond.is_negative() || beyond.is_zero()
}

/// The places of numbers with a decimal point or a negative exponent.
fn decimals(text: &str) -> Vec<Range<usize>> {
    let bytes = text.as_bytes();
    let (mut places, mut place) = (vec![], 0);
    while let Some(byte) = bytes.get(place) {
        let end = place + operand_length(bytes, place).max(1);
        let operand = text.get(place..end).unwrap_or_default();
        let is_number = byte.is_ascii_digit() || *byte == b'.';
        if is_number && operand.contains(['.', '-']) {
            places.push(place..end);
        }
        place = end;
    }
    places
}

/// Half a unit of the last digit: 0.005 for `1.25`.
fn half_unit(decimal: &str) -> Option<Rational> {
    let (digits, exponent) = decimal.split_once(['e', 'E']).unwrap_or((decimal, "0"));
    let exponent: i32 = exponent.parse().ok()?;
    let places = digits.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let last = exponent.checked_sub(i32::try_from(places).ok()?)?.checked_sub(1)?;
    Rational::from_decimal(&format!("5e{last}"))
}

/// Whether a formula is a multiple of its number at `place`, for which it is read with a symbol instead.
fn is_multiple(text: &str, place: &Range<usize>) -> Option<bool> {
    let mut symbol = "decimal".to_owned();
    while text.contains(&symbol) {
        symbol.push('_');
    }
    let (before, after) = (text.get(..place.start)?, text.get(place.end..)?);
    let formula = Formula::parse_with_dots(&format!("{before}{symbol}{after}")).ok()?;
    let whole = formula.fold(|step| match step {
        Step::Symbol(name, _) if name == symbol => Some(Part::Multiple),
        Step::Number(_) | Step::Pi | Step::Symbol(..) => Some(Part::Exact),
        Step::Mul(Part::Multiple, Part::Exact)
        | Step::Mul(Part::Exact, Part::Multiple)
        | Step::Div(Part::Multiple, Part::Exact)
        | Step::Neg(Part::Multiple) => Some(Part::Multiple),
        Step::Add(Part::Exact, Part::Exact)
        | Step::Sub(Part::Exact, Part::Exact)
        | Step::Mul(Part::Exact, Part::Exact)
        | Step::Div(Part::Exact, Part::Exact)
        | Step::Neg(Part::Exact)
        | Step::Power(Part::Exact, _)
        | Step::Call(_, Part::Exact)
        | Step::Tan(Part::Exact) => Some(Part::Exact),
        _ => None,
    })?;
    Some(matches!(whole, Part::Multiple))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(text: &str) -> Option<Number> {
        of_formula(&Formula::parse_with_dots(text).unwrap())
    }

    #[test]
    fn a_decimal_stands_for_a_rounded_number_where_it_is_a_factor() {
        let of = |above, below| Some(Number::Rational(Rational::new(above, below).unwrap()));
        for (text, expected) in [
            ("1.25", of(5, 1250)),
            ("- 1.250*qd1^2*(m1 + m2)", of(5, 12500)),
            ("(2*0.5/3)*sin(q1)", of(1, 10)),
            // Names contain digits, and powers of ten are exact.
            ("(2.5*10^(-3))*F_l5.x", of(5, 250)),
            ("m1*1.5e-3*x2", of(5, 150)),
            ("2e-3*m1", of(5, 20)),
            ("decimal*0.5*decimal_", of(5, 50)),
        ] {
            assert_eq!(share(text), expected, "{text}");
        }
    }

    #[test]
    fn other_numbers_are_exact() {
        for text in [
            "2*m1",
            "1/2*m1",
            "2e3*m1",
            "0.0*m1",
            "m1/0.5",
            "0.5*0.25*m1",
            "(0.5 + m1)*m2",
            "sin(0.5*q1)",
            "0.5^2*m1",
            "m1 - 0.5",
            "tan(0.5)",
            "q1*x1_5",
        ] {
            assert_eq!(share(text), None, "{text}");
        }
    }

    #[test]
    fn half_a_unit_is_within_and_more_is_not() {
        let number = |text: &str| Number::Rational(Rational::from_decimal(text).unwrap());
        let within =
            |one: &str, other: &str| is_within(&number(one), &number(other), &number("0.005"));
        assert!(within("1.25", "1.255") && within("1.25", "1.245") && within("-1", "-1"));
        assert!(!within("1.25", "1.2550001") && !within("1.25", "1.2449999") && !within("1", "-1"));
    }

    /// The digits after 2.107104072 are just above one half, and those of the nearest `f64` just below.
    #[test]
    fn a_number_may_be_rounded_from_the_nearest_double() {
        let number = |text: &str| Number::Rational(Rational::from_decimal(text).unwrap());
        let derived = number("2.10710407250000002217936");
        let of = |printed: &str| stands_for(&number(printed), &derived, &number("5e-10"));
        assert!(of("2.107104072") && of("2.107104073"));
        assert!(!of("2.107104071") && !of("2.107104074"));
    }
}
