//! Constants: exact if they are rational and not too long, otherwise floating-point numbers.

use std::hash::{Hash, Hasher};

use crate::rational::{MAX_BITS, Rational};

/// The size of rounding errors of floating-point numbers, as a fraction of their largest term. Each comes from some tens
/// of operations.
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
    /// The nearest `f64` to a value that has no short exact form.
    Real(f64),
}

impl Number {
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
            Number::Real(value) => *value,
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
            Number::Real(value) => *value == 0.0,
        }
    }

    /// Whether the value is 1 (exactly, or the floating-point number 1).
    #[must_use]
    pub fn is_one(&self) -> bool {
        match self {
            Number::Rational(rational) => rational.is_one(),
            Number::Real(value) => *value == 1.0,
        }
    }

    /// Whether the value is below 0; false for NaN.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match self {
            Number::Rational(rational) => rational.is_negative(),
            Number::Real(value) => *value < 0.0,
        }
    }

    /// `1 / self`. The reciprocal of an exact 0 is a floating-point NaN, which every user of the number can detect and
    /// refuse.
    #[must_use]
    pub fn recip(&self) -> Number {
        match self {
            Number::Rational(rational) => {
                rational.recip().map_or(Number::Real(f64::NAN), Number::Rational)
            }
            Number::Real(value) => Number::Real(1.0 / value),
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
        real: impl Fn(f64, f64) -> f64,
    ) -> Number {
        if let (Number::Rational(a), Number::Rational(b)) = (self, other) {
            let value = exact(a, b);
            if value.bits() <= MAX_BITS {
                return Number::Rational(value);
            }
        }
        Number::Real(real(self.to_f64(), other.to_f64()))
    }
}

/// The sum of floating-point numbers, or 0 if they cancel each other up to the rounding errors that they have already.
fn sum(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let is_rounding = sum.is_finite() && sum.abs() <= ROUNDED * a.abs().max(b.abs());
    if is_rounding { 0.0 } else { sum }
}

impl std::ops::Add for &Number {
    type Output = Number;
    #[inline]
    fn add(self, other: &Number) -> Number {
        if let Some(sum) = self.integers(other, i64::checked_add) {
            return sum;
        }
        self.combine(other, |a, b| a + b, sum)
    }
}

impl std::ops::Sub for &Number {
    type Output = Number;
    fn sub(self, other: &Number) -> Number {
        self.combine(other, |a, b| a - b, |a, b| sum(a, -b))
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
            Number::Real(value) => Number::Real(-value),
        }
    }
}

/// Equality of representation; floating-point numbers are compared by their bits, so that interning is deterministic.
impl PartialEq for Number {
    fn eq(&self, other: &Number) -> bool {
        match (self, other) {
            (Number::Rational(a), Number::Rational(b)) => a == b,
            (Number::Real(a), Number::Real(b)) => a.to_bits() == b.to_bits(),
            _ => false,
        }
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Number::Rational(rational) => rational.hash(state),
            Number::Real(value) => value.to_bits().hash(state),
        }
    }
}

impl From<Rational> for Number {
    fn from(value: Rational) -> Number {
        Number::Rational(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_that_cancel_are_zero() {
        let real = |value: f64| Number::Real(value);
        assert!((&real(0.1 + 0.2) - &real(0.3)).is_zero());
        assert!((&real(0.1 + 0.2) + &real(-0.3)).is_zero());
        assert!((&real(0.1 + 0.2) - &Number::Rational(Rational::new(3, 10).unwrap())).is_zero());
        assert!(!(&real(1.0) - &real(1.0 + 1e-12)).is_zero());
        assert!(!(&real(1e-300) + &Number::integer(0)).is_zero());
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
