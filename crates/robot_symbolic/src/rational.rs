//! Exact rational numbers: machine words if they suffice, otherwise the big rationals of `dashu`.

use std::cmp::Ordering;
use std::fmt;

use dashu_base::{Approximation, BitTest, Sign};
use dashu_int::IBig;
use dashu_ratio::RBig;

/// The largest number of bits of a numerator or denominator that is kept exactly (see [`crate::Number`]): no reasonable
/// robot file needs more, and a hostile one must not fill the memory.
pub(crate) const MAX_BITS: usize = 8192;

/// The largest number of digits in decimal text: one of 8192 bits does not have more.
pub const MAX_DIGITS: usize = 2600;

/// An exact rational number in lowest terms.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

/// The representation. It is `Small` whenever numerator and denominator fit, so equal values have equal
/// representations.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Repr {
    Small {
        numerator: i64,
        denominator: i64,
    },
    /// A number beyond machine words, boxed because almost every number is small and terms are moved millions of times.
    Big(Box<RBig>),
}

impl Rational {
    /// The number 0.
    pub const ZERO: Rational = Rational::integer(0);
    /// The number 1.
    pub const ONE: Rational = Rational::integer(1);

    /// An integer.
    #[must_use]
    pub const fn integer(value: i64) -> Rational {
        Rational(Repr::Small { numerator: value, denominator: 1 })
    }

    /// `numerator / denominator`; `None` if the denominator is 0.
    #[must_use]
    pub fn new(numerator: i64, denominator: i64) -> Option<Rational> {
        (denominator != 0).then(|| reduce(i128::from(numerator), i128::from(denominator)))
    }

    /// The exact value of decimal text as in robot files: `12`, `-0.35`, `1.5e-3`.
    ///
    /// Returns `None` if the text is not a finite decimal number, is too long, or has an exponent beyond ±400, which no
    /// `f64` needs.
    #[must_use]
    pub fn from_decimal(text: &str) -> Option<Rational> {
        let text = text.replace('_', "");
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text.as_str(), 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let unsigned = whole.strip_prefix(['+', '-']).unwrap_or(whole);
        let digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
        let too_long = mantissa.len() > MAX_DIGITS || !(-400..=400).contains(&exponent);
        if !digits(unsigned)
            || !digits(fraction)
            || unsigned.len() + fraction.len() == 0
            || too_long
        {
            return None;
        }
        let numerator = IBig::from_str_radix(&format!("0{unsigned}{fraction}"), 10).ok()?;
        let scale = exponent - i32::try_from(fraction.len()).ok()?;
        let power = IBig::from(10).pow(usize::try_from(scale.unsigned_abs()).ok()?);
        let value = if scale >= 0 {
            RBig::from(numerator * power)
        } else {
            RBig::from_parts_signed(numerator, power)
        };
        Some(from_big(if whole.starts_with('-') { -value } else { value }))
    }

    /// The exact value of a finite `f64`; `None` for NaN and infinities.
    #[must_use]
    pub fn from_f64(value: f64) -> Option<Rational> {
        RBig::try_from(value).ok().map(from_big)
    }

