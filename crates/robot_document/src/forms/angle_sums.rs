//! Sines and cosines of sums of angles, which the recursion expands by the addition theorems.

use robot_symbolic::Function::{Cos, Sin};
use robot_symbolic::{Expr, Function, Graph, Id, View, walk};
use rustc_hash::FxHashMap;

/// The sine or the cosine of an angle.
type Circular<'g> = (Function, Expr<'g>);

/// Replaces sin a cos b + cos a sin b by sin(a + b), and cos a cos b − sin a sin b and its negative by cos(a + b) and its
/// negative.
pub(super) fn joined<'g>(values: &[Expr<'g>], graph: &'g Graph) -> Vec<Expr<'g>> {
    let mut known: FxHashMap<Id, Circular<'g>> = FxHashMap::default();
    let mut sums: FxHashMap<Id, Expr<'g>> = FxHashMap::default();
    // Operands come before results, so sums of several angles are found from their parts.
    for expr in walk::reachable(values) {
        if let View::Call(function @ (Sin | Cos), angle) = expr.view() {
            known.insert(expr.id(), (function, angle));
        } else if let Some((function, angle)) = of_sum(expr, &known) {
            known.insert(expr.id(), (function, angle));
            sums.insert(expr.id(), angle.apply(function));
        } else if let View::Sub(first, second) = expr.view()
            && let Some((function, angle)) = of_terms(second, first, Cos, &known)
        {
            sums.insert(expr.id(), -angle.apply(function));
        }
    }
    walk::rebuild_above(values, graph, |part| sums.get(&part.id()).copied())
}

fn of_sum<'g>(expr: Expr<'g>, known: &FxHashMap<Id, Circular<'g>>) -> Option<Circular<'g>> {
    match expr.view() {
        View::Add(first, second) => of_terms(first, second, Sin, known),
        View::Sub(first, second) => of_terms(first, second, Cos, known),
        _ => None,
    }
}

/// The sum of angles whose sine is the sum of two products, or whose cosine is their difference.
fn of_terms<'g>(
    first: Expr<'g>,
    second: Expr<'g>,
    function: Function,
    known: &FxHashMap<Id, Circular<'g>>,
) -> Option<Circular<'g>> {
    let factors = |product: Expr<'g>| match product.view() {
        View::Mul(a, b) => Some([*known.get(&a.id())?, *known.get(&b.id())?]),
        _ => None,
    };
    let ([a, b], [c, d]) = (factors(first)?, factors(second)?);
    let (one, other) = match (function, a.0, b.0, c.0, d.0) {
        (Sin, Sin, Cos, Sin, Cos) => ((a, b), (d, c)),
        (Sin, Sin, Cos, Cos, Sin) => ((a, b), (c, d)),
        (Sin, Cos, Sin, Sin, Cos) => ((b, a), (d, c)),
        (Sin, Cos, Sin, Cos, Sin) => ((b, a), (c, d)),
        (Cos, Cos, Cos, Sin, Sin) if a.1 == c.1 => ((a, b), (c, d)),
        (Cos, Cos, Cos, Sin, Sin) => ((a, b), (d, c)),
        _ => return None,
    };
    // The terms must be sin a · cos b and cos a · sin b.
    let ((x, y), (u, v)) = ((one.0.1, one.1.1), (other.0.1, other.1.1));
    (x == u && y == v).then(|| (function, x + y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_symbolic::print::to_text;

    fn joined_text(source: &str) -> String {
        let graph = Graph::new();
        let value = graph.parse(source).unwrap();
        to_text(joined(&[value], &graph)[0]).unwrap()
    }

    #[test]
    fn addition_theorems_are_read_backwards() {
        for (source, expected) in [
            ("m*(sin(a)*cos(b) + cos(a)*sin(b))", "m*sin(a + b)"),
            ("m*(cos(b)*sin(a) + sin(b)*cos(a))", "m*sin(b + a)"),
            ("cos(a)*cos(b) - sin(a)*sin(b)", "cos(a + b)"),
            ("cos(a)*cos(b) - sin(b)*sin(a)", "cos(a + b)"),
            ("m*(sin(a)*sin(b) - cos(a)*cos(b))", "-m*cos(a + b)"),
        ] {
            assert_eq!(joined_text(source), expected, "{source}");
        }
        let three =
            "(sin(a)*cos(b) + cos(a)*sin(b))*cos(c) + (cos(a)*cos(b) - sin(a)*sin(b))*sin(c)";
        assert_eq!(joined_text(three), "sin(a + b + c)");
    }

    #[test]
    fn other_sums_stay() {
        for source in [
            "sin(a)*cos(b) - cos(a)*sin(b)",
            "sin(a)*cos(b) + cos(a)*sin(c)",
            "cos(a)*cos(b) + sin(a)*sin(b)",
            "cos(a)*cos(b) - sin(a)*sin(c)",
            "sin(a)*sin(b) + cos(a)*cos(b)",
        ] {
            assert_eq!(joined_text(source), source);
        }
    }
}
