//! Expressions as sums of products in the order of the robot's symbols, in the structure in which they were built:
//! nothing is multiplied out.
//!
//! Powers are collected, factors are sorted, like terms are merged, and sums within sums are flattened. No step
//! increases the number of operations.

use std::cmp::Reverse;

use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Expr, Function, Graph, Number, View, walk};
use rustc_hash::FxHashMap;

use crate::layout::{BRACKETS, Order, Rank};

type Terms<'h> = Vec<ArrangedTerm<'h>>;
type Power<'h> = (ArrangedFactor<'h>, i32);

/// The terms of an expression, in order.
pub(super) fn terms<'h>(expr: Expr<'h>, order: &Order<'_>) -> Terms<'h> {
    let mut known: FxHashMap<robot_symbolic::Id, Terms<'h>> = FxHashMap::default();
    // Operands come before results, so no recursion is needed.
    for part in walk::reachable(&[expr]) {
        let of = |operand: Expr<'h>| known.get(&operand.id()).cloned().unwrap_or_default();
        let terms = match part.view() {
            View::Number(number) => constant(&number),
            View::Add(a, b) => merged(of(a), of(b)),
            View::Sub(a, b) => merged(of(a), negated(of(b))),
            View::Neg(a) => negated(of(a)),
            View::Mul(a, b) => vec![times(of(a), of(b), 1, order)],
            View::Div(a, b) => vec![times(of(a), of(b), -1, order)],
            View::Symbol(_) | View::Pi | View::Call(..) => {
                vec![of_factors(vec![(ArrangedFactor::Atom(part), 1)])]
            }
        };
        known.insert(
            part.id(),
            terms.into_iter().filter(|term| !term.coefficient.is_zero()).collect(),
        );
    }
    sorted(known.remove(&expr.id()).unwrap_or_default(), order)
}

/// Sorts the terms of a sum by their factors, with numbers last.
fn sorted<'h>(mut terms: Terms<'h>, order: &Order<'_>) -> Terms<'h> {
    terms.sort_by_cached_key(|term| {
        let factor = |(factor, exponent): &Power<'h>| (place(factor, order), Reverse(*exponent));
        (term.factors.is_empty(), term.factors.iter().map(factor).collect::<Vec<_>>())
    });
    terms
}

