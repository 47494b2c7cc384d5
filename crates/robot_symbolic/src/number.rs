//! Constants: exact if they are rational and not too long, otherwise floating-point numbers.

use std::hash::{Hash, Hasher};

use crate::rational::{MAX_BITS, Rational};

/// The bound on the rounding error of a floating-point number, as a fraction of its largest term. Each comes from some
/// tens of operations.
const ROUNDED: f64 = 1e-14;

/// A constant of an expression.
///
/// Robot files contain decimal numbers, which are exact rationals, and their sums and products stay exact. A constant
/// becomes `Real` if it has no rational value (for example the sine of an arbitrary angle, evaluated for code) or if it
/// would need more than a few thousand bits.
#[derive(Clone, Debug)]
pub enum Number {
    /// An exact value.
    Rational(Rational),
    /// A floating-point number near a value that has no short exact form.
    Real(Real),
}

/// A floating-point number with a bound on its rounding error.
///
/// A sum of such numbers that is not larger than its rounding error is 0. The error is that of the largest term of all
/// sums that led to the number, so terms that cancel each other leave no small rest, in whatever order they are added.
#[derive(Clone, Copy, Debug)]
pub struct Real {
    value: f64,
    error: f64,
}

impl Real {
    fn new(value: f64, error: f64) -> Real {
        Real { value, error: error.max(ROUNDED * value.abs()) }
    }

    /// The number.
    #[must_use]
    pub fn value(self) -> f64 {
        self.value
    }

    fn recip(self) -> Real {
        let value = 1.0 / self.value;
        Real::new(value, self.error * value * value)
    }
}

/// A number that is rounded itself.
impl From<f64> for Real {
    fn from(value: f64) -> Real {
        Real::new(value, 0.0)
    }
}

impl std::ops::Add for Real {
    type Output = Real;
    fn add(self, other: Real) -> Real {
        let (sum, error) = (self.value + other.value, self.error.max(other.error));
        let is_rounding = sum.is_finite() && sum.abs() <= error;
        Real::new(if is_rounding { 0.0 } else { sum }, error)
    }
}

impl std::ops::Sub for Real {
    type Output = Real;
    fn sub(self, other: Real) -> Real {
        self + -other
    }
}

impl std::ops::Mul for Real {
    type Output = Real;
    fn mul(self, other: Real) -> Real {
        let error = (self.value * other.error).abs().max((self.error * other.value).abs());
        Real::new(self.value * other.value, error)
    }
}

impl std::ops::Div for Real {
    type Output = Real;
    fn div(self, other: Real) -> Real {
        let error = (self * other.recip()).error;
        Real::new(self.value / other.value, error)
    }
}

impl std::ops::Neg for Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real { value: -self.value, ..self }
    }
}

impl Number {
    /// A floating-point number that is rounded itself.
    #[must_use]
    pub fn real(value: f64) -> Number {
        Number::Real(Real::from(value))
    }

    /// An integer.
    #[must_use]
    pub const fn integer(value: i64) -> Number {
        Number::Rational(Rational::integer(value))
    }

    /// The nearest `f64`.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        match self {
            Number::Rational(rational) => rational.to_f64(),
            Number::Real(real) => real.value,
        }
    }

    /// The exact value if there is one.
    #[must_use]
    pub fn as_rational(&self) -> Option<&Rational> {
        match self {
            Number::Rational(rational) => Some(rational),
            Number::Real(_) => None,
        }
    }

    /// Whether the value is 0, exact or as a floating-point number.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        match self {
            Number::Rational(rational) => rational.is_zero(),
            Number::Real(real) => real.value == 0.0,
        }
    }

    /// Whether the value is 1 (exactly, or the floating-point number 1).
    #[must_use]
    pub fn is_one(&self) -> bool {
        match self {
            Number::Rational(rational) => rational.is_one(),
            Number::Real(real) => real.value == 1.0,
        }
    }

    /// Whether the value is below 0; false for NaN.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match self {
            Number::Rational(rational) => rational.is_negative(),
            Number::Real(real) => real.value < 0.0,
        }
    }

    /// `1 / self`. The reciprocal of an exact 0 is a floating-point NaN, which every user of the number can detect and
    /// refuse.
    #[must_use]
    pub fn recip(&self) -> Number {
        match self {
            Number::Rational(rational) => {
                rational.recip().map_or(Number::real(f64::NAN), Number::Rational)
            }
            Number::Real(real) => Number::Real(real.recip()),
        }
    }

    /// The extra cost of arithmetic on the number, in units of the cost of arithmetic on machine words: 0 for small
    /// numbers, and more for large ones, which need allocations and the multiplication of many words.
    pub(crate) fn weight(&self) -> u64 {
        match self {
            Number::Rational(rational) if rational.to_small().is_none() => {
                4 + rational.bits() as u64 / 64
            }
            _ => 0,
        }
    }

    #[inline]
    fn integers(
        &self,
        other: &Number,
        operation: impl Fn(i64, i64) -> Option<i64>,
    ) -> Option<Number> {
        match (self, other) {
            (Number::Rational(a), Number::Rational(b)) => {
                a.integers(b, operation).map(Number::Rational)
            }
            _ => None,
        }
    }

    fn combine(
        &self,
        other: &Number,
        exact: impl Fn(&Rational, &Rational) -> Rational,
        real: impl Fn(Real, Real) -> Real,
    ) -> Number {
        if let (Number::Rational(a), Number::Rational(b)) = (self, other) {
            let value = exact(a, b);
            if value.bits() <= MAX_BITS {
                return Number::Rational(value);
            }
        }
        Number::Real(real(self.to_real(), other.to_real()))
    }

    fn to_real(&self) -> Real {
        match self {
            Number::Rational(rational) => Real::from(rational.to_f64()),
            Number::Real(real) => *real,
        }
    }
}

