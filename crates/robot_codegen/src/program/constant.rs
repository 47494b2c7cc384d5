//! Constants with irrational parts, such as √3/2 or cos 0.3, in twice the precision of `f64`.
//!
//! Rounding once at the end gives the nearest `f64`, except in about one of 10¹⁵ cases, and the same bits
//! on every machine, independent of its mathematical library.

use std::ops::{Add, Div, Mul, Neg, Sub};

use robot_symbolic::{Function, Number, Rational};

/// π/2 in three parts; each is the nearest `f64` to the remainder after the parts before it.
const HALF_PI: [f64; 3] =
    [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_183_3e-33];

/// The largest angle that can be reduced exactly, in rad. Robot files do not have larger ones.
const LARGEST_ANGLE: f64 = 1e9;

/// An unevaluated sum of two floats, of which the first is the rounded sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    pub(crate) const ZERO: DoubleDouble = DoubleDouble::exact(0.0);
    pub(crate) const PI: DoubleDouble =
        DoubleDouble { high: 2.0 * HALF_PI[0], low: 2.0 * HALF_PI[1] };

    const fn exact(value: f64) -> DoubleDouble {
        DoubleDouble { high: value, low: 0.0 }
    }

    /// `high + low` if `|high| ≥ |low|`.
    fn fast(high: f64, low: f64) -> DoubleDouble {
        let sum = high + low;
        if sum.is_finite() {
            DoubleDouble { high: sum, low: low - (sum - high) }
        } else {
            DoubleDouble::exact(sum)
        }
    }

    /// The exact sum of two floats.
    fn sum(a: f64, b: f64) -> DoubleDouble {
        let (large, small) = if a.abs() < b.abs() { (b, a) } else { (a, b) };
        DoubleDouble::fast(large, small)
    }

    /// The exact product of two floats.
    fn product(a: f64, b: f64) -> DoubleDouble {
        let product = a * b;
        if product.is_finite() {
            DoubleDouble { high: product, low: a.mul_add(b, -product) }
        } else {
            DoubleDouble::exact(product)
        }
    }

    /// The value of a number.
    pub(crate) fn from_number(number: &Number) -> DoubleDouble {
        let high = number.to_f64();
        let rest = |exact: &Rational| Some((exact - &Rational::from_f64(high)?).to_f64());
        let low = number.as_rational().and_then(rest).unwrap_or(0.0);
        DoubleDouble { high, low }
    }

    /// The nearest `f64`.
    pub(crate) fn to_f64(self) -> f64 {
        self.high
    }

    /// A function of the value.
    pub(crate) fn apply(self, function: Function) -> DoubleDouble {
        match function {
            Function::Sin => self.circular(0),
            Function::Cos => self.circular(1),
            Function::Sqrt => self.sqrt(),
            Function::Abs if self.high < 0.0 => -self,
            Function::Abs => self,
            Function::Sign => DoubleDouble::exact(function.apply(self.high)),
            Function::Tanh => self.tanh(),
            Function::RecipPositive if self.high > 0.0 && self.high.is_finite() => {
                DoubleDouble::exact(1.0) / self
            }
            Function::RecipPositive => DoubleDouble::exact(f64::NAN),
        }
    }

    fn sqrt(self) -> DoubleDouble {
        let root = self.high.sqrt();
        if root == 0.0 || !root.is_finite() {
            return DoubleDouble::exact(root);
        }
        let rest = self - DoubleDouble::product(root, root);
        DoubleDouble::fast(root, rest.high / (2.0 * root))
    }

    /// Returns the sine of the angle plus a number of quarter turns.
    fn circular(self, quarters: i64) -> DoubleDouble {
        if self.high.is_nan() || self.high.abs() > LARGEST_ANGLE {
            return DoubleDouble::exact(f64::NAN);
        }
        let turns = (self.high / HALF_PI[0]).round();
        let angle =
            HALF_PI.iter().fold(self, |rest, part| rest - DoubleDouble::product(turns, *part));
        let quarters = (turns as i64 + quarters).rem_euclid(4);
        let value = angle.series(quarters % 2 == 0, -1.0);
        if quarters >= 2 { -value } else { value }
    }

    /// x + σ x³/3! + x⁵/5! + … if `odd`, 1 + σ x²/2! + x⁴/4! + … otherwise; signs σᵏ.
    fn series(self, odd: bool, sign: f64) -> DoubleDouble {
        let square = self * self * DoubleDouble::exact(sign);
        let mut term = if odd { self } else { DoubleDouble::exact(1.0) };
        let mut sum = term;
        let mut order = if odd { 1.0 } else { 0.0 };
        for _ in 0..16 {
            term = term * square / DoubleDouble::exact((order + 1.0) * (order + 2.0));
            sum = sum + term;
            order += 2.0;
        }
        sum
    }

    /// Computes tanh of the argument halved to below 1/2, then doubles it by tanh 2x = 2 t / (1 + t²).
    fn tanh(self) -> DoubleDouble {
        if self.high.is_nan() || self.high.abs() > 40.0 {
            return DoubleDouble::exact(self.high.tanh());
        }
        let (mut x, mut halvings) = (self, 0);
        while x.high.abs() > 0.5 {
            x = x * DoubleDouble::exact(0.5);
            halvings += 1;
        }
        let mut value = x.series(true, 1.0) / x.series(false, 1.0);
        for _ in 0..halvings {
            let one = DoubleDouble::exact(1.0);
            value = (value + value) / (one + value * value);
        }
        value
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> DoubleDouble {
        DoubleDouble::exact(value)
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let (high, low) =
            (DoubleDouble::sum(self.high, other.high), DoubleDouble::sum(self.low, other.low));
        let partial = DoubleDouble::fast(high.high, high.low + low.high);
        DoubleDouble::fast(partial.high, partial.low + low.low)
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Neg for DoubleDouble {
    type Output = DoubleDouble;
    fn neg(self) -> DoubleDouble {
        DoubleDouble { high: -self.high, low: -self.low }
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let product = DoubleDouble::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        DoubleDouble::fast(product.high, product.low + cross)
    }
}

impl Div for DoubleDouble {
    type Output = DoubleDouble;
    fn div(self, other: DoubleDouble) -> DoubleDouble {
        let first = self.high / other.high;
        if !first.is_finite() || other.high.is_infinite() {
            return DoubleDouble::exact(first);
        }
        let rest = self - other * DoubleDouble::exact(first);
        let second = rest.high / other.high;
        let rest = rest - other * DoubleDouble::exact(second);
        let quotient = DoubleDouble::fast(first, second);
        quotient + DoubleDouble::exact(rest.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(text: &str) -> DoubleDouble {
        DoubleDouble::from_number(&Rational::from_decimal(text).unwrap().into())
    }

    /// Compares with a value of 40 digits from mathematical tables.
    #[track_caller]
    fn assert_close(value: DoubleDouble, digits: &str) {
        let error = value - decimal(digits);
        assert!(
            error.high.abs() <= 1e-30 * value.high.abs(),
            "{value:?} is no {digits}: {error:?}"
        );
    }

    #[test]
    fn values_have_thirty_digits() {
        let two = decimal("2");
        assert_close(two.apply(Function::Sqrt), "1.414213562373095048801688724209698078570");
        assert_close(DoubleDouble::PI, "3.141592653589793238462643383279502884197");
        assert_close(decimal("1") / decimal("3"), "0.3333333333333333333333333333333333333333");
        let one = decimal("1");
        assert_close(one.apply(Function::Sin), "0.8414709848078965066525023216302989996226");
        assert_close(one.apply(Function::Cos), "0.5403023058681397174009366074429766037323");
        assert_close(one.apply(Function::Tanh), "0.7615941559557648881194582826047935904128");
    }

    #[test]
    fn near_a_quarter_turn_the_remainder_is_exact() {
        // π/2 − 1.57079632679 to 40 digits, minus a sixth of its cube. The argument has 107 bits after
        // the point, and so does the difference.
        let cosine = decimal("1.57079632679").apply(Function::Cos);
        let error = cosine - decimal("4.896619231321691639751422530698e-12");
        assert!(error.high.abs() < 1e-32, "{error:?}");
        assert_eq!(cosine.to_f64(), 4.896619231321692e-12);
        let three_turns = decimal("3") * DoubleDouble::PI;
        assert!(three_turns.apply(Function::Sin).high.abs() < 1e-31);
        assert_eq!(three_turns.apply(Function::Cos).to_f64(), -1.0);
    }

    #[test]
    fn circular_functions_agree_with_the_library_to_one_unit() {
        for k in -400..400 {
            let x = DoubleDouble::exact(f64::from(k) * 0.037);
            for function in [Function::Sin, Function::Cos, Function::Tanh] {
                let (ours, theirs) = (x.apply(function).to_f64(), function.apply(x.high));
                assert!((ours - theirs).abs() <= 2.3e-16, "{function:?} {x:?}");
            }
        }
    }

    #[test]
    fn what_has_no_value_is_not_a_number_or_infinite() {
        assert!(decimal("-1").apply(Function::Sqrt).to_f64().is_nan());
        assert!(!(decimal("1") / DoubleDouble::ZERO).to_f64().is_finite());
        assert!(!(decimal("1e300") * decimal("1e300")).to_f64().is_finite());
        assert!(decimal("1e300").apply(Function::Sin).to_f64().is_nan());
    }
}
