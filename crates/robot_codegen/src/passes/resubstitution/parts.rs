//! The parts of values that grow alike with what a program loads.
//!
//! At a sample point, a term far below the rounding error of the sum that it is in is not noticed, but it counts at
//! other inputs: in 9.81 sin q + 10⁻¹² q̇², the second term is the larger one at 10⁷ rad/s. Each value is therefore
//! also regarded as a polynomial in the inputs, and in the inputs and parameters, and the coefficients of its monomials
//! are compared one by one. Sines and cosines are numbers here.

use std::collections::{BTreeMap, BTreeSet};

use robot_symbolic::Function;

use super::Form;
use super::samples::UNIT;
use crate::program::{Operation, Program, Source, Value};

/// The number of points at which coefficients are compared.
pub(super) const POINTS: usize = 2;

/// A coefficient counts if it is larger than its rounding error by this factor.
const COUNTS: f64 = 1e3;
/// The most variables that are distinguished; if there are more, neighbors count as one.
const VARIABLES: usize = 32;
/// The most monomials of a polynomial.
const MONOMIALS: usize = 600;
/// The most products of monomials that are computed for a product of polynomials.
const PRODUCTS: usize = 8 * MONOMIALS;
/// The highest degree of a monomial.
const DEGREE: usize = 8;

/// A product of variables and their reciprocals, by their numbers in descending order; 0 for none.
type Monomial = [u16; DEGREE];

/// The product of no variables.
const ONE: Monomial = [0; DEGREE];
/// The number of the variable that stands for all values of functions.
const CALL: u16 = 1 + VARIABLES as u16;
/// The difference between the number of the reciprocal of a variable and that of the variable.
const INVERSE: u16 = CALL;
/// The number of the first variable that stands for the reciprocal of a sum.
const OF_SUM: u16 = 2 * CALL + 1;

/// A coefficient at the points, with bounds on the rounding error of its evaluation.
#[derive(Clone, Copy, Debug, Default)]
struct Coefficient {
    values: [f64; POINTS],
    errors: [f64; POINTS],
}

/// The coefficients of the monomials.
type Polynomial = BTreeMap<Monomial, Coefficient>;

/// The values of a program as polynomials.
pub(super) struct Parts(Vec<Polynomials>);

/// The values of a program as polynomials in the same variables; `None` for what is not a polynomial, or one of too
/// many terms.
struct Polynomials(Vec<Option<Polynomial>>);

impl Parts {
    /// Computes the polynomials of all values of a program; `number` returns the values of a load or of a call at the
    /// points.
    pub(super) fn of(
        program: &Program,
        number: impl Fn(Value, Operation) -> [f64; POINTS],
    ) -> Parts {
        let is_input = |source: &Source| matches!(source, Source::Input(_));
        let is_parameter =
            |source: &Source| matches!(source, Source::Parameter(_) | Source::Field(_));
        let sources = program.sources();
        let inputs: Vec<Source> = sources.iter().copied().filter(is_input).collect();
        let parameters: Vec<Source> = sources.iter().copied().filter(is_parameter).collect();
        // With parameters in a denominator, a value is a polynomial in the inputs alone.
        let mut all = vec![Polynomials::of(program, &inputs, &number)];
        if !parameters.is_empty() {
            let variables = [inputs, parameters].concat();
            all.push(Polynomials::of(program, &variables, &number));
        }
        Parts(all)
    }

    /// Whether a form has every coefficient of the value that it replaces, as far as both are polynomials.
    pub(super) fn agree(&self, value: Value, form: Form) -> bool {
        self.0.iter().all(|polynomials| polynomials.agree(value, form))
    }
}

impl Polynomials {
    fn of(
        program: &Program,
        variables: &[Source],
        number: impl Fn(Value, Operation) -> [f64; POINTS],
    ) -> Polynomials {
        let width = variables.len().div_ceil(VARIABLES).max(1);
        let variable = |source: Source| {
            let index = variables.iter().position(|variable| *variable == source);
            index.map_or(0, |index| 1 + (index / width) as u16)
        };
        let mut divisors = vec![];
        let mut reciprocal = |divisor: Value| -> u16 {
            if !divisors.contains(&divisor) {
                divisors.push(divisor);
            }
            let index = divisors.iter().position(|known| *known == divisor).unwrap_or_default();
            OF_SUM + (index % usize::from(u16::MAX - OF_SUM)) as u16
        };
        let mut found = Polynomials(Vec::with_capacity(program.operations().len()));
        for (value, operation) in program.values() {
            let exact = |variable: u16| {
                let (values, errors) = (number(value, operation), [0.0; POINTS]);
                Some(Polynomial::from([(of(variable), Coefficient { values, errors })]))
            };
            let polynomial = match operation {
                Operation::Constant(constant) => constant_of(constant.get()),
                Operation::Load(source) => exact(variable(source)),
                Operation::Call(Function::RecipPositive, a) => {
                    quotient(constant_of(1.0), found.at(a), reciprocal(a))
                }
                Operation::Call(..) => exact(CALL),
                Operation::Add(a, b) => sum(found.at(a).cloned(), found.at(b), 1.0),
                Operation::Sub(a, b) => sum(found.at(a).cloned(), found.at(b), -1.0),
                Operation::Mul(a, b) => product(found.at(a), found.at(b)),
                Operation::Div(a, b) => quotient(found.at(a).cloned(), found.at(b), reciprocal(b)),
                Operation::Neg(a) => sum(Some(Polynomial::new()), found.at(a), -1.0),
                Operation::MulAdd(a, b, c) => {
                    sum(product(found.at(a), found.at(b)), found.at(c), 1.0)
                }
            };
            found.0.push(polynomial);
        }
        found
    }

