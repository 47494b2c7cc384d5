//! The coefficients of base parameters: short ones as they are, long ones with rounded numbers.

use robot_dynamics::base_parameters::{BaseParameter, BaseParameters, base_parameters};
use robot_dynamics::functions::Derivation;
use robot_model::functions::out_of_reach;
use robot_model::robot::Robot;
use robot_symbolic::{
    AngleSums, Expr, Id, Number, Polynomial, PolynomialError, PolynomialOptions, Random, Rational,
    walk,
};
use rustc_hash::FxHashMap;

use super::SHORTER;
use crate::error::Error;
use crate::forms::{with_values, without_functions};

/// The limits of expansions: beyond them, nobody could read the formulas.
const LIMITS: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 20_000, max_products: 1_000_000 };

/// The length of a coefficient, in operations and operands as printed, above which its long constants are printed as
/// numbers.
const LONG: u64 = 200;
/// The length above which a coefficient is refused.
const TOO_LONG: u64 = 100_000;
/// The largest denominator of a number that is printed as a fraction, and its largest relative distance from the
/// computed value. A number that is not such a fraction comes this close to one with a probability of about 10⁻⁸.
const DENOMINATOR: f64 = 1000.0;
const DISTANCE: f64 = 1e-14;

/// The size, as a fraction of the largest coefficient, below which a rounded one is the rest of terms that cancel.
const RESIDUE: f64 = 1e-14;

/// The seeds of the values at which expressions are compared.
const PLACES: [u64; 4] = [1990, 1991, 1992, 1993];
/// The largest relative difference of values of a constant.
const CONSTANT: f64 = 1e-11;
/// The largest relative difference between a value and its expanded form.
const KEPT: f64 = 1e-7;

/// Finds the base parameters, with coefficients that can be printed, or returns the reason why this is impossible.
pub(crate) fn found<'g>(derivation: &Derivation<'_, 'g>) -> Result<BaseParameters<'g>, Error> {
    let mut found = base_parameters(derivation).ok_or_else(|| Error::NoBase {
        reason: out_of_reach(derivation.robot).unwrap_or_default(),
    })?;
    for (_, coefficient) in found.base.iter_mut().flat_map(|parameter| &mut parameter.terms) {
        if length(*coefficient) <= LONG {
            continue;
        }
        *coefficient = constant(*coefficient).unwrap_or_else(|| with_numbers(*coefficient));
        found.rounded = true;
        if length(*coefficient) > TOO_LONG {
            let reason = format!(
                "a coefficient is longer than {TOO_LONG} operations and operands; {SHORTER}"
            );
            return Err(Error::Base { reason });
        }
    }
    for parameter in &found.base {
        let expanded = coefficients(parameter, derivation.robot)?;
        found.rounded |= expanded.iter().any(|coefficient| !coefficient.is_exact());
    }
    Ok(found)
}

/// The number of operations and operands of an expression as it is printed, with common parts counted each time.
fn length(root: Expr<'_>) -> u64 {
    let mut known: FxHashMap<Id, u64> = FxHashMap::default();
    for expr in walk::reachable(&[root]) {
        let operands = expr.operands().into_iter();
        let of_operands = operands.map(|operand| known.get(&operand.id()).copied().unwrap_or(0));
        known.insert(expr.id(), of_operands.fold(1, u64::saturating_add));
    }
    known.get(&root.id()).copied().unwrap_or(0)
}

