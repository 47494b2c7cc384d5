//! Evaluation of a program, operation by operation, at one state or at a block of states.

use robot_runtime::{Scalar as _, trig};
use robot_symbolic::Function as Call;

use crate::program::{Operation, Program, Source, Value};
use crate::trigonometry::Trigonometry;

pub(super) fn sin_cos(trigonometry: Trigonometry, angle: f64) -> (f64, f64) {
    match trigonometry {
        Trigonometry::Standard => angle.sin_cos(),
        Trigonometry::Polynomial => trig::double::portable_sin_cos(angle),
    }
}

/// Evaluates a function as generated code does.
pub(crate) fn call(trigonometry: Trigonometry, function: Call, argument: f64) -> f64 {
    match function {
        Call::Sin => sin_cos(trigonometry, argument).0,
        Call::Cos => sin_cos(trigonometry, argument).1,
        Call::Sign => argument.signum0(),
        Call::Tanh => robot_runtime::Scalar::tanh(argument),
        Call::RecipPositive => argument.recip_positive(),
        Call::Sqrt | Call::Abs => function.apply(argument),
    }
}

/// Computes the results of a program, given the values that its loads read. A multiply-add rounds twice.
#[must_use]
pub fn evaluate(
    program: &Program,
    trigonometry: Trigonometry,
    load: impl Fn(Source) -> f64,
) -> Vec<f64> {
    let mut values = Vec::with_capacity(program.operations().len());
    evaluate_block(program, trigonometry, |source| [load(source)], &mut values);
    program.results().iter().map(|value| values[value.index()][0]).collect()
}

/// Replaces the contents of `values` with the values of a program at a block of states: one array for each value of the
/// program, with one number for each state. The result for a state does not depend on the other states.
pub(crate) fn evaluate_block<const STATES: usize>(
    program: &Program,
    trigonometry: Trigonometry,
    load: impl Fn(Source) -> [f64; STATES],
    values: &mut Vec<[f64; STATES]>,
) {
    values.clear();
    for operation in program.operations() {
        let at = |value: Value| values[value.index()];
        let each = |a: Value, of: fn(f64) -> f64| at(a).map(of);
        let both = |a: Value, b: Value, of: fn(f64, f64) -> f64| -> [f64; STATES] {
            let (a, b) = (at(a), at(b));
            std::array::from_fn(|state| of(a[state], b[state]))
        };
        let next = match *operation {
            Operation::Constant(constant) => [constant.get(); STATES],
            Operation::Load(source) => load(source),
            Operation::Add(a, b) => both(a, b, |a, b| a + b),
            Operation::Sub(a, b) => both(a, b, |a, b| a - b),
            Operation::Mul(a, b) => both(a, b, |a, b| a * b),
            Operation::Div(a, b) => both(a, b, |a, b| a / b),
            Operation::Neg(a) => each(a, |a| -a),
            Operation::MulAdd(a, b, c) => {
                let (a, b, c) = (at(a), at(b), at(c));
                std::array::from_fn(|state| a[state] * b[state] + c[state])
            }
            Operation::Call(function, a) => at(a).map(|a| call(trigonometry, function, a)),
        };
        values.push(next);
    }
}