    fn at(&self, value: Value) -> Option<&Polynomial> {
        self.0.get(value.index()).and_then(Option::as_ref)
    }

    fn agree(&self, value: Value, form: Form) -> bool {
        match (self.at(value), self.of_form(form).as_ref()) {
            (Some(value), Some(form)) if reciprocals(value) == reciprocals(form) => {
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

/// The reciprocals of sums in a polynomial. Two polynomials with different ones cannot be compared.
fn reciprocals(polynomial: &Polynomial) -> BTreeSet<u16> {
    let variables = polynomial.keys().flatten().copied();
    variables.filter(|variable| *variable >= OF_SUM).collect()
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
    Some(Polynomial::from([(ONE, Coefficient { values, errors })]))
}

/// A polynomial plus a multiple of another.
fn sum(a: Option<Polynomial>, b: Option<&Polynomial>, factor: f64) -> Option<Polynomial> {
    let mut sum = a?;
    for (monomial, b) in b? {
        let a = sum.entry(*monomial).or_default();
        for point in 0..POINTS {
            a.values[point] += factor * b.values[point];
            a.errors[point] += factor.abs() * b.errors[point] + UNIT * a.values[point].abs();
        }
    }
    (sum.len() <= MONOMIALS).then_some(sum)
}

fn product(a: Option<&Polynomial>, b: Option<&Polynomial>) -> Option<Polynomial> {
    let (a, b) = (a?, b?);
    if a.len() * b.len() > PRODUCTS {
        return None;
    }
    let mut product = Polynomial::new();
    for (first, a) in a {
        for (second, b) in b {
            let sum = product.entry(times(first, second)?).or_default();
            for point in 0..POINTS {
                let value = a.values[point] * b.values[point];
                sum.values[point] += value;
                sum.errors[point] += a.errors[point] * b.values[point].abs()
                    + a.values[point].abs() * b.errors[point]
                    + UNIT * (value.abs() + sum.values[point].abs());
            }
        }
    }
    (product.len() <= MONOMIALS).then_some(product)
}

/// The monomial of one variable, or of none.
fn of(variable: u16) -> Monomial {
    let mut monomial = ONE;
    monomial[0] = variable;
    monomial
}

/// The product of two monomials, if its degree is not too high.
fn times(a: &Monomial, b: &Monomial) -> Option<Monomial> {
    let mut product = *a;
    for variable in b.iter().copied().filter(|variable| *variable != 0) {
        let opposite = inverse(variable);
        let place = product.iter().position(|one| *one == opposite && opposite != variable);
        let place = place.or_else(|| product.iter().position(|one| *one == 0))?;
        product[place] = if product[place] == 0 { variable } else { 0 };
    }
    product.sort_unstable_by(|a, b| b.cmp(a));
    Some(product)
}

/// The reciprocal of a variable that is not that of a sum.
fn inverse(variable: u16) -> u16 {
    match variable {
        0 | OF_SUM.. => variable,
        1..=INVERSE => variable + INVERSE,
        _ => variable - INVERSE,
    }
}

/// The quotient by a polynomial. The reciprocal of a sum is the variable `of_sum`.
fn quotient(a: Option<Polynomial>, b: Option<&Polynomial>, of_sum: u16) -> Option<Polynomial> {
    let (a, b) = (a?, b?);
    let mut reciprocal = Coefficient::default();
    for point in 0..POINTS {
        let divisor: f64 = b.values().map(|b| b.values[point]).sum();
        let error: f64 = b.values().map(|b| b.errors[point]).sum();
        reciprocal.values[point] = divisor.recip();
        reciprocal.errors[point] = (error / divisor.abs() + UNIT) / divisor.abs();
    }
    let invertible = |monomial: &&Monomial| monomial.iter().all(|variable| *variable < OF_SUM);
    let monomial = b.keys().next().filter(|_| b.len() == 1).filter(invertible);
    let monomial = monomial.map_or(of(of_sum), |monomial| monomial.map(inverse));
    product(Some(&a), Some(&Polynomial::from([(monomial, reciprocal)])))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reciprocal of b ± e is uncertain by e / b².
    #[test]
    fn quotients_by_small_numbers_are_uncertain() {
        let of_number = |value: f64, error: f64| {
            let number = Coefficient { values: [value; POINTS], errors: [error; POINTS] };
            Polynomial::from([(Monomial::default(), number)])
        };
        let found = quotient(Some(of_number(1.0, 0.0)), Some(&of_number(1e-3, 1e-9)), OF_SUM);
        let error = found.unwrap().values().map(|number| number.errors[0]).sum::<f64>();
        assert!((error - 1e-3).abs() < 1e-9, "{error}");
    }
}