/// The value of an expression that is the same for all values of its symbols, rounded; `None` of another one. Long
/// quotients of polynomials are not reduced, so such an expression can contain symbols.
fn constant(expr: Expr<'_>) -> Option<Expr<'_>> {
    let graph = expr.graph();
    let [value, ref others @ ..] = PLACES.map(|place| at(expr, place));
    let is_same = |other: &f64| (other - value).abs() <= CONSTANT * value.abs();
    if !value.is_finite() || !others.iter().all(is_same) {
        return None;
    }
    Some(graph.number(fraction(value).map_or(Number::real(value), Number::Rational)))
}

/// The value of an expression at seeded values of its symbols.
fn at(expr: Expr<'_>, place: u64) -> f64 {
    expr.evaluate(|symbol| seeded(&expr.graph().symbol_name(symbol), place))
}

fn seeded(symbol: &str, place: u64) -> f64 {
    Random::of_name(symbol, place).uniform(0.4, 1.6)
}

/// Replaces long constants with decimals, or the whole coefficient with a fraction if it is near a simple one.
fn with_numbers(coefficient: Expr<'_>) -> Expr<'_> {
    let graph = coefficient.graph();
    // Expansions of expressions as long as these take minutes.
    let short = with_values(&[coefficient], graph, |_, value| Some(Number::real(value)));
    let short = short.first().copied().unwrap_or(coefficient);
    let fraction = short.as_number().and_then(|number| fraction(number.to_f64()));
    fraction.map_or(short, |fraction| graph.number(Number::Rational(fraction)))
}

/// The fraction with a denominator of at most [`DENOMINATOR`] that equals a value up to rounding errors, by continued
/// fractions.
fn fraction(value: f64) -> Option<Rational> {
    let (mut rest, mut before, mut denominator) = (value.abs(), 0.0, 1.0);
    while denominator <= DENOMINATOR {
        let numerator = (value * denominator).round();
        if (numerator / denominator - value).abs() <= DISTANCE * value.abs() {
            let reciprocal = Rational::from_f64(denominator)?.recip()?;
            return Some(&Rational::from_f64(numerator)? * &reciprocal);
        }
        rest = (rest - rest.floor()).recip();
        (before, denominator) = (denominator, rest.floor() * denominator + before);
    }
    None
}

/// Expands coefficients or values of a robot. If one contains a rounded number, the root of a long number or a sum of
/// functions of numbers, its other constants are rounded, too. Those that lose their digits are refused: at seeded
/// values of the symbols, as long terms that cancel do, or at the nominal ones, where a divisor may be nearly 0.
pub(crate) fn polynomials<'g>(
    values: &[Expr<'g>],
    robot: &Robot,
) -> Result<Vec<Polynomial<'g>>, Error> {
    let expanded = Polynomial::of_all(values, &LIMITS).map_err(too_long)?;
    let is_kept = |one: &Polynomial<'g>| one.is_exact() && without_functions(one).is_none();
    let rounded = |one: Polynomial<'g>| if is_kept(&one) { one } else { one.in_decimals(RESIDUE) };
    let expanded: Vec<_> = expanded.into_iter().map(rounded).collect();
    for place in PLACES {
        check_digits(values.iter().zip(&expanded), &|symbol| seeded(symbol, place))?;
    }
    // Exact sums without divisors can be 0 at the nominal values, as a length plus its opposite is.
    let pairs = values.iter().zip(&expanded);
    let checked = pairs.filter(|(_, one)| !one.is_exact() || has_divisor(one));
    check_digits(checked, &|symbol| {
        let value = robot.nominal_value(symbol);
        if value.is_nan() { seeded(symbol, PLACES[0]) } else { value }
    })?;
    Ok(expanded)
}

/// Whether a term of a polynomial is divided by something else than a number.
fn has_divisor(one: &Polynomial<'_>) -> bool {
    one.terms().any(|(monomial, _)| monomial.factors().iter().any(|factor| factor.exponent() < 0))
}

/// Expands the values of the base parameters. Those that are only the rounding errors of their terms are 0.
pub(crate) fn expanded_values<'g>(
    found: &BaseParameters<'g>,
    robot: &Robot,
) -> Result<Vec<Polynomial<'g>>, Error> {
    let mut values = found.nominal();
    for (value, parameter) in values.iter_mut().zip(&found.base) {
        if is_rounded(*value) && is_residue(parameter, found) {
            *value = value.graph().zero();
        }
    }
    polynomials(&values, robot)
}

