//! Sines and cosines of fractions of angles, such as sin(q1/2), which are not replaced by those of the whole angles.

use robot_model::diagnostic::{Diagnostic, code};
use robot_symbolic::{Expr, Function, Graph, Number, View, walk};

use super::lowered;
use super::printed::PrintedEquation;

/// The sines and cosines of fractions of symbols in these expressions.
pub(super) fn of<'g>(values: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let is_of_fraction = |part: &Expr<'g>| match part.view() {
        View::Call(Function::Sin | Function::Cos, angle) => is_fraction(angle),
        _ => false,
    };
    walk::reachable(values).into_iter().filter(is_of_fraction).collect()
}

/// Whether an angle contains a symbol that is divided by a number, or multiplied by one that is not an integer.
fn is_fraction(angle: Expr<'_>) -> bool {
    let is_number = |one: Expr<'_>| walk::symbols(&[one]).is_empty();
    let is_broken = |one: Expr<'_>| match one.view() {
        View::Number(Number::Rational(value)) => value.to_integer().is_none(),
        View::Div(..) => true,
        _ => false,
    };
    walk::reachable(&[angle]).into_iter().any(|part| match part.view() {
        View::Div(over, under) => !is_number(over) && is_number(under),
        View::Mul(a, b) if is_number(a) => !is_number(b) && is_broken(a),
        View::Mul(a, b) if is_number(b) => !is_number(a) && is_broken(b),
        _ => false,
    })
}

/// Returns an error if a right side has a sine or cosine of a fraction of an angle that is not among the `derived`
/// ones.
pub(super) fn refuse<'g>(
    equation: &PrintedEquation,
    derived: &[Expr<'g>],
    graph: &'g Graph,
) -> Result<(), Box<Diagnostic>> {
    let terms: Vec<Expr<'g>> = equation.terms.iter().map(|term| lowered(term, graph)).collect();
    if of(&terms).iter().all(|one| derived.contains(one)) {
        return Ok(());
    }
    let message = "sines and cosines of parts of an angle are not compared";
    let error = Diagnostic::error(code::EXPRESSION, message).at(&equation.span, "in this equation");
    Err(error.help("write those of the whole angle: 2 sin(q1/2) cos(q1/2) is sin(q1)").into())
}
