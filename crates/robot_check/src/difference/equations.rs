//! Differences between the terms of two robots' joint torques.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_dynamics::quantity::Kind;
use robot_model::functions::Effects;
use robot_model::robot::Robot;
use robot_symbolic::{
    AngleSums, Expr, Graph, Id, Number, Polynomial, PolynomialError, PolynomialOptions, View, print,
};

use crate::difference::{Options, Refusal};

/// The limits of the expansion of one joint torque, which takes a fraction of a second.
const LIMITS: PolynomialOptions = PolynomialOptions {
    angle_sums: AngleSums::Expand,
    max_terms: 100_000,
    max_products: 1_000_000,
};

/// After this number of joint torques that are too long, no others are expanded, because those of joints farther inward
/// are even longer.
const MAX_REFUSED: usize = 3;
/// The reason why a joint torque is not expanded after that.
const FARTHER_OUT: &str =
    "not expanded, because three joint torques farther out are already too long";

/// A joint torque whose terms differ or cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Equation {
    /// The name of the joint torque, such as `Q1`.
    pub name: String,
    /// The terms that are added, removed or changed, or the reason why they cannot be compared.
    pub terms: Result<Vec<Term>, Refusal>,
}

/// A term that differs: its powers, and its coefficients in the two robots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// The powers, such as `m2*l1*qdd1*cos(q2)`; `1` for a constant.
    pub powers: String,
    /// The exact coefficients as text; `None` if the robot does not have the term.
    pub coefficients: [Option<String>; 2],
}

/// The joint torques that differ, without friction, including the effect of the tips' wrenches.
pub(crate) fn differing(a: &Robot, b: &Robot, options: &Options) -> Vec<Equation> {
    let graph = Graph::new();
    let [of_a, of_b] = &options.code;
    let (before, after) = (forces(a, &graph, of_a.snap), forces(b, &graph, of_b.snap));
    let count = before.len().max(after.len());
    let (mut equations, mut refused) = (vec![], 0);
    for place in (0..count).rev() {
        let pair = [before.get(place), after.get(place)].map(Option::<&Expr<'_>>::copied);
        // Equal expressions are the same node of the graph and need not be expanded.
        if pair[0] == pair[1] {
            continue;
        }
        let terms = match refused {
            MAX_REFUSED => Err(FARTHER_OUT.to_owned()),
            _ => terms(pair).map_err(|error| reason(&error)),
        };
        refused += usize::from(terms.is_err() && refused < MAX_REFUSED);
        if terms.as_ref().is_ok_and(Vec::is_empty) {
            continue;
        }
        let name = format!("{}{}", Kind::JointTorque.name(), place + 1);
        equations.push(Equation { name, terms });
    }
    equations.reverse();
    equations
}

fn forces<'g>(robot: &Robot, graph: &'g Graph, snap: Option<f64>) -> Vec<Expr<'g>> {
    let exact = MechanismOptions::EXACT.with_snap(snap, robot);
    let mechanism = Mechanism::new(robot, graph, &exact);
    let solution = newton_euler(&mechanism, Effects { wrench: true, friction: false });
    solution.quantities(Kind::JointTorque).into_iter().map(|quantity| quantity.value).collect()
}

/// The reason why the terms of an equation cannot be compared.
fn reason(error: &PolynomialError) -> Refusal {
    match error {
        PolynomialError::TooManyTerms { limit } => {
            format!("expanded, it has more than {limit} terms")
        }
        PolynomialError::TooManyProducts { limit } => {
            format!("expanding it takes more than {limit} products of terms")
        }
        other => other.to_string(),
    }
}

/// Powers of atoms in the order in which equations list terms: the ranks of atoms, the atoms and their exponents, with
/// higher powers of the first atom first. The last entry has no atom, so that a product comes before its own factors.
type Powers = Vec<(u8, Option<Id>, Reverse<i32>)>;

