//! The operations on numbers, or on registers of numbers, that the polynomials of sine and cosine need.

use core::ops::{Add, Mul, Neg, Sub};

use super::fused::{once_f32, once_f64};

/// A number of type `F`, or several in lanes.
pub(super) trait Number<F>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Puts the number into every lane.
    fn splat(value: F) -> Self;

    /// `self · factor + addend`, rounded once if `ONCE`, which requires an instruction for it.
    fn multiply_add<const ONCE: bool>(self, factor: Self, addend: Self) -> Self;

    /// `self`, or NaN in lanes in which its magnitude is not below `limit`.
    fn nan_unless_below(self, limit: F) -> Self;

    /// Sine and cosine of r + k·π/2 from those of r; the low bits of `self` are those of k.
    fn turned(self, sine: Self, cosine: Self) -> (Self, Self);
}

macro_rules! implement_number {
    ($float:ident, $bits:ident, $integer:ident, $once:path) => {
        impl Number<$float> for $float {
            #[inline(always)]
            fn splat(value: $float) -> Self {
                value
            }

            #[inline(always)]
            fn multiply_add<const ONCE: bool>(self, factor: Self, addend: Self) -> Self {
                if ONCE {
                    return $once(self, factor, addend);
                }
                self * factor + addend
            }

            // Uses a mask that depends only on the angle. The sign of the integer sum is the carry: LLVM would
            // turn a comparison that it recognizes into a jump.
            #[inline(always)]
            fn nan_unless_below(self, limit: $float) -> Self {
                const SIGN: $bits = 1 << ($bits::BITS - 1);
                let carried = self.abs().to_bits().wrapping_add(SIGN - limit.to_bits());
                let beyond = carried as $integer >> ($bits::BITS - 1);
                $float::from_bits(self.to_bits() | beyond as $bits)
            }

            #[inline(always)]
            fn turned(self, sine: Self, cosine: Self) -> (Self, Self) {
                const TO_SIGN: u32 = $bits::BITS - 2;
                let (k, sine, cosine) = (self.to_bits(), sine.to_bits(), cosine.to_bits());
                let swap = (sine ^ cosine) & (k & 1).wrapping_neg();
                let sine_sign = (k & 2) << TO_SIGN;
                let cosine_sign = (k.wrapping_add(1) & 2) << TO_SIGN;
                (
                    $float::from_bits(sine ^ swap ^ sine_sign),
                    $float::from_bits(cosine ^ swap ^ cosine_sign),
                )
            }
        }
    };
}

implement_number!(f64, u64, i64, once_f64);
implement_number!(f32, u32, i32, once_f32);