/// Moves the first positive term to the beginning, where it needs no sign.
pub(super) fn positive_first(mut terms: Terms<'_>) -> Terms<'_> {
    if let Some(place) = terms.iter().position(|term| !term.negative) {
        terms[..=place].rotate_right(1);
    }
    terms
}

fn sort_factors(factors: &mut [Power<'_>], order: &Order<'_>) {
    factors.sort_by_cached_key(|(factor, _)| place(factor, order));
}

/// The place of a factor in a product: its rank, then the symbols of its angle, with sines before cosines, as in sums
/// that are collected.
fn place(factor: &ArrangedFactor<'_>, order: &Order<'_>) -> (Rank, Vec<Rank>, bool) {
    let Some(atom) = factor.as_atom() else { return (BRACKETS, vec![], false) };
    let View::Call(function @ (Function::Sin | Function::Cos), angle) = atom.view() else {
        return (order.rank(atom), vec![], false);
    };
    let symbols = walk::symbols(&[angle]).into_iter().map(|symbol| {
        let graph = angle.graph();
        order.rank(graph.symbol(&graph.symbol_name(symbol)))
    });
    let mut symbols: Vec<Rank> = symbols.collect();
    symbols.sort_unstable();
    (order.rank(atom), symbols, function == Function::Cos)
}

/// Counts the operations of a sum of terms, with every factor of a power. Sines and cosines and their angles do not
/// count.
pub(super) fn operations(terms: &[ArrangedTerm<'_>]) -> usize {
    let factor = |(factor, exponent): &Power<'_>| {
        let within = match factor {
            ArrangedFactor::Atom(_) => 0,
            ArrangedFactor::Sum(terms) => operations(terms),
        };
        within + exponent.unsigned_abs() as usize
    };
    let term = |term: &ArrangedTerm<'_>| {
        let number = usize::from(!term.coefficient.is_one() || term.factors.is_empty());
        (number + term.factors.iter().map(factor).sum::<usize>()).saturating_sub(1)
    };
    terms.len().saturating_sub(1) + terms.iter().map(term).sum::<usize>()
}

/// The largest number of terms of a sum in which terms are joined.
const MAX_FACTORED: usize = 200;

/// Joins terms that differ in only one factor: `l_4 x_2 + x_2 q_4` becomes `(l_4 + q_4) x_2`, which has one product
/// less and no additional symbol. Factors that all terms of a sum have in common stand before it.
pub(super) fn factored<'h>(terms: Terms<'h>, order: &Order<'_>) -> Terms<'h> {
    let inside = |term: ArrangedTerm<'h>| {
        let start = ArrangedTerm { factors: vec![], ..term.clone() };
        let mut found = term.factors.into_iter().fold(start, |product, (factor, exponent)| {
            let ArrangedFactor::Sum(terms) = factor else {
                return multiplied(product, of_factors(vec![(factor, exponent)]));
            };
            let terms = factored(terms, order);
            match (exponent, terms.as_slice()) {
                (1, [single]) => multiplied(product, single.clone()),
                _ => {
                    let sum = (ArrangedFactor::Sum(terms), exponent);
                    multiplied(product, of_factors(vec![sum]))
                }
            }
        });
        sort_factors(&mut found.factors, order);
        found
    };
    let terms = joined_terms(terms.into_iter().map(inside).collect(), order);
    match common(&terms) {
        Some(before) => vec![extracted(&terms, before, order)],
        None => terms,
    }
}

/// The product of two terms.
fn multiplied<'h>(one: ArrangedTerm<'h>, other: ArrangedTerm<'h>) -> ArrangedTerm<'h> {
    let mut factors = one.factors;
    for (factor, exponent) in other.factors {
        match factors.iter_mut().find(|(known, _)| *known == factor) {
            Some((_, known)) => *known += exponent,
            None => factors.push((factor, exponent)),
        }
    }
    factors.retain(|(_, exponent)| *exponent != 0);
    let coefficient = &one.coefficient * &other.coefficient;
    ArrangedTerm { negative: one.negative != other.negative, coefficient, factors }
}

/// The factors that all terms have in common, with their coefficient if that is the same too; `None` if the terms have
/// no common factor.
fn common<'h>(terms: &[ArrangedTerm<'h>]) -> Option<ArrangedTerm<'h>> {
    let [first, others @ ..] = terms else { return None };
    let is_common = |power: &&Power<'h>| others.iter().all(|term| term.factors.contains(power));
    let factors: Vec<_> = first.factors.iter().filter(is_common).cloned().collect();
    let is_same = others.iter().all(|term| term.coefficient == first.coefficient);
    let coefficient = if is_same { first.coefficient.clone() } else { Number::integer(1) };
    let is_shorter = !factors.is_empty() && !others.is_empty();
    is_shorter.then_some(ArrangedTerm { negative: false, coefficient, factors })
}

/// The sum of terms as a product of their common factors and the sum of what is left.
fn extracted<'h>(
    terms: &[ArrangedTerm<'h>],
    common: ArrangedTerm<'h>,
    order: &Order<'_>,
) -> ArrangedTerm<'h> {
    let is_same = !common.coefficient.is_one();
    let rest = |term: &ArrangedTerm<'h>| {
        let factors = term.factors.iter().filter(|power| !common.factors.contains(power));
        let coefficient = if is_same { Number::integer(1) } else { term.coefficient.clone() };
        ArrangedTerm { negative: term.negative, coefficient, factors: factors.cloned().collect() }
    };
    let rest = sorted(terms.iter().map(rest).collect(), order);
    let mut product = ArrangedTerm::product(&rest, common.factors);
    product.coefficient = &product.coefficient * &common.coefficient;
    sort_factors(&mut product.factors, order);
    product
}