/// Whether an expression contains rounded numbers.
fn is_rounded(expr: Expr<'_>) -> bool {
    let is_rounded = |number: Number| number.as_rational().is_none();
    walk::reachable(&[expr]).into_iter().any(|part| part.as_number().is_some_and(is_rounded))
}

/// Whether the terms of a base parameter cancel each other up to rounding errors, at all seeded values.
fn is_residue(parameter: &BaseParameter<'_>, found: &BaseParameters<'_>) -> bool {
    PLACES.into_iter().all(|place| {
        let terms = parameter.terms.iter().filter_map(|(standard, coefficient)| {
            Some(at(*coefficient, place) * at(found.standard.get(*standard)?.1, place))
        });
        let (sum, size) =
            terms.fold((0.0_f64, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
        sum.abs() <= RESIDUE * size
    })
}

/// Returns an error if an expanded value differs from the value at these values of symbols: long terms can cancel.
fn check_digits<'e, 'g: 'e>(
    mut pairs: impl Iterator<Item = (&'e Expr<'g>, &'e Polynomial<'g>)>,
    of_symbol: &dyn Fn(&str) -> f64,
) -> Result<(), Error> {
    let is_kept = |(value, expanded): (&Expr<'_>, &Polynomial<'_>)| {
        let name = |symbol| value.graph().symbol_name(symbol);
        let found = expanded.evaluate(|symbol| of_symbol(&name(symbol)));
        let expected = value.evaluate(|symbol| of_symbol(&name(symbol)));
        let size = found.abs().max(expected.abs());
        expanded.is_zero() || !size.is_finite() || (found - expected).abs() <= KEPT * size
    };
    if pairs.all(is_kept) {
        return Ok(());
    }
    let reason = "if the formulas are multiplied out, terms cancel and digits are lost; the function \
                  `base_parameters` computes their values";
    Err(Error::Base { reason: reason.to_owned() })
}

/// Expands the coefficients of a base parameter.
pub(super) fn coefficients<'g>(
    parameter: &BaseParameter<'g>,
    robot: &Robot,
) -> Result<Vec<Polynomial<'g>>, Error> {
    let coefficients: Vec<Expr<'g>> =
        parameter.terms.iter().map(|(_, coefficient)| *coefficient).collect();
    polynomials(&coefficients, robot)
}

/// The error for formulas that exceed a limit of expansions.
pub(super) fn too_long(error: PolynomialError) -> Error {
    Error::Base { reason: format!("{error}; {SHORTER}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_have_small_denominators() {
        let found = |value: f64| fraction(value).map(|fraction| fraction.to_string());
        for (value, text) in [
            (-1.0 / 3.0, Some("-1/3")),
            (1.0 - 2.0 / 3.0, Some("1/3")),
            (0.0, Some("0")),
            (355.0 / 113.0, Some("355/113")),
            (2.0_f64.sqrt(), None),
            (1.0 / 3.0 + 1e-12, None),
            (f64::NAN, None),
            (f64::INFINITY, None),
        ] {
            assert_eq!(found(value).as_deref(), text, "{value}");
        }
    }

    /// An expansion that has lost its digits is refused.
    #[test]
    fn digits_are_kept_or_refused() {
        let graph = robot_symbolic::Graph::new();
        let root = graph.parse("sqrt(2)*a").unwrap();
        let kept = |text: &str| {
            let expanded = Polynomial::of(graph.parse(text).unwrap(), &LIMITS).unwrap();
            check_digits([(&root, &expanded)].into_iter(), &|symbol| seeded(symbol, 1)).is_ok()
        };
        assert!(kept("sqrt(2)*a") && !kept("sqrt(2)*a + 0.000001*b"));
        let same = graph.parse("(a^2 + a*b)/(2*a)/(a + b)").unwrap();
        assert_eq!(constant(same).unwrap().as_number().unwrap().to_f64(), 0.5);
        assert!(constant(root).is_none());
    }
}
