//! Printed decimals, which stand for rounded numbers.

use std::ops::Range;

use robot_document::DIGITS;
use robot_symbolic::formula::Step;
use robot_symbolic::{Formula, Number, Rational};

use super::printed::operand_length;

/// The decimals that are factors of a part of a formula.
enum Part {
    /// None: a decimal in a sum, for example, is exact.
    Exact,
    /// The one with this index.
    Factor(usize),
    Several,
}

/// Half a unit of the last printed digit of a formula's decimal, as a fraction of the decimal: the largest relative
/// error of the formula's coefficients. It is `None` unless the formula is a multiple of exactly one decimal: integers, and
/// quotients of integers, are exact, and so are decimals in sums and in divisors.
pub(super) fn of_formula(formula: &Formula) -> Option<Number> {
    let text = formula.text();
    let decimal = text.get(only_factor(text, decimals(text))?)?;
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

/// The largest error of a sum of decimals, relative to the derived coefficient, from which on a wrong digit is seen.
const SMALL: f64 = 1e-8;

/// Whether the largest error of a sum of decimals is that of decimals with many digits.
pub(super) fn is_small(error: &Number, derived: &Number) -> bool {
    error.to_f64() <= SMALL * derived.to_f64().abs()
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

/// Whether a printed coefficient is an integer, and a derived one is this integer to the digits that equations have by
/// default. It differs further behind if a component of a joint axis is nearly zero.
pub(super) fn is_rounded_to_integer(printed: &Number, derived: &Number) -> bool {
    let is_integer = printed.as_rational().and_then(Rational::to_integer).is_some();
    let rounded = format!("{:.*e}", DIGITS - 1, derived.to_f64());
    is_integer && rounded.parse().is_ok_and(|rounded: f64| rounded == printed.to_f64())
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

/// The decimal of which a formula is a multiple; `None` if there is none, or several. It is found by reading the formula
/// once, with a symbol instead of each of its `places`.
fn only_factor(text: &str, mut places: Vec<Range<usize>>) -> Option<Range<usize>> {
    let mut symbol = "decimal".to_owned();
    while text.contains(&symbol) {
        symbol.push('_');
    }
    let (mut named, mut end) = (String::new(), 0);
    for (index, place) in places.iter().enumerate() {
        named += text.get(end..place.start)?;
        named += &format!("{symbol}{index}");
        end = place.end;
    }
    named += text.get(end..)?;
    let whole = Formula::parse_with_dots(&named).ok()?.fold(|step| {
        Some(match step {
            Step::Symbol(name, _) => {
                let index = name.strip_prefix(&symbol).and_then(|index| index.parse().ok());
                index.map_or(Part::Exact, Part::Factor)
            }
            Step::Mul(Part::Exact, part)
            | Step::Mul(part, Part::Exact)
            | Step::Div(part, _)
            | Step::Neg(part) => part,
            Step::Mul(..) => Part::Several,
            _ => Part::Exact,
        })
    })?;
    match whole {
        Part::Factor(index) if index < places.len() => Some(places.swap_remove(index)),
        Part::Factor(_) | Part::Exact | Part::Several => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::mistake::Mistake;
    use super::super::tests::{compared, link};
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
            // Decimals in sums are exact.
            ("0.5*m1/(0.25 + p1^2)", of(5, 50)),
            ("0.5*(0.25*m1 + 1.5)", of(5, 50)),
        ] {
            assert_eq!(share(text), expected, "{text}");
        }
    }

    /// The formula is read once, and not once for each decimal.
    #[test]
    fn many_decimals_take_no_longer_than_few() {
        let sum = ["0.1*m1"; 4_000].join(" + ");
        assert_eq!(share(&format!("({sum})*q1")), None);
        assert_eq!(share(&format!("0.5*({sum})")), share("0.5*m1"));
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
    fn an_integer_stands_for_what_it_is_to_ten_digits() {
        let number = |text: &str| Number::Rational(Rational::from_decimal(text).unwrap());
        let of = |printed: &str, derived: &str| {
            is_rounded_to_integer(&number(printed), &number(derived))
        };
        assert!(of("-1", "-0.99999999999") && of("2", "2.0000000004") && of("3", "3"));
        assert!(!of("-1", "0.99999999999") && !of("2", "2.0000000006") && !of("0", "1e-12"));
        assert!(!of("0.5", "0.50000000000001"));
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

    /// The number of coefficients that agree only to the digits printed, and the mistakes.
    fn rounded(inertia: &str, right: &str) -> (usize, Vec<String>) {
        let found = compared(&link("1", "0", inertia), &format!("Q1 = {right}\n")).unwrap();
        let mistakes = found.differences.iter().flat_map(|one| &one.mistakes);
        (found.rounded, mistakes.map(Mistake::to_string).collect())
    }

    #[test]
    fn three_decimals_in_a_product_are_exact() {
        let (rounded, mistakes) = rounded("0.0126", "0.5*0.25*0.1*qdd1");
        assert_eq!((rounded, mistakes.len()), (0, 1), "{mistakes:?}");
    }

    #[test]
    fn a_decimal_agrees_with_what_rounds_to_it() {
        let inertia = "1.126125000000000182";
        let right = vec![];
        for text in [
            "1.126125*qdd1",
            "1.1*qdd1",
            "qdd1*1.13",
            "(1.126)*qdd1",
            "2*0.563*qdd1",
            "1126.1e-3*qdd1",
        ] {
            assert_eq!(rounded(inertia, text), (1, right.clone()), "{text}");
        }
        assert_eq!(rounded(inertia, "1.126125000000000182*qdd1"), (0, right.clone()));
        assert_eq!(rounded("1.255", "1.26*qdd1"), (1, right.clone()));
        assert_eq!(rounded("1.255", "1.25*qdd1"), (1, right.clone()));
        assert_eq!(rounded("1/3", "0.3333*qdd1"), (1, right.clone()));
        // Like terms of which only one is rounded, and a term in front of another that is wrong.
        assert_eq!(rounded("1.126125", "qdd1/4 + 0.876*qdd1"), (1, right));
        assert_eq!(rounded("1.126125", "1.126*qdd1 + 3*qdd1"), (1, vec!["extra term".to_owned()]));
    }

    #[test]
    fn a_wrong_digit_is_a_difference() {
        for (inertia, printed, shown) in [
            ("1.126125", "1.12*qdd1", "1.12 for 1.126125"),
            ("1.126125", "1.126126*qdd1", "1.126126 for 1.126125"),
            ("1.2551", "1.25*qdd1", "1.25 for 1.2551"),
            ("0.0004", "0.00*qdd1", ""),
            // Integers and quotients of integers are exact.
            ("1.0001", "qdd1", "1 for 1.0001"),
            ("2.9999", "3*qdd1", "3 for 2.9999"),
            ("0.3333", "1/3*qdd1", "1/3 for 0.3333"),
        ] {
            let (count, mistakes) = rounded(inertia, printed);
            let expected = match shown {
                "" => "missing term".to_owned(),
                shown => format!("coefficient: {shown}"),
            };
            assert_eq!((count, mistakes), (0, vec![expected]), "{inertia}, {printed}");
        }
        // Of two rounded numbers, one may be wrong although their sum is right to its digits.
        assert_eq!(rounded("1.126125", "0.563*qdd1 + 0.563*qdd1").0, 0);
        assert!(!rounded("1.126125", "0.563*qdd1 + 0.563*qdd1").1.is_empty());
        // Decimals that programs print.
        assert!(rounded("1.126125", "0.5630625001*qdd1 + 0.5630624999*qdd1").1.is_empty());
        assert!(!rounded("1.126125", "0.5630625101*qdd1 + 0.5630624999*qdd1").1.is_empty());
        // A difference of another kind is not also one of the coefficient.
        assert_eq!(rounded("1.126125", "-1.126*qdd1").1, ["sign"]);
        assert_eq!(rounded("1.126125", "1.126*qd1").1, ["dot: qd1 for qdd1"]);
    }

    /// A sum with cos(0.3) is printed as a decimal beside sin(π/5), which is not.
    #[test]
    fn a_constant_can_be_a_decimal_beside_another_that_is_not() {
        let text = "format = 1\n[robot]\nname = \"one\"\ngravity = [0, -9.81, 0]\n[[link]]\nname = \"1\"\n\
                    joint = { type = \"revolute\", axis = \"z\" }\norigin = { rpy = [0, 0, \"pi/5\"] }\n\
                    mass = 2\ncenter_of_mass = [\"0.022 + 0.0045*cos(0.3)\", 0.1, 0]\n\
                    inertia = { zz = 0.4, unchecked = true }\n";
        let robot = robot_model::description::read_toml("one", text).unwrap().robot;
        let options = robot_document::EquationOptions {
            form: robot_document::Form::Expanded,
            rounds_roots: true,
            ..robot_document::EquationOptions::default()
        };
        let printed = robot_document::equations(&robot, &options).unwrap().readable(Some(10));
        let texts: Vec<String> =
            printed.quantities().map(|one| format!("{} = {}", one.name, one.text)).collect();
        let text = texts.join("\n");
        assert!(text.contains("sin(pi/5)") && !text.contains("cos(0.3)"), "{text}");
        assert!(compared(&robot, &text).unwrap().differences.is_empty(), "{text}");
        let wrong = compared(&robot, &text.replace("sin(pi/5)", "cos(pi/5)")).unwrap();
        assert!(!wrong.differences.is_empty());
    }
}