/// The terms of a sum in which those that differ in only one factor are joined.
fn joined_terms<'h>(mut terms: Terms<'h>, order: &Order<'_>) -> Terms<'h> {
    if terms.len() > MAX_FACTORED {
        return terms;
    }
    while let Some((first, second)) = alike(&terms) {
        let other = terms.remove(second);
        let Some(term) = terms.get_mut(first) else { break };
        *term = joined(term, &other, order);
    }
    sorted(terms, order)
}

/// The indices of the two terms that differ in only one factor and have the most factors in common; `None` if no two
/// terms do.
fn alike(terms: &[ArrangedTerm<'_>]) -> Option<(usize, usize)> {
    let mut best: Option<(usize, usize, usize)> = None;
    for (first, one) in terms.iter().enumerate() {
        for (second, other) in terms.iter().enumerate().skip(first + 1) {
            let count = one.factors.len();
            let common = one.factors.iter().filter(|factor| other.factors.contains(factor)).count();
            let differ_in_one = count == other.factors.len() && common + 1 == count && common > 0;
            if differ_in_one
                && one.coefficient == other.coefficient
                && best.is_none_or(|(most, ..)| common > most)
            {
                best = Some((common, first, second));
            }
        }
    }
    best.map(|(_, first, second)| (first, second))
}

/// Joins two terms that differ in only one factor.
fn joined<'h>(
    one: &ArrangedTerm<'h>,
    other: &ArrangedTerm<'h>,
    order: &Order<'_>,
) -> ArrangedTerm<'h> {
    let own = |term: &ArrangedTerm<'h>, than: &ArrangedTerm<'h>| {
        let rest = term.factors.iter().filter(|factor| !than.factors.contains(factor));
        let terms = rest.flat_map(|(factor, exponent)| match factor {
            ArrangedFactor::Sum(terms) if *exponent == 1 => terms.clone(),
            _ => vec![of_factors(vec![(factor.clone(), *exponent)])],
        });
        let terms: Terms<'h> = terms.collect();
        if term.negative { negated(terms) } else { terms }
    };
    let sum = sorted(merged(own(one, other), own(other, one)), order);
    let common = one.factors.iter().filter(|factor| other.factors.contains(factor));
    let mut term = ArrangedTerm::product(&sum, common.cloned().collect());
    term.coefficient = &term.coefficient * &one.coefficient;
    sort_factors(&mut term.factors, order);
    term
}

fn of_factors(factors: Vec<Power<'_>>) -> ArrangedTerm<'_> {
    ArrangedTerm { negative: false, coefficient: Number::integer(1), factors }
}

fn constant<'h>(number: &Number) -> Terms<'h> {
    let coefficient = if number.is_negative() { -number } else { number.clone() };
    vec![ArrangedTerm { negative: number.is_negative(), coefficient, factors: vec![] }]
}

pub(super) fn negated(mut terms: Terms<'_>) -> Terms<'_> {
    for term in &mut terms {
        term.negative = !term.negative;
    }
    terms
}

/// The sum of two sums, in which terms with the same factors are merged.
fn merged<'h>(mut terms: Terms<'h>, more: Terms<'h>) -> Terms<'h> {
    let signed = |term: &ArrangedTerm<'h>| match term.negative {
        true => -&term.coefficient,
        false => term.coefficient.clone(),
    };
    for term in more {
        let Some(like) = terms.iter_mut().find(|known| known.factors == term.factors) else {
            terms.push(term);
            continue;
        };
        let sum = &signed(like) + &signed(&term);
        like.negative = sum.is_negative();
        like.coefficient = if sum.is_negative() { -&sum } else { sum };
    }
    terms.retain(|term| !term.coefficient.is_zero());
    terms
}

/// The product or, with a negative `power`, the quotient of two sums. A sum of several terms becomes a factor in parentheses.
fn times<'h>(a: Terms<'h>, b: Terms<'h>, power: i32, order: &Order<'_>) -> ArrangedTerm<'h> {
    let (a, mut b) = (one_term(sorted(a, order)), one_term(sorted(b, order)));
    if power < 0 {
        b.coefficient = b.coefficient.recip();
        b.factors.iter_mut().for_each(|(_, exponent)| *exponent = -*exponent);
    }
    let mut product = multiplied(a, b);
    sort_factors(&mut product.factors, order);
    product
}

