//! Signs of products with a sum in parentheses.

use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};

use super::arranged::{negated, positive_first};

/// Writes subtracted products with the opposite of their first sum for which that needs fewer minus signs: `c*(b - a)`
/// and not `-c*(a - b)`.
pub(super) fn fewer<'h>(terms: &[ArrangedTerm<'h>]) -> Vec<ArrangedTerm<'h>> {
    terms.iter().map(term).collect()
}

fn term<'h>(term: &ArrangedTerm<'h>) -> ArrangedTerm<'h> {
    let mut term = term.clone();
    let opposite =
        term.factors.iter_mut().filter(|_| term.negative).find_map(|power| match power {
            (ArrangedFactor::Sum(terms), 1) if saves_a_sign(terms) => Some(terms),
            _ => None,
        });
    if let Some(terms) = opposite {
        *terms = positive_first(negated(std::mem::take(terms)));
        term.negative = false;
    }
    for (factor, _) in &mut term.factors {
        if let ArrangedFactor::Sum(terms) = factor {
            *terms = fewer(terms);
        }
    }
    term
}

/// Whether the opposite of a subtracted sum has fewer minus signs than the sum with the one before it.
fn saves_a_sign(terms: &[ArrangedTerm<'_>]) -> bool {
    let negative = terms.iter().filter(|term| term.negative).count();
    terms.len() - negative < negative + 1
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Graph;
    use robot_symbolic::print::{arranged_text, arranged_value};

    use super::super::arranged::terms;
    use super::*;
    use crate::layout::Order;

    #[test]
    fn subtracted_sums_are_turned_if_that_saves_a_sign() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r.toml");
        let text = std::fs::read_to_string(path).unwrap();
        let robot = robot_model::description::read_toml(path, &text).unwrap().robot;
        let order = Order::new(&robot);
        for (given, expected) in [
            ("-l1*(qd1 - qd2)", "l1*(qd2 - qd1)"),
            ("-l1*(qd1 + qd2)", "-l1*(qd1 + qd2)"),
            ("-l1*(qd1 + qd2 - qdd1)", "-l1*(qd1 + qd2 - qdd1)"),
            ("m1 - l1*(qd1 - qd2 - qdd1)", "m1 + l1*(qd2 - qd1 + qdd1)"),
            ("-(m1 - m2)*(qd1 - qd2)", "(m2 - m1)*(qd1 - qd2)"),
            ("-l1*(qd1 - qd2)^2", "-l1*(qd1 - qd2)^2"),
            ("-l1*(qd1 - qd2)^3", "-l1*(qd1 - qd2)^3"),
            ("m1*(l1 - m2*(qd1 - qd2))", "m1*(l1 + m2*(qd2 - qd1))"),
        ] {
            let graph = Graph::new();
            let expr = graph.parse(given).unwrap();
            let found = fewer(&terms(expr, &order));
            assert_eq!(arranged_text(&found).unwrap(), expected, "{given}");
            let options = robot_symbolic::PolynomialOptions::default();
            let zero =
                robot_symbolic::Polynomial::of(arranged_value(&found, &graph) - expr, &options);
            assert!(zero.unwrap().is_zero(), "{given}");
        }
    }
}
