//! The kinds of numbers for which the recursions are written.

use nalgebra::{Complex, ComplexField};

/// A number for which the recursions are written: a real number, or a complex number whose imaginary part contains a
/// derivative (the complex-step method).
///
/// Only analytic operations may be applied to it: no absolute values, conjugates or comparisons.
pub trait Number: ComplexField<RealField = f64> + Copy {}

impl Number for f64 {}
impl Number for Complex<f64> {}

/// The size of the complex step. Its square, the relative truncation error of a derivative, is far below the precision
/// of floating-point numbers, and products with it do not underflow.
const STEP: f64 = 1e-100;

/// The numbers as complex numbers, with the complex step added to the number at `index`, if that exists.
pub(super) fn step(numbers: &[f64], index: usize) -> Vec<Complex<f64>> {
    let step_of = |place| if place == index { STEP } else { 0.0 };
    numbers.iter().enumerate().map(|(place, &x)| Complex::new(x, step_of(place))).collect()
}

/// The derivative that a result contains: f′(x) = Im f(x + i h) / h, with a relative error of h².
///
/// Nothing is subtracted, so the derivative is as accurate as the function itself (J. N. Lyness, C. B. Moler,
/// "Numerical differentiation of analytic functions", 1967).
pub(super) fn derivative(result: Complex<f64>) -> f64 {
    result.im / STEP
}