impl std::ops::Add for &Number {
    type Output = Number;
    #[inline]
    fn add(self, other: &Number) -> Number {
        if let Some(sum) = self.integers(other, i64::checked_add) {
            return sum;
        }
        self.combine(other, |a, b| a + b, |a, b| a + b)
    }
}

impl std::ops::Sub for &Number {
    type Output = Number;
    fn sub(self, other: &Number) -> Number {
        self.combine(other, |a, b| a - b, |a, b| a - b)
    }
}

impl std::ops::Mul for &Number {
    type Output = Number;
    #[inline]
    fn mul(self, other: &Number) -> Number {
        if let Some(product) = self.integers(other, i64::checked_mul) {
            return product;
        }
        self.combine(other, |a, b| a * b, |a, b| a * b)
    }
}

impl std::ops::Neg for &Number {
    type Output = Number;
    fn neg(self) -> Number {
        match self {
            Number::Rational(rational) => Number::Rational(-rational),
            Number::Real(real) => Number::Real(-*real),
        }
    }
}

/// Equality of representation; floating-point numbers are compared by their bits, so that interning is deterministic.
impl PartialEq for Number {
    fn eq(&self, other: &Number) -> bool {
        match (self, other) {
            (Number::Rational(a), Number::Rational(b)) => a == b,
            (Number::Real(a), Number::Real(b)) => a.value.to_bits() == b.value.to_bits(),
            _ => false,
        }
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Number::Rational(rational) => rational.hash(state),
            Number::Real(real) => real.value.to_bits().hash(state),
        }
    }
}

impl From<Rational> for Number {
    fn from(value: Rational) -> Number {
        Number::Rational(value)
    }
}

/// Whether a decimal text that is read as `value` is below the range of `f64`: `1e-400` is not 0.
#[must_use]
pub fn is_below_range(text: &str, value: f64) -> bool {
    let mantissa = || text.split(['e', 'E']).next().unwrap_or(text);
    value == 0.0 && mantissa().contains(|digit| matches!(digit, '1'..='9'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_that_cancel_are_zero() {
        let real = Number::real;
        assert!((&real(0.1 + 0.2) - &real(0.3)).is_zero());
        assert!((&real(0.1 + 0.2) + &real(-0.3)).is_zero());
        assert!((&real(0.1 + 0.2) - &Number::Rational(Rational::new(3, 10).unwrap())).is_zero());
        assert!(!(&real(1.0) - &real(1.0 + 1e-12)).is_zero());
        assert!(!(&real(1e-300) + &Number::integer(0)).is_zero());
        // The terms cancel one after the other, and their rest is multiplied and divided.
        let rest = &(&real(100.1) - &real(100.0)) - &real(0.1);
        assert!(rest.is_zero());
        let factor = &(&real(100.1) - &real(100.0)) * &real(1e-3);
        assert!((&factor - &real(1e-4)).is_zero());
        let quotient = (Real::from(100.1) - Real::from(100.0)) / Real::from(1e3);
        assert_eq!((quotient - Real::from(1e-4)).value(), 0.0);
        let divisor = (&real(100.1) - &real(100.0)).recip();
        assert!((&divisor - &Number::integer(10)).is_zero());
        assert!(!(&(&real(100.1) - &real(100.0)) - &real(0.1 + 1e-11)).is_zero());
        assert_eq!((&real(f64::INFINITY) + &real(1.0)).to_f64(), f64::INFINITY);
        let third = Number::Rational(Rational::new(1, 3).unwrap());
        let near = Number::Rational(Rational::from_f64(1.0 / 3.0).unwrap());
        assert!(!(&third - &near).is_zero());
    }

    #[test]
    fn repeated_squaring_ends_in_a_float() {
        let mut number = Number::Rational(Rational::new(10, 7).unwrap());
        for _ in 0..20 {
            number = &number * &number;
        }
        assert!(matches!(number, Number::Real(_)));
    }

    #[test]
    fn the_reciprocal_of_zero_is_not_a_number() {
        assert!(Number::integer(0).recip().to_f64().is_nan());
    }
}
