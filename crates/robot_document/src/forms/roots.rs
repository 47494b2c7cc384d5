//! Roots of whole numbers in denominators.

use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Expr, Function, Number, View};

/// Writes terms with a root below a multiple of its number without a denominator: √2 a and not 2 a/√2.
pub(super) fn reduced<'h>(terms: &[ArrangedTerm<'h>]) -> Vec<ArrangedTerm<'h>> {
    terms.iter().map(term).collect()
}

fn term<'h>(term: &ArrangedTerm<'h>) -> ArrangedTerm<'h> {
    let mut coefficient = term.coefficient.clone();
    let mut change = |(factor, exponent): &(ArrangedFactor<'h>, i32)| match factor {
        ArrangedFactor::Sum(terms) => (ArrangedFactor::Sum(reduced(terms)), *exponent),
        ArrangedFactor::Atom(atom) => {
            let quotient = if *exponent == -1 { quotient(&coefficient, *atom) } else { None };
            let exponent = if quotient.is_some() { 1 } else { *exponent };
            coefficient = quotient.unwrap_or_else(|| coefficient.clone());
            (ArrangedFactor::Atom(*atom), exponent)
        }
    };
    let factors = term.factors.iter().map(&mut change).collect();
    ArrangedTerm { negative: term.negative, coefficient, factors }
}

/// A whole number divided by the argument of a square root, if the quotient is whole.
fn quotient(number: &Number, root: Expr<'_>) -> Option<Number> {
    let View::Call(Function::Sqrt, argument) = root.view() else { return None };
    let whole = |number: &Number| number.as_rational()?.to_integer();
    let (number, argument) = (whole(number)?, whole(&argument.as_number()?)?);
    (argument > 0 && number % argument == 0).then(|| Number::integer(number / argument))
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Graph;
    use robot_symbolic::print::arranged_text;

    use super::*;

    #[test]
    fn roots_are_not_below_multiples_of_their_numbers() {
        let graph = Graph::new();
        let symbol = |name: &str| ArrangedFactor::Atom(graph.symbol(name));
        let root = |number: i64| ArrangedFactor::Atom(graph.integer(number).sqrt());
        for (coefficient, number, text) in
            [(2, 2, "a*sqrt(2)"), (6, 3, "2*a*sqrt(3)"), (3, 2, "3*a/sqrt(2)"), (1, 2, "a/sqrt(2)")]
        {
            let factors = vec![(symbol("a"), 1), (root(number), -1)];
            let coefficient = Number::integer(coefficient);
            let term = ArrangedTerm { negative: false, coefficient, factors };
            assert_eq!(arranged_text(&reduced(&[term])).unwrap(), text);
        }
    }
}
