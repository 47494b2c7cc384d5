//! Bounds on the rounding errors of the results of a program.
//!
//! Running error analysis (N. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., 2002,
//! section 3.3): each operation propagates the errors of its operands, to first order, and adds the unit roundoff
//! times the magnitude of its result. Inputs, constants and angles are taken as exact, although constants and
//! angles that are computed from several terms are rounded; parameters are decimal numbers that are rounded to the
//! nearest `f64`.

use robot_symbolic::Function as Call;

use crate::interpreter::call;
use crate::program::{Operation, Program, Source, Value};
use crate::trigonometry::Trigonometry;

/// The unit of rounding of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;
/// The largest error of the sines and cosines of the polynomials.
const POLYNOMIAL: f64 = 1.7e-16;

/// A value and a bound on its rounding error, to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded {
    /// The value.
    pub value: f64,
    /// The bound on its error.
    pub error: f64,
}

impl Rounded {
    /// Makes a value with the error inherited from its operands and its own rounding error.
    fn new(value: f64, inherited: f64) -> Rounded {
        Rounded { value, error: inherited + UNIT * value.abs() }
    }

    fn exact(value: f64) -> Rounded {
        Rounded { value, error: 0.0 }
    }

    /// Makes a loaded value: inputs are exact; parameters, fields and sines are rounded.
    pub(crate) fn loaded(source: Source, trigonometry: Trigonometry, value: f64) -> Rounded {
        match source {
            Source::Input(_) => Rounded::exact(value),
            Source::Sin(_) | Source::Cos(_) if trigonometry == Trigonometry::Polynomial => {
                Rounded { value, error: POLYNOMIAL }
            }
            Source::Parameter(_) | Source::Field(_) | Source::Sin(_) | Source::Cos(_) => {
                Rounded::new(value, 0.0)
            }
        }
    }

    fn plus(self, other: Rounded) -> Rounded {
        Rounded::new(self.value + other.value, self.error + other.error)
    }

    fn times(self, other: Rounded) -> Rounded {
        let inherited = self.value.abs() * other.error + other.value.abs() * self.error;
        Rounded::new(self.value * other.value, inherited)
    }

    fn over(self, other: Rounded) -> Rounded {
        let quotient = self.value / other.value;
        let inherited = (self.error + quotient.abs() * other.error) / other.value.abs();
        Rounded::new(quotient, inherited)
    }

    fn minus(self) -> Rounded {
        Rounded { value: -self.value, error: self.error }
    }

    fn call(self, trigonometry: Trigonometry, function: Call) -> Rounded {
        let value = call(trigonometry, function, self.value);
        // The largest slope near the argument.
        let slope = match function {
            Call::Sin | Call::Cos | Call::Tanh | Call::Abs => 1.0,
            Call::Sign => 0.0,
            Call::Sqrt => 0.5 / value,
            Call::RecipPositive => value * value,
        };
        Rounded::new(value, slope * self.error)
    }
}

/// Computes the results of a program as [`evaluate`](crate::interpreter::evaluate) does, with bounds on their
/// errors.
pub(crate) fn evaluate(
    program: &Program,
    trigonometry: Trigonometry,
    load: impl Fn(Source) -> Rounded,
) -> Vec<Rounded> {
    let mut values: Vec<Rounded> = Vec::with_capacity(program.operations().len());
    for operation in program.operations() {
        let at = |value: Value| values[value.index()];
        values.push(match *operation {
            Operation::Constant(constant) => Rounded::exact(constant.get()),
            Operation::Load(source) => load(source),
            Operation::Add(a, b) => at(a).plus(at(b)),
            Operation::Sub(a, b) => at(a).plus(at(b).minus()),
            Operation::Mul(a, b) => at(a).times(at(b)),
            Operation::Div(a, b) => at(a).over(at(b)),
            Operation::Neg(a) => at(a).minus(),
            Operation::MulAdd(a, b, c) => at(a).times(at(b)).plus(at(c)),
            Operation::Call(function, a) => at(a).call(trigonometry, function),
        });
    }
    program.results().iter().map(|value| values[value.index()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Builder;

    /// (1 + x) − 1 for a small x: the difference inherits the rounding error of the sum.
    #[test]
    fn a_difference_of_near_numbers_has_few_digits() {
        let mut builder = Builder::new();
        let (x, one) = (builder.load(Source::Input(0)), builder.constant(1.0));
        let sum = builder.add(x, one);
        let difference = builder.sub(sum, one);
        let program = builder.finish(vec![difference]);
        let x = 1e-10 / 3.0;
        let [found] = evaluate(&program, Trigonometry::Standard, |_| Rounded::exact(x))[..] else {
            panic!()
        };
        assert!((found.value - x).abs() <= found.error, "{found:?}");
        assert!(found.error > 1e-7 * x && found.error < 1e-5 * x, "{found:?}");
    }
}