/// A sum as one term, which is 0 for an empty sum.
fn one_term(mut terms: Terms<'_>) -> ArrangedTerm<'_> {
    match (terms.len(), terms.pop()) {
        (_, None) => ArrangedTerm { coefficient: Number::integer(0), ..of_factors(vec![]) },
        (1, Some(single)) => single,
        (_, Some(last)) => {
            terms.push(last);
            ArrangedTerm::product(&terms, vec![])
        }
    }
}

/// Whether the terms are one product of at most two symbols, sines or cosines, possibly with a minus sign; it is as
/// easy to read as a name.
pub(super) fn is_short_product(terms: &[ArrangedTerm<'_>]) -> bool {
    let [ArrangedTerm { coefficient, factors, .. }] = terms else { return false };
    let is_plain = |(factor, exponent): &(ArrangedFactor<'_>, i32)| {
        factor.as_atom().is_some() && *exponent > 0
    };
    let count: u32 = factors.iter().map(|(_, exponent)| exponent.unsigned_abs()).sum();
    coefficient.is_one() && count <= 2 && factors.iter().all(is_plain)
}

/// Returns the value of terms that need no name: 0, or a symbol that is defined already, possibly with the opposite
/// sign.
pub(super) fn known<'h>(terms: &[ArrangedTerm<'h>], target: &'h Graph) -> Option<Expr<'h>> {
    match terms {
        [] => Some(target.zero()),
        [ArrangedTerm { negative, coefficient, factors }] if coefficient.is_one() => {
            let [(ArrangedFactor::Atom(atom), 1)] = factors.as_slice() else { return None };
            atom.as_symbol()?;
            Some(if *negative { -*atom } else { *atom })
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Graph;
    use robot_symbolic::print::arranged_text;

    use super::*;

    fn robot() -> robot_model::robot::Robot {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r.toml");
        let text = std::fs::read_to_string(path).unwrap();
        robot_model::description::read_toml(path, &text).unwrap().robot
    }

    #[test]
    fn products_have_powers_and_sums_like_terms() {
        let robot = robot();
        let order = Order::new(&robot);
        for (given, expected) in [
            ("0.5*I2 + r2*m2*r2 + 0.5*I2", "m2*r2^2 + I2"),
            ("x*qd1*(x*qd2)", "x^2*qd1*qd2"),
            ("(sin(q1)*qd1)^2*(2*qd1)", "2*sin(q1)^2*qd1^3"),
            ("a - (b - (c + a))", "2*a - b + c"),
            ("(a - b)*m1*(a - b)", "m1*(a - b)^2"),
            ("a/m1 + (a - a)*b", "a/m1"),
            ("2*(a + b)/4", "0.5*(a + b)"),
        ] {
            let graph = Graph::new();
            let expr = graph.parse(given).unwrap();
            let terms = terms(expr, &order);
            assert_eq!(arranged_text(&terms).unwrap(), expected, "{given}");
        }
    }

    /// Counts the operations of an expression as a tree, without those in arguments of functions.
    fn operations_of(expr: Expr<'_>) -> usize {
        let both = |a, b| operations_of(a) + operations_of(b);
        match expr.view() {
            View::Add(a, b) | View::Sub(a, b) | View::Mul(a, b) | View::Div(a, b) => 1 + both(a, b),
            View::Neg(a) => operations_of(a),
            _ => 0,
        }
    }

    #[test]
    fn values_stay_and_operations_do_not_grow() {
        use crate::{EquationOptions, Form, equations};
        for name in ["planar_2r", "trttr1", "puma560", "stanford", "ur5"] {
            let path = format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(&path).unwrap();
            let robot = robot_model::description::read_toml(&path, &text).unwrap().robot;
            let order = Order::new(&robot);
            let options = EquationOptions { form: Form::Recursive, ..EquationOptions::default() };
            let found = equations(&robot, &options).unwrap();
            for equation in found.groups.iter().flat_map(|group| &group.equations) {
                let graph = Graph::new();
                let formula = robot_symbolic::Formula::parse_with_dots(&equation.text).unwrap();
                let expr = formula.lower(&graph, &mut |name| graph.symbol(name));
                let terms = factored(terms(expr, &order), &order);
                let place = format!("{name}: {} = {}", equation.name, equation.text);
                assert!(operations(&terms) <= operations_of(expr), "{place}");
                let value = |symbol| 0.3 + f64::from(graph.symbol_name(symbol).len() as u32) / 7.0;
                let arranged = robot_symbolic::print::arranged_value(&terms, &graph);
                let (before, after) = (expr.evaluate(value), arranged.evaluate(value));
                assert!((before - after).abs() <= 1e-12 * before.abs().max(1.0), "{place}");
            }
        }
    }

    #[test]
    fn terms_that_differ_in_one_factor_are_one() {
        let robot = robot();
        let order = Order::new(&robot);
        for (given, expected) in [
            ("l1*qd1 + qd1*q2", "(l1 + q2)*qd1"),
            ("m1*qdd1 + m1*qdd2 - m1*qd1", "-m1*(qd1 - qdd1 - qdd2)"),
            ("2*l1*qd1*qd2 - 2*r1*qd1*qd2 + l1*r1", "l1*r1 + 2*(l1 - r1)*qd1*qd2"),
            ("-l1*qd1 - r1*qd1", "-(l1 + r1)*qd1"),
            ("r1*qd1 + (l1 + q2)*qd1 + 1", "(l1 + r1 + q2)*qd1 + 1"),
            ("2*l1*qd1 + r1*qd1", "(2*l1 + r1)*qd1"),
            ("2*l1*qd1 + r1*qd1 + 1", "2*l1*qd1 + r1*qd1 + 1"),
            ("m1*(0.5*l1*r1*qd1 - 0.5*r1*q2*qd2)", "0.5*m1*r1*(l1*qd1 - q2*qd2)"),
            ("m1*(2*l1*r1 + r1)", "m1*r1*(2*l1 + 1)"),
            ("l1*qd1 + r1*qd2 + qd1", "l1*qd1 + r1*qd2 + qd1"),
            ("(l1 + r1)*qd1 - l1*qd1", "r1*qd1"),
            ("qd2*(l1*qd1 + q2*qd1 + 1)", "((l1 + q2)*qd1 + 1)*qd2"),
        ] {
            let graph = Graph::new();
            let expr = graph.parse(given).unwrap();
            let terms = factored(terms(expr, &order), &order);
            assert_eq!(arranged_text(&terms).unwrap(), expected, "{given}");
            let value = robot_symbolic::print::arranged_value(&terms, &graph);
            let zero = robot_symbolic::Polynomial::of(
                value - expr,
                &robot_symbolic::PolynomialOptions::default(),
            );
            assert!(zero.unwrap().is_zero(), "{given}");
        }
    }

    #[test]
    fn operations_are_counted() {
        let robot = robot();
        let order = Order::new(&robot);
        let graph = Graph::new();
        let count = |text: &str| operations(&terms(graph.parse(text).unwrap(), &order));
        assert_eq!(["a", "2*a*b^2", "a*(b + c) - 1", "a/b"].map(count), [0, 3, 3, 1]);
    }
}
