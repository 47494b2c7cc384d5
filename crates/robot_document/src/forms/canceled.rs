//! Sums in which terms cancel, also in their shared parts.

use robot_symbolic::{Expr, Graph, Id, Number, View, walk};
use rustc_hash::FxHashMap;

use super::residues;

/// The terms of a sum, each with its coefficient.
type Terms<'g> = Vec<(Expr<'g>, Number)>;

/// The largest number of expressions that are visited in a sum, and of terms of a polynomial.
const MAX_TERMS: usize = 40;

/// Writes sums that are numbers, such as that of the squares of a sine and a cosine, as these numbers, and a value of which
/// one term is left if it is multiplied out as this term.
pub(super) fn with_single_terms<'g>(values: &[Expr<'g>], graph: &'g Graph) -> Vec<Expr<'g>> {
    let left = |sum: Expr<'g>, most: usize| {
        let left = residues::short_polynomial(sum, MAX_TERMS);
        left.filter(|left| left.len() <= most || left.as_number().is_some())
            .map_or(sum, |left| left.to_expr())
    };
    let values = walk::rebuild_upward(values, graph, |part| match part.view() {
        View::Add(..) | View::Sub(..) => left(part, 0),
        _ => part,
    });
    values.into_iter().map(|value| left(value, 1)).collect()
}

/// Writes sums without the shared parts whose terms cancel, unless this takes more terms. A reader of x₁ − x₂ with
/// x₁ = a + c and x₂ = b + c would believe that c has an effect; the sum becomes a − b.
pub(super) fn without_canceled_terms<'g>(values: &[Expr<'g>], graph: &'g Graph) -> Vec<Expr<'g>> {
    let mut uses: FxHashMap<Id, usize> = FxHashMap::default();
    for operand in walk::reachable(values).iter().flat_map(|node| node.operands()) {
        *uses.entry(operand.id()).or_default() += 1;
    }
    walk::rebuild_upward(values, graph, |part| match part.view() {
        View::Add(..) | View::Sub(..) => shortened(part, &uses, graph).unwrap_or(part),
        _ => part,
    })
}

/// The sum without the parts whose terms cancel; `None` if none cancel or if it would have more terms.
fn shortened<'g>(sum: Expr<'g>, uses: &FxHashMap<Id, usize>, graph: &'g Graph) -> Option<Expr<'g>> {
    let is_shared = |part: Expr<'g>| uses.get(&part.id()).is_some_and(|count| *count > 1);
    let now = terms(sum, &|part| part == sum || !is_shared(part))?;
    let all = terms(sum, &|_| true)?;
    let canceled: Vec<Expr<'g>> =
        all.iter().filter(|(_, count)| count.is_zero()).map(|(term, _)| *term).collect();
    if canceled.is_empty() {
        return None;
    }
    let cancels = |part: Expr<'g>| {
        terms(part, &|_| true)
            .is_some_and(|within| within.iter().any(|(term, _)| canceled.contains(term)))
    };
    let rest = terms(sum, &cancels)?;
    let rest: Terms<'g> = rest.into_iter().filter(|(_, count)| !count.is_zero()).collect();
    if rest.len() > now.len() {
        return None;
    }
    let short = rest.iter().fold(graph.zero(), |sum, (term, count)| match count.is_negative() {
        true => sum - *term * graph.number(-count),
        false => sum + *term * graph.number(count.clone()),
    });
    // What is left can be a square of a sine and one of a cosine.
    match residues::short_polynomial(short, MAX_TERMS) {
        Some(polynomial) if polynomial.len() < rest.len() => Some(polynomial.to_expr()),
        _ => Some(short),
    }
}