fn terms(pair: [Option<Expr<'_>>; 2]) -> Result<Vec<Term>, PolynomialError> {
    let mut texts: BTreeMap<Powers, (String, [Option<Number>; 2])> = BTreeMap::new();
    for (side, expr) in pair.into_iter().enumerate() {
        let Some(expr) = expr else { continue };
        for term in Polynomial::of(expr, &LIMITS)?.arranged(print::default_rank) {
            let factors = term.factors.iter();
            let factors: Vec<(Expr<'_>, i32)> = factors
                .filter_map(|(factor, exponent)| Some((factor.as_atom()?, *exponent)))
                .collect();
            let end = (u8::MAX, None, Reverse(0));
            let key = factors.iter().map(|(atom, exponent)| {
                (print::default_rank(*atom), Some(atom.id()), Reverse(*exponent))
            });
            let key = key.chain([end]).collect();
            let coefficient = if term.negative { -&term.coefficient } else { term.coefficient };
            let found = texts.entry(key).or_insert_with(|| (powers(&factors), [None, None]));
            if let Some(place) = found.1.get_mut(side) {
                *place = Some(coefficient);
            }
        }
    }
    let differing = texts.into_values().filter(|(_, coefficients)| differ(coefficients));
    Ok(differing
        .map(|(powers, coefficients)| Term { powers, coefficients: shown(&coefficients) })
        .collect())
}

/// Whether two coefficients differ; a rounded number equals all numbers that round to it.
fn differ([before, after]: &[Option<Number>; 2]) -> bool {
    match (before, after) {
        (Some(Number::Rational(before)), Some(Number::Rational(after))) => before != after,
        (Some(before), Some(after)) => before.to_f64() != after.to_f64(),
        _ => before != after,
    }
}

/// The texts of two coefficients that differ; both are exact if they would be the same as decimals.
fn shown(coefficients: &[Option<Number>; 2]) -> [Option<String>; 2] {
    let shown = coefficients.each_ref().map(|one| one.as_ref().map(print::coefficient_text));
    match (&shown, coefficients) {
        ([before, after], [Some(Number::Rational(one)), Some(Number::Rational(other))])
            if before == after =>
        {
            [one, other].map(|value| Some(print::exact_text(value)))
        }
        _ => shown,
    }
}

/// The text of powers, such as `m2*qd1^2*sin(q2)`; a sum is in parentheses.
fn powers(factors: &[(Expr<'_>, i32)]) -> String {
    let power = |(atom, exponent): &(Expr<'_>, i32)| {
        let mut text = print::to_text(*atom).unwrap_or_else(|error| error.to_string());
        if !matches!(atom.view(), View::Symbol(_) | View::Call(..) | View::Pi) {
            text = format!("({text})");
        }
        match exponent {
            1 => text,
            exponent => format!("{text}^{exponent}"),
        }
    };
    match factors {
        [] => "1".to_owned(),
        factors => factors.iter().map(power).collect::<Vec<_>>().join("*"),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that fails panics")]

    use super::*;

    #[test]
    fn terms_are_in_the_order_of_the_equations() {
        let graph = Graph::new();
        let sum = graph.parse("1 + sin(q1)*m1 + m1 + m1*l1 + m1^2").unwrap();
        let found = terms([Some(sum), None]).unwrap();
        let powers: Vec<&str> = found.iter().map(|term| term.powers.as_str()).collect();
        assert_eq!(powers, ["m1^2", "m1*l1", "m1*sin(q1)", "m1", "1"]);
    }

    /// A tenth of the root of 2 differs from its first 34 digits, also in the text.
    #[test]
    fn coefficients_that_differ_have_different_texts() {
        let graph = Graph::new();
        let pair =
            |a: &str, b: &str| terms([a, b].map(|text| Some(graph.parse(text).unwrap()))).unwrap();
        let found = pair("(sqrt(2)/10)^2*m1", "0.1414213562373095048801688724209698^2*m1");
        let [Some(before), Some(after)] = &found[0].coefficients else { panic!("{found:?}") };
        assert_eq!(before, "0.02");
        assert!(after.starts_with("4999999") && after.contains('/'), "{after}");
        assert_eq!(pair("sin(0.3)*m1", "sin(0.3)*m1"), []);
    }

    #[test]
    fn sums_are_in_parentheses() {
        let graph = Graph::new();
        let quotient = graph.parse("m1/(m1 + mt)^2").unwrap();
        let found = terms([Some(quotient), None]).unwrap();
        assert_eq!(found[0].powers, "m1*(m1 + mt)^-2");
    }
}