    /// The nearest `f64`, ties to even.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            // Both are exact in an `f64` because they are below 2^53, so the division rounds only once.
            Repr::Small { numerator, denominator }
                if numerator.unsigned_abs() < 1 << 53 && *denominator < 1 << 53 =>
            {
                *numerator as f64 / *denominator as f64
            }
            _ => match self.to_big().to_f64() {
                Approximation::Exact(value) | Approximation::Inexact(value, _) => value,
            },
        }
    }

    /// `(numerator, denominator)` if both fit an `i64`.
    #[must_use]
    pub fn to_small(&self) -> Option<(i64, i64)> {
        match self.0 {
            Repr::Small { numerator, denominator } => Some((numerator, denominator)),
            Repr::Big(_) => None,
        }
    }

    /// Returns the value as an integer if it is one and fits an `i64`.
    #[must_use]
    pub fn to_integer(&self) -> Option<i64> {
        self.to_small().and_then(|(numerator, denominator)| (denominator == 1).then_some(numerator))
    }

    /// Numerator and denominator in decimal digits; the numerator carries the sign.
    #[must_use]
    pub fn to_digits(&self) -> (String, String) {
        match &self.0 {
            Repr::Small { numerator, denominator } => {
                (numerator.to_string(), denominator.to_string())
            }
            Repr::Big(big) => (big.numerator().to_string(), big.denominator().to_string()),
        }
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Rational {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// Whether the value is below 0.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small { numerator, .. } => *numerator < 0,
            Repr::Big(big) => big.sign() == Sign::Negative,
        }
    }

    /// Whether the value is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        *self == Rational::ZERO
    }

    /// Whether the value is 1.
    #[must_use]
    pub fn is_one(&self) -> bool {
        *self == Rational::ONE
    }

    /// `1 / self`; `None` for 0.
    #[must_use]
    pub fn recip(&self) -> Option<Rational> {
        match &self.0 {
            Repr::Small { numerator, denominator } => Rational::new(*denominator, *numerator),
            Repr::Big(big) => Some(from_big(RBig::ONE / big.as_ref())),
        }
    }

    /// The number of bits of the numerator or denominator, whichever is larger; 64 for machine words.
    pub(crate) fn bits(&self) -> usize {
        match &self.0 {
            Repr::Small { .. } => 64,
            Repr::Big(big) => big.numerator().bit_len().max(big.denominator().bit_len()),
        }
    }

    fn to_big(&self) -> RBig {
        match &self.0 {
            Repr::Small { numerator, denominator } => {
                RBig::from_parts_signed(IBig::from(*numerator), IBig::from(*denominator))
            }
            Repr::Big(big) => big.as_ref().clone(),
        }
    }

    /// Applies an operation to two integers, the most frequent case in polynomials. Returns `None` if a number is not
    /// an integer of one word or if the result does not fit one.
    #[inline]
    pub(crate) fn integers(
        &self,
        other: &Rational,
        operation: impl Fn(i64, i64) -> Option<i64>,
    ) -> Option<Rational> {
        match (&self.0, &other.0) {
            (
                Repr::Small { numerator: a, denominator: 1 },
                Repr::Small { numerator: b, denominator: 1 },
            ) => operation(*a, *b).filter(|result| *result != i64::MIN).map(Rational::integer),
            _ => None,
        }
    }

    fn combine(
        &self,
        other: &Rational,
        small: impl Fn(i128, i128, i128, i128) -> Option<(i128, i128)>,
        big: impl Fn(RBig, RBig) -> RBig,
    ) -> Rational {
        if let (
            Repr::Small { numerator: a, denominator: b },
            Repr::Small { numerator: c, denominator: d },
        ) = (&self.0, &other.0)
            && let Some((numerator, denominator)) =
                small(i128::from(*a), i128::from(*b), i128::from(*c), i128::from(*d))
        {
            return reduce(numerator, denominator);
        }
        from_big(big(self.to_big(), other.to_big()))
    }
}

/// Reduces the fraction to lowest terms with a positive denominator. `denominator` must not be 0.
fn reduce(numerator: i128, denominator: i128) -> Rational {
    let divisor = gcd(numerator.unsigned_abs(), denominator.unsigned_abs());
    // The divisor is at most |denominator| < 2^127, so the casts are exact.
    let divisor = if denominator < 0 { -(divisor as i128) } else { divisor as i128 };
    of_lowest(numerator / divisor, denominator / divisor)
}

/// The rational number with this numerator and positive denominator, which must have no common divisor.
fn of_lowest(numerator: i128, denominator: i128) -> Rational {
    match (i64::try_from(numerator), i64::try_from(denominator)) {
        // i64::MIN uses the big representation so that a negation never overflows.
        (Ok(numerator), Ok(denominator)) if numerator != i64::MIN => {
            Rational(Repr::Small { numerator, denominator })
        }
        _ => Rational(Repr::Big(Box::new(RBig::from_parts_signed(
            IBig::from(numerator),
            IBig::from(denominator),
        )))),
    }
}

/// The greatest common divisor of two `i64`, neither of which is `i64::MIN`. For 0 and a denominator, it is the
/// denominator.
fn common(a: i64, b: i64) -> i64 {
    let (mut x, mut y) = (a.abs(), b.abs());
    if x == 1 || y == 1 {
        return 1;
    }
    while y != 0 {
        (x, y) = (y, x % y);
    }
    x
}

/// The greatest common divisor; uses 64-bit arithmetic as soon as both numbers fit. Returns 1 for two zeros.
fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        if let (Ok(mut x), Ok(mut y)) = (u64::try_from(a), u64::try_from(b)) {
            while y != 0 {
                (x, y) = (y, x % y);
            }
            return u128::from(x);
        }
        (a, b) = (b, a % b);
    }
    a.max(1)
}

