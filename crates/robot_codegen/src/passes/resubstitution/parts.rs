//! The parts of values that grow alike with the inputs.
//!
//! At a sample point, a term far below the rounding error of the sum that it is in is not noticed, but it counts at other
//! inputs: in 9.81 sin q + 10⁻¹² q̇², the second term is the larger one at 10⁷ rad/s. Each value is therefore also
//! regarded as a polynomial in the inputs, and the coefficients of its monomials are compared one by one. Sines and
//! cosines, parameters and the quotients of those are numbers here.

use std::collections::BTreeMap;

use super::Form;
use crate::program::{Operation, Program, Source, Value};

/// The number of points at which coefficients are compared.
pub(super) const POINTS: usize = 2;

/// The unit of rounding of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;
/// A coefficient counts if it is larger than its rounding error by this factor.
const COUNTS: f64 = 1e3;
/// The most inputs that are told apart; if there are more, neighbors count as one.
const INPUTS: u32 = 48;
/// The highest degree of a monomial.
const DEGREE: usize = 8;

/// A product of inputs, by their numbers in ascending order, and of the values of functions, which count as one further
/// input.
type Monomial = Vec<u8>;

/// The number of the values of functions in monomials.
const CALLS: u8 = u8::MAX;

/// A coefficient at the points, with bounds on the rounding error of its evaluation.
#[derive(Clone, Copy, Debug, Default)]
struct Coefficient {
    values: [f64; POINTS],
    errors: [f64; POINTS],
}

/// The coefficients of a polynomial in the inputs.
type Polynomial = BTreeMap<Monomial, Coefficient>;

/// The polynomials of the values of a program; `None` for what is not a polynomial, or one of too high a degree.
pub(super) struct Parts(Vec<Option<Polynomial>>);

impl Parts {
    /// Computes the polynomials of all values of a program; `number` returns the values of a load or of a call at the
    /// points.
    pub(super) fn of(
        program: &Program,
        number: impl Fn(Value, Operation) -> [f64; POINTS],
    ) -> Parts {
        let index = |source: &Source| match source {
            Source::Input(index) => Some(*index),
            _ => None,
        };
        let inputs = program.sources().iter().filter_map(index).max().map_or(0, |last| last + 1);
        let width = inputs.div_ceil(INPUTS).max(1);
        let mut parts = Parts(Vec::with_capacity(program.operations().len()));
        for (value, operation) in program.values() {
            let exact = |monomial: Monomial| {
                let coefficient =
                    Coefficient { values: number(value, operation), errors: [0.0; POINTS] };
                Some(Polynomial::from([(monomial, coefficient)]))
            };
            let polynomial = match operation {
                Operation::Constant(constant) => constant_of(constant.get()),
                Operation::Load(Source::Input(index)) => {
                    exact(vec![u8::try_from(index / width).unwrap_or(CALLS)])
                }
                Operation::Load(_) => exact(vec![]),
                Operation::Call(robot_symbolic::Function::RecipPositive, a) => {
                    quotient(constant_of(1.0), parts.at(a))
                }
                Operation::Call(..) => exact(vec![CALLS]),
                Operation::Add(a, b) => sum(parts.at(a).cloned(), parts.at(b), 1.0),
                Operation::Sub(a, b) => sum(parts.at(a).cloned(), parts.at(b), -1.0),
                Operation::Mul(a, b) => product(parts.at(a), parts.at(b)),
                Operation::Div(a, b) => quotient(parts.at(a).cloned(), parts.at(b)),
                Operation::Neg(a) => sum(Some(Polynomial::new()), parts.at(a), -1.0),
                Operation::MulAdd(a, b, c) => {
                    sum(product(parts.at(a), parts.at(b)), parts.at(c), 1.0)
                }
            };
            parts.0.push(polynomial);
        }
        parts
    }

    fn at(&self, value: Value) -> Option<&Polynomial> {
        self.0.get(value.index()).and_then(Option::as_ref)
    }

