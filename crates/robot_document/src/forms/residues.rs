//! Rounding errors that are left where decimals cancel each other.

use robot_symbolic::{
    Expr, Monomial, Number, Polynomial, PolynomialError, PolynomialOptions, walk,
};
use rustc_hash::FxHashSet;

use super::numbers::digits;

/// The coefficient, relative to the largest number, below which a term may be a rounding error.
const SMALL: f64 = 1e-12;
/// The least number of significant digits of a decimal that stands for a root or a sine.
const ROUNDED_DIGITS: usize = 15;

/// The polynomial of an expression, without the terms that are only rounding errors: small ones that are 0 if the long
/// decimals are floating-point numbers. Terms with a long decimal in a function or a divisor are kept.
///
/// # Errors
///
/// If the polynomial exceeds a limit.
pub(super) fn polynomial<'g>(
    expr: Expr<'g>,
    limits: &PolynomialOptions,
) -> Result<Polynomial<'g>, PolynomialError> {
    let exact = Polynomial::of(expr, limits)?;
    let numbers = walk::reachable(&[expr]).into_iter().filter_map(Expr::as_number);
    let largest = numbers.map(|number| number.to_f64().abs()).fold(1.0, f64::max);
    let is_small = |number: &Number| number.to_f64().abs() < SMALL * largest;
    let small = exact.terms().filter(|(_, number)| is_small(number)).map(|(monomial, _)| monomial);
    let mut errors: FxHashSet<Monomial> = small.cloned().collect();
    if errors.is_empty() {
        return Ok(exact);
    }
    let graph = exact.graph();
    let rounded = walk::rebuild_above(&[expr], graph, |part| {
        rounded(part).map(|number| graph.number(Number::real(number)))
    });
    let rounded = rounded.first().and_then(|rounded| Polynomial::of(*rounded, limits).ok());
    let Some(rounded) = rounded else { return Ok(exact) };
    for (monomial, _) in rounded.terms() {
        errors.remove(monomial);
    }
    errors.retain(|monomial| {
        let atoms: Vec<Expr<'_>> =
            monomial.factors().iter().map(|factor| graph.expr(factor.atom())).collect();
        walk::reachable(&atoms).into_iter().all(|part| self::rounded(part).is_none())
    });
    let mut kept = exact.split_by(|monomial| !errors.contains(monomial));
    Ok(kept.remove(&true).unwrap_or_else(|| Polynomial::zero(graph, limits)))
}

/// The largest number of expressions in one that is multiplied out, for each term that it may have. Longer ones have more
/// terms, and finding this out would take a walk through all of each.
const PARTS_OF_TERM: usize = 20;

/// The polynomial of an expression, with sums of angles as they are; `None` if it has more than `most` terms or the
/// expression has too many parts for so few.
pub(super) fn short_polynomial(expr: Expr<'_>, most: usize) -> Option<Polynomial<'_>> {
    if walk::is_longer_than(expr, PARTS_OF_TERM * most) {
        return None;
    }
    let limits = PolynomialOptions { max_terms: most, ..PolynomialOptions::keeping_angle_sums() };
    polynomial(expr, &limits).ok()
}

/// The value of a number with as many digits as a rounded root or sine.
fn rounded(part: Expr<'_>) -> Option<f64> {
    part.as_number().filter(|number| digits(number) >= ROUNDED_DIGITS).map(|number| number.to_f64())
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Graph;

    use super::*;

    fn text(text: &str) -> String {
        let graph = Graph::new();
        let limits = PolynomialOptions::default();
        polynomial(graph.parse(text).unwrap(), &limits).unwrap().to_text().unwrap()
    }

    #[test]
    fn what_is_left_of_long_decimals_is_0() {
        // 0.6 cos 0.3 and its parts.
        let sum = "(0.57320189347536359*a + b)*c - 0.57320189347536362*a*c";
        assert_eq!(text(sum), "b*c");
        let products = "(0.57320189347536359*a + b)*c - (0.57320189347536362*a + b)*c";
        assert_eq!(text(products), "0");
    }

    /// In a function or a divisor, a number that is rounded otherwise would make another term.
    #[test]
    fn terms_with_long_decimals_in_functions_and_divisors_stay() {
        let graph = Graph::new();
        let limits = PolynomialOptions::default();
        for sum in [
            "1.5*cos(0.3333333333333333*q) + 1/100000000000000000*cos(q)",
            "1.5*cos(q) + 1/100000000000000000*cos(0.3333333333333333*q)",
            "1/(0.5732018934753635*a + b) + 1/100000000000000000*a",
            "1/10000000000000000*a/(0.5732018934753635*a + b) + a",
        ] {
            let expr = graph.parse(sum).unwrap();
            let exact = Polynomial::of(expr, &limits).unwrap();
            assert_eq!(exact.len(), 2);
            assert!(polynomial(expr, &limits).unwrap() == exact, "{sum}");
        }
    }

    #[test]
    fn small_numbers_and_their_products_stay() {
        for sum in ["1/100000000000000000*a + b", "a*b/1000000000 + 1/10000000000000*a"] {
            assert_ne!(text(sum), text("b"), "{sum}");
            assert!(text(sum).contains('a'), "{sum}");
        }
        assert_eq!(text("(1/10000000*a + b)*(1/100000000*a + b) - b*b").matches('a').count(), 2);
    }
}