fn from_big(big: RBig) -> Rational {
    let small = i64::try_from(big.numerator().clone())
        .ok()
        .zip(i64::try_from(big.denominator().clone()).ok());
    match small {
        Some((numerator, denominator)) if numerator != i64::MIN => {
            Rational(Repr::Small { numerator, denominator })
        }
        _ => Rational(Repr::Big(Box::new(big))),
    }
}

impl std::ops::Add for &Rational {
    type Output = Rational;
    fn add(self, other: &Rational) -> Rational {
        let small = |a: i128, b: i128, c: i128, d: i128| {
            if b == d { Some((a + c, b)) } else { Some(((a * d).checked_add(c * b)?, b * d)) }
        };
        self.combine(other, small, |a, b| a + b)
    }
}

impl std::ops::Sub for &Rational {
    type Output = Rational;
    fn sub(self, other: &Rational) -> Rational {
        self + &-other
    }
}

impl std::ops::Mul for &Rational {
    type Output = Rational;
    fn mul(self, other: &Rational) -> Rational {
        let (
            Repr::Small { numerator: a, denominator: b },
            Repr::Small { numerator: c, denominator: d },
        ) = (&self.0, &other.0)
        else {
            return from_big(self.to_big() * other.to_big());
        };
        // Each factor is in lowest terms, so these two divisors are all that the products can have in common.
        let (left, right) = (common(*a, *d), common(*c, *b));
        let numerator = i128::from(a / left) * i128::from(c / right);
        let denominator = i128::from(b / right) * i128::from(d / left);
        of_lowest(numerator, denominator)
    }
}

impl std::ops::Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match &self.0 {
            Repr::Small { numerator, denominator } => {
                Rational(Repr::Small { numerator: -numerator, denominator: *denominator })
            }
            Repr::Big(big) => from_big(-big.as_ref().clone()),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Rational) -> Ordering {
        let difference = self - other;
        if difference.is_zero() {
            Ordering::Equal
        } else if difference.is_negative() {
            Ordering::Less
        } else {
            Ordering::Greater
        }
    }
}

/// Writes, for example, `7` or `-3/2`.
impl fmt::Display for Rational {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (numerator, denominator) = self.to_digits();
        if denominator == "1" {
            formatter.write_str(&numerator)
        } else {
            write!(formatter, "{numerator}/{denominator}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(text: &str) -> Rational {
        Rational::from_decimal(text).unwrap()
    }

    #[test]
    fn decimals_are_exact() {
        assert_eq!(decimal("0.35"), Rational::new(7, 20).unwrap());
        assert_eq!(decimal("-1.5e-3"), Rational::new(-3, 2000).unwrap());
        assert_eq!(decimal("1_000.0"), Rational::integer(1000));
        assert_eq!(&decimal("0.1") + &decimal("0.2"), decimal("0.3"));
        assert_eq!(decimal("0.010267495893").to_f64(), 0.010267495893);
        for text in ["", ".", "-", "nan", "inf", "1e999", "0x10", "1,5", "1.2.3", "--1"] {
            assert_eq!(Rational::from_decimal(text), None, "{text}");
        }
    }

    #[test]
    fn words_give_way_to_big_numbers_and_back() {
        let large = Rational::integer(i64::MAX);
        let square = &large * &large;
        assert!(square.to_small().is_none());
        assert_eq!(&square * &large.recip().unwrap(), large);
        assert_eq!(&(&square - &square) + &large, large);
        let least = &(-&large) - &Rational::ONE;
        assert_eq!(&-&least - &Rational::ONE, large);
        assert!(least < large);
    }

    #[test]
    fn a_float_survives_the_round_trip() {
        for value in [0.1, -2.5e-300, f64::MAX, f64::MIN_POSITIVE, 1.0 / 3.0] {
            assert_eq!(Rational::from_f64(value).unwrap().to_f64(), value);
        }
        assert_eq!(Rational::from_f64(f64::NAN), None);
    }

    #[test]
    fn fractions_with_denominator_zero_are_refused() {
        assert_eq!(Rational::new(1, 0), None);
        assert_eq!(Rational::ZERO.recip(), None);
        assert_eq!(Rational::new(-4, -6), Rational::new(2, 3));
    }
}
