//! Rounding errors that are left where decimals cancel each other.

use robot_symbolic::{Expr, Number, Polynomial, PolynomialError, PolynomialOptions, View, walk};

use super::numbers::digits;

/// The coefficient, relative to the largest number, below which a term may be a rounding error.
const SMALL: f64 = 1e-12;
/// The least number of significant digits of a decimal that stands for a root or a sine.
const ROUNDED_DIGITS: usize = 15;

/// The polynomial of an expression, without the terms that are only rounding errors: those that are 0 if the long
/// decimals are floating-point numbers.
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
    if !exact.terms().any(|(_, number)| is_small(number)) {
        return Ok(exact);
    }
    let graph = exact.graph();
    let rounded = walk::rebuild_above(&[expr], graph, |part| match part.view() {
        View::Number(number) if digits(&number) >= ROUNDED_DIGITS => {
            Some(graph.number(Number::real(number.to_f64())))
        }
        _ => None,
    });
    let Some(rounded) = rounded.first() else { return Ok(exact) };
    let rounded = Polynomial::of(*rounded, limits)?;
    let mut kept = exact.split_by(|monomial| rounded.terms().any(|(other, _)| other == monomial));
    Ok(kept.remove(&true).unwrap_or_else(|| Polynomial::zero(graph, limits)))
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

    #[test]
    fn small_numbers_and_their_products_stay() {
        for sum in ["1/100000000000000000*a + b", "a*b/1000000000 + 1/10000000000000*a"] {
            assert_ne!(text(sum), text("b"), "{sum}");
            assert!(text(sum).contains('a'), "{sum}");
        }
        assert_eq!(text("(1/10000000*a + b)*(1/100000000*a + b) - b*b").matches('a').count(), 2);
    }
}