    /// Whether a form has every coefficient of the value that it replaces, as far as both are polynomials.
    pub(super) fn agree(&self, value: Value, form: Form) -> bool {
        match (self.at(value), self.of_form(form).as_ref()) {
            (Some(value), Some(form)) => {
                let of_value = value.keys().all(|monomial| agree(value, form, monomial));
                of_value && form.keys().all(|monomial| agree(value, form, monomial))
            }
            _ => true,
        }
    }

    fn of_form(&self, form: Form) -> Option<Polynomial> {
        let nothing = || Some(Polynomial::new());
        let sign = |negative: bool| if negative { -1.0 } else { 1.0 };
        match form {
            Form::Constant(constant) => constant_of(constant),
            Form::Equal(a, minus) => sum(nothing(), self.at(a), sign(minus)),
            Form::Multiple(constant, a) => sum(nothing(), self.at(a), constant),
            Form::SumMultiple(a, constant, b) => sum(self.at(a).cloned(), self.at(b), constant),
            Form::Sum((a, minus_a), (b, minus_b)) => {
                sum(sum(nothing(), self.at(a), sign(minus_a)), self.at(b), sign(minus_b))
            }
            Form::Product(a, b, minus) => {
                sum(nothing(), product(self.at(a), self.at(b)).as_ref(), sign(minus))
            }
        }
    }
}

/// Whether two polynomials have the same coefficient of a monomial, up to rounding.
fn agree(a: &Polynomial, b: &Polynomial, monomial: &Monomial) -> bool {
    let [a, b] = [a, b].map(|one| one.get(monomial).copied().unwrap_or_default());
    (0..POINTS).all(|point| {
        let difference = (a.values[point] - b.values[point]).abs();
        let comparable = difference.is_finite();
        !comparable || difference <= COUNTS * a.errors[point].max(b.errors[point])
    })
}

fn constant_of(constant: f64) -> Option<Polynomial> {
    let (values, errors) = ([constant; POINTS], [UNIT * constant.abs(); POINTS]);
    Some(Polynomial::from([(vec![], Coefficient { values, errors })]))
}

/// A polynomial plus a multiple of another.
fn sum(a: Option<Polynomial>, b: Option<&Polynomial>, factor: f64) -> Option<Polynomial> {
    let mut sum = a?;
    for (monomial, b) in b? {
        let a = sum.entry(monomial.clone()).or_default();
        for point in 0..POINTS {
            a.values[point] += factor * b.values[point];
            a.errors[point] += factor.abs() * b.errors[point] + UNIT * a.values[point].abs();
        }
    }
    Some(sum)
}

fn product(a: Option<&Polynomial>, b: Option<&Polynomial>) -> Option<Polynomial> {
    let mut product = Polynomial::new();
    for (first, a) in a? {
        for (second, b) in b? {
            let mut monomial = [first.as_slice(), second].concat();
            if monomial.len() > DEGREE {
                return None;
            }
            monomial.sort_unstable();
            let sum = product.entry(monomial).or_default();
            for point in 0..POINTS {
                let value = a.values[point] * b.values[point];
                sum.values[point] += value;
                sum.errors[point] += a.errors[point] * b.values[point].abs()
                    + a.values[point].abs() * b.errors[point]
                    + UNIT * (value.abs() + sum.values[point].abs());
            }
        }
    }
    Some(product)
}

/// The quotient by a polynomial without inputs.
fn quotient(a: Option<Polynomial>, b: Option<&Polynomial>) -> Option<Polynomial> {
    let (mut quotient, b) = (a?, b?);
    let divisor = b.get([].as_slice()).filter(|_| b.len() == 1)?;
    for a in quotient.values_mut() {
        for point in 0..POINTS {
            let value = a.values[point] / divisor.values[point];
            a.errors[point] = (a.errors[point] + value.abs() * divisor.errors[point])
                / divisor.values[point].abs()
                + UNIT * value.abs();
            a.values[point] = value;
        }
    }
    Some(quotient)
}
