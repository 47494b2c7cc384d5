//! Derivatives of expressions by the complex step: f′ = Im f(x + i h) / h. Nothing is subtracted, so they are as
//! accurate as the values; symbolic differentiation is not used.

use std::collections::HashMap;

use nalgebra::{Complex, ComplexField};
use robot_model::robot::Robot;
use robot_numeric::random::State;
use robot_symbolic::{Expr, Function, View, walk};

use super::value_of;

/// The size of the step. Its square, the relative truncation error, is far below the precision of floating-point
/// numbers.
const STEP: f64 = 1e-100;

/// The time derivatives of values in a state whose entries change with the velocities `rate`.
pub fn derivative(robot: &Robot, roots: &[Expr<'_>], state: &State, rate: &State) -> Vec<f64> {
    let mut values: HashMap<_, Complex<f64>> = HashMap::new();
    for expr in walk::reachable(roots) {
        let at = |operand: Expr<'_>| values[&operand.id()];
        let value = match expr.view() {
            View::Number(number) => Complex::from(number.to_f64()),
            View::Pi => Complex::from(std::f64::consts::PI),
            View::Symbol(symbol) => {
                let name = expr.graph().symbol_name(symbol);
                let real = value_of(robot, &name, state);
                let real = real.unwrap_or_else(|| panic!("no value for {name}"));
                let moves = robot.parameter(&name).is_none();
                let slope = value_of(robot, &name, rate).filter(|_| moves).unwrap_or(0.0);
                Complex::new(real, STEP * slope)
            }
            View::Add(a, b) => at(a) + at(b),
            View::Sub(a, b) => at(a) - at(b),
            View::Mul(a, b) => at(a) * at(b),
            View::Div(a, b) => at(a) / at(b),
            View::Neg(a) => -at(a),
            View::Call(Function::Sin, a) => ComplexField::sin(at(a)),
            View::Call(Function::Cos, a) => ComplexField::cos(at(a)),
            View::Call(Function::Sqrt, a) => ComplexField::sqrt(at(a)),
            View::Call(Function::RecipPositive, a) => ComplexField::recip(at(a)),
            View::Call(other, _) => panic!("{other:?} has no complex step here"),
        };
        values.insert(expr.id(), value);
    }
    roots.iter().map(|root| values[&root.id()].im / STEP).collect()
}