/// The terms of a sum in which the parts that `opens` accepts are replaced by their terms; like terms are merged, and
/// those that cancel have the coefficient 0. `None` if there are too many.
fn terms<'g>(sum: Expr<'g>, opens: &dyn Fn(Expr<'g>) -> bool) -> Option<Terms<'g>> {
    let mut found: Terms<'g> = vec![];
    let mut pending = vec![(sum, Number::integer(1))];
    let mut count = 0;
    while let Some((part, coefficient)) = pending.pop() {
        count += 1;
        if count > MAX_TERMS {
            return None;
        }
        match part.view() {
            View::Neg(a) => pending.push((a, -&coefficient)),
            View::Add(a, b) if opens(part) => {
                pending.push((b, coefficient.clone()));
                pending.push((a, coefficient));
            }
            View::Sub(a, b) if opens(part) => {
                pending.push((b, -&coefficient));
                pending.push((a, coefficient));
            }
            View::Mul(a, b) if a.as_number().is_some() || b.as_number().is_some() => {
                let (number, other) = match a.as_number() {
                    Some(number) => (number, b),
                    None => (b.as_number()?, a),
                };
                pending.push((other, &coefficient * &number));
            }
            _ => match found.iter_mut().find(|(known, _)| *known == part) {
                Some((_, known)) => *known = &*known + &coefficient,
                None => found.push((part, coefficient)),
            },
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use robot_symbolic::print::to_text;

    use super::*;

    /// The texts of the sums, of which the first ones make their parts shared.
    fn texts(sources: &[&str]) -> Vec<String> {
        let graph = Graph::new();
        let values: Vec<Expr<'_>> =
            sources.iter().map(|source| graph.parse(source).unwrap()).collect();
        let found = without_canceled_terms(&values, &graph);
        found.iter().map(|value| to_text(*value).unwrap()).collect()
    }

    #[test]
    fn parts_whose_terms_cancel_are_opened() {
        let two = ["sin(a + c)", "sin(b + c)", "cos(a + c)", "cos(b + c)"];
        assert_eq!(texts(&[two.as_slice(), &["x*((a + c) - (b + c))"]].concat())[4], "x*(a - b)");
        // A square of a sine and one of a cosine are left.
        let squares = ["tanh(b + (y*sin(x))^2)", "tanh((y*cos(x))^2 - b)"];
        let sum = "b + (y*sin(x))^2 + ((y*cos(x))^2 - b)";
        assert_eq!(texts(&[squares.as_slice(), &[sum]].concat())[2], "y^2");
        // Within sums that are parts themselves.
        let deep = ["sin(z - (a - b))", "cos(z - (a - b))", "sin(a + b)", "cos(a + b)"];
        let found = texts(&[deep.as_slice(), &["(z - (a - b)) - (a + b)"]].concat());
        assert_eq!(found[4], "z - 2*a");
    }

    #[test]
    fn a_single_term_that_is_left_is_written() {
        let graph = Graph::new();
        for (sum, left) in [
            ("a*(cos(q)*cos(q) + sin(q)*sin(q)) + b*(sin(q) + cos(q))", "a + b*(cos(q) + sin(q))"),
            ("3*(w*w) + z - 1.5*((2*w)*w)", "z"),
            ("(3*(w*w) + z - 1.5*((2*w)*w))*y", "z*y"),
            ("x*(a + b) + y*(a - b)", "x*(a + b) + y*(a - b)"),
        ] {
            let found = with_single_terms(&[graph.parse(sum).unwrap()], &graph);
            assert_eq!(to_text(found[0]).unwrap(), left);
        }
    }

    #[test]
    fn other_sums_stay() {
        // Nothing cancels, though the terms b are alike.
        let found = texts(&["sin(a + b)", "cos(a + b)", "(a + b) + b"]);
        assert_eq!(found[2], "a + b + b");
        // The long part would need more terms without its name.
        let long = "(a + d + b + c)";
        let sources =
            [&format!("sin{long}"), &format!("cos{long}"), &format!("x*({long} - (d + e))")];
        assert_eq!(texts(&sources.map(String::as_str))[2], "x*(a + d + b + c - (d + e))");
    }
}
