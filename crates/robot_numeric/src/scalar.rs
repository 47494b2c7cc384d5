//! The numbers that the recursions run on.

use nalgebra::{Complex, ComplexField};

/// A number that the recursions can run on: a real one, or a complex one whose imaginary part
/// carries a derivative (the complex-step method).
///
/// Only analytic operations may be used on it: no absolute value, no conjugate, no comparison.
pub trait Number: ComplexField<RealField = f64> + Copy {}

impl Number for f64 {}
impl Number for Complex<f64> {}

/// Size of the complex step. Its square, the relative truncation error of a derivative, is far
/// below the last bit of a double, and nothing that is multiplied by it underflows.
const STEP: f64 = 1e-100;

/// The numbers as complex ones, with the complex step on the number `index`, if there is such a
/// number.
pub(super) fn step(numbers: &[f64], index: usize) -> Vec<Complex<f64>> {
    let step_of = |place| if place == index { STEP } else { 0.0 };
    numbers.iter().enumerate().map(|(place, &x)| Complex::new(x, step_of(place))).collect()
}

/// The derivative that a result carries: f′(x) = Im f(x + i h) / h up to a relative h².
///
/// Nothing is subtracted, so the derivative is as exact as the function itself (J. N. Lyness,
/// C. B. Moler, "Numerical differentiation of analytic functions", 1967).
pub(super) fn derivative(result: Complex<f64>) -> f64 {
    result.im / STEP
}
