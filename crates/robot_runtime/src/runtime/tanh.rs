//! Hyperbolic tangent without branches.
//!
//! With y = 2|x| and t = eʸ − 1, tanh x = ± t / (t + 2). As in Cody & Waite's exponential,
//! y = r + n ln 2 with |r| ≤ ½ ln 2, and t = 2ⁿ (eʳ − 1) + (2ⁿ − 1), where
//!
//! ```text
//! eʳ − 1 = r + r² E(r)
//! ```
//!
//! with E the minimax polynomial of the relative error by Remez's exchange: degree 9 and 3.1e-17
//! in double precision, degree 4 and 1.8e-8 in single; coefficients from the highest down.

use super::fused::{mul_add_f32, mul_add_f64};

/// The constants of the method, for other languages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tanh<F: 'static> {
    /// 1.5 · 2⁵² or 1.5 · 2²³: if it is added to a smaller number, the low bits of the sum are the nearest integer.
    pub shift: F,
    /// The value of 2|x| from which the result rounds to 1.
    pub saturated: F,
    /// ln 2 as a sum of two parts.
    pub ln_2: [F; 2],
    /// The coefficients of E, from the highest.
    pub exponential: &'static [F],
}

macro_rules! tanh {
    (
        $name:ident, $numbers:ident, $float:ident, $bits:ident, $mul_add:ident,
        shift = $shift:expr, saturated = $saturated:expr,
        ln_2_high = $ln_2_high:expr, ln_2_low = $ln_2_low:expr,
        exponential = [$($coefficient:literal)*]
    ) => {
        /// The constants of the hyperbolic tangent.
        pub const $numbers: Tanh<$float> = Tanh {
            shift: $shift,
            saturated: $saturated,
            ln_2: [$ln_2_high, $ln_2_low],
            exponential: &[$($coefficient),*],
        };

        /// Hyperbolic tangent of `x`: within 3 units in the last place everywhere, ±1 at ±∞.
        #[inline(always)]
        pub(super) fn $name(x: $float) -> $float {
            let twice = 2.0 * x.abs();
            // From this value on the result rounds to 1; NaN is kept.
            let limit: $float = $saturated;
            let beyond = $bits::from(twice > limit).wrapping_neg();
            let y = $float::from_bits(limit.to_bits() & beyond | twice.to_bits() & !beyond);

            let shifted = $mul_add(y, core::$float::consts::LOG2_E, $shift);
            let n = shifted - $shift;
            let r = $mul_add(n, -$ln_2_high, y);
            let r = $mul_add(n, -$ln_2_low, r);
            let mut e = 0.0;
            $(e = $mul_add(e, r, $coefficient);)*
            let e = $mul_add(r * r, e, r);

            const MANTISSA: u32 = $float::MANTISSA_DIGITS - 1;
            let exponent = shifted.to_bits() << MANTISSA;
            let power = $float::from_bits(exponent.wrapping_add($float::to_bits(1.0)));
            let t = $mul_add(power, e, power - 1.0);
            (t / (t + 2.0)).copysign(x)
        }
    };
}

tanh!(
    tanh_f64, TANH_F64, f64, u64, mul_add_f64,
    shift = 6755399441055744.0, saturated = 44.0,
    ln_2_high = 0.6931471805598903, ln_2_low = 5.497923018708371e-14,
    exponential = [
        2.5054284888318235e-08
        2.7626049303148893e-07
        2.755740620773172e-06
        2.4801505245959435e-05
        0.00019841269720196315
        0.001388888893158733
        0.008333333333389141
        0.04166666666657669
        0.1666666666666659
        0.5000000000000006
    ]
);
tanh!(
    tanh_f32, TANH_F32, f32, u32, mul_add_f32,
    shift = 12582912.0, saturated = 20.0,
    ln_2_high = 0.69314575, ln_2_low = 1.4286068e-6,
    exponential = [1.388279e-3 8.366525e-3 4.1667197e-2 1.6666543e-1 4.9999997e-1]
);
