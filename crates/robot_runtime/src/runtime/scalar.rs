//! The number type with which generated code computes.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::fused::{mul_add_f32, mul_add_f64};
use super::lanewise::{self, Lanewise};
use super::reciprocal::{recip_positive_f32, recip_positive_f64};
use super::registers;
use super::root::{sqrt_f32, sqrt_f64};
use super::tanh::{tanh_f32, tanh_f64};
use super::trig::{block, double, single};

/// A real number, or several in lanes: `f64`, `f32` and
/// [`Lanes`](super::Lanes) of either.
///
/// No method branches on the value, allocates or panics; a NaN argument gives a NaN result.
///
/// With the standard library, `f64` and `f32` have inherent methods `mul_add`, `sqrt`, `tanh` and
/// `sin_cos`, and method syntax on these two types calls those. Code that is
/// not generic must call the trait by path: `Scalar::mul_add(a, b, c)`.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number 0.
    const ZERO: Self;
    /// The number 1.
    const ONE: Self;

    /// The number of this type nearest to `value`, in all lanes.
    fn from_f64(value: f64) -> Self;

    /// `self · factor + addend`, rounded once if the target has the instruction
    /// ([`FUSED`](super::FUSED)), otherwise twice; never by slow software emulation. In lanes, the instruction set for
    /// which the lanes are compiled decides.
    #[must_use]
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// Square root, correctly rounded with feature `std`, otherwise with an error of at most 0.51 units in the last
    /// place; √−0 = −0, and NaN for a number below zero.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// The sign with sgn 0 = 0: −1, 0 or 1, and NaN for NaN. This is the sign in the law of dry friction.
    #[must_use]
    fn signum0(self) -> Self;

    /// Hyperbolic tangent, the smooth sign: within 3 units in the last place everywhere.
    #[must_use]
    fn tanh(self) -> Self;

    /// 1/x if x is above 0 and finite, otherwise NaN. For divisors that are positive unless there is an error, so that
    /// the error does not go unnoticed.
    #[must_use]
    fn recip_positive(self) -> Self;

    /// Sine and cosine of an angle in radians by branch-free polynomials. See [`double`] and [`single`] for the range
    /// and the worst error.
    fn sin_cos(self) -> (Self, Self);

    /// Sines and cosines of all angles (radians), with the same values as [`Scalar::sin_cos`] of each
    /// angle; `f64` and `f32` compute eight at a time in vector registers.
    #[inline(always)]
    fn sin_cos_array<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
        block::one_by_one(angles, Self::sin_cos)
    }

    /// An operation on each lane of arrays; `f64` and `f32` compute it in vector registers if the
    /// target has them.
    #[doc(hidden)]
    #[inline(always)]
    fn lanewise<O: Lanewise<A, R>, const A: usize, const R: usize, const N: usize>(
        arguments: [&[Self; N]; A],
    ) -> [[Self; N]; R] {
        lanewise::one_by_one::<Self, O, A, R, N>(arguments)
    }
}

macro_rules! implement_scalar {
    (
        $float:ident,
        $bits:ident,
        $mul_add:path,
        $sqrt:path,
        $tanh:path,
        $recip_positive:path,
        $sin_cos:path,
        $polynomials:ident,
        $block:literal
    ) => {
        impl Scalar for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as Self
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                $mul_add(self, factor, addend)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <$float>::abs(self)
            }

            #[inline(always)]
            fn signum0(self) -> Self {
                const SIGN: $bits = 1 << ($bits::BITS - 1);
                let keep_if = |condition: bool| $bits::from(condition).wrapping_neg();
                let unit = self.to_bits() & SIGN | Self::ONE.to_bits();
                // A NaN with the bits of 1 also set is still NaN.
                let nan = self.to_bits() & keep_if(self.is_nan());
                <$float>::from_bits(unit & keep_if(self != 0.0) | nan)
            }

            #[inline(always)]
            fn tanh(self) -> Self {
                $tanh(self)
            }

            #[inline(always)]
            fn recip_positive(self) -> Self {
                $recip_positive(self)
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }

            #[inline(always)]
            fn sin_cos_array<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
                #[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
                if 1 < N && N <= 2 * $block {
                    return registers::x86::$polynomials::<{ super::FUSED }, N>(angles);
                }
                block::in_blocks::<$block, _, N>(angles, $sin_cos)
            }

            #[inline(always)]
            fn lanewise<O: Lanewise<A, R>, const A: usize, const R: usize, const N: usize>(
                arguments: [&[Self; N]; A],
            ) -> [[Self; N]; R] {
                registers::$float::<O, A, R, N>(arguments)
            }
        }
    };
}

implement_scalar!(
    f64,
    u64,
    mul_add_f64,
    sqrt_f64,
    tanh_f64,
    recip_positive_f64,
    double::sin_cos,
    double,
    8
);
implement_scalar!(
    f32,
    u32,
    mul_add_f32,
    sqrt_f32,
    tanh_f32,
    recip_positive_f32,
    single::sin_cos,
    single,
    16
);
