//! Sine and cosine in single precision, without any operation in double precision.
//!
//! The method is that of [`double`](super::double) with |k| < 2¹⁷. If multiply-adds are
//! [`FUSED`], π/2 has three parts of 24 bits; otherwise it has four, of which the first three have at most 7
//! bits, so that their products with k are exact. S and C have degree 2 and polynomial errors of 4.0e-9
//! (relative, sine) and 1.1e-10 (absolute, cosine).
//!
//! Angles of |x| < 2¹⁷ = 131 072 rad have a sine and a cosine, both within [−1, 1]; for the worst error see
//! the table in the crate's documentation. For larger angles, infinities and NaN, both are NaN. In single
//! precision, an angle of 10⁵ rad is only accurate to 0.004 rad, which no sine can repair: count turns elsewhere.

use super::super::fused::FUSED;
use super::super::number::Number;

/// Angles must be smaller than this in magnitude, rad.
pub const LIMIT: f32 = 131072.0;

/// 1.5 · 2²³: if it is added to a smaller number, the low bits of the sum are the nearest integer.
pub const SHIFT: f32 = 12582912.0;

/// Parts of π/2; each is the rounded remainder after the parts before it.
pub const HALF_PI: [f32; 3] = [1.5707964, -4.371139e-8, -1.7151245e-15];

/// π/2 in shorter parts, for multiply-adds that round twice.
pub const SHORT_HALF_PI: [f32; 4] = [1.5625, 8.300781e-3, -4.4703484e-6, 1.5893255e-8];

/// The coefficients of S, from the lowest.
pub const SINE: [f32; 3] = [-1.6666655e-1, 8.332188e-3, -1.9518078e-4];

/// The coefficients of C, from the lowest.
pub const COSINE: [f32; 3] = [4.1666646e-2, -1.3887301e-3, 2.443067e-5];

/// Sine and cosine of `angle` (radians).
// Without optimization it is a function, so that what calls it has none of its checks.
#[cfg_attr(debug_assertions, inline)]
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn sin_cos(angle: f32) -> (f32, f32) {
    compute::<FUSED, _>(angle)
}

/// Sine and cosine of one angle or of several in lanes, with multiply-adds that round once if
/// `ONCE`.
#[inline(always)]
pub(in super::super) fn compute<const ONCE: bool, V: Number<f32>>(angle: V) -> (V, V) {
    let shift = V::splat(SHIFT);
    let shifted = angle.multiply_add::<ONCE>(V::splat(core::f32::consts::FRAC_2_PI), shift);
    let r = reduce::<ONCE, V>(angle.nan_unless_below(LIMIT), shifted - shift);

    let z = r * r;
    let sine = (r * z).multiply_add::<ONCE>(polynomial::<ONCE, V>(&SINE, z), r);
    let cosine = z.multiply_add::<ONCE>(polynomial::<ONCE, V>(&COSINE, z), V::splat(-0.5));
    shifted.apply_quadrant(sine, z.multiply_add::<ONCE>(cosine, V::splat(1.0)))
}

/// `angle` minus `k` right angles.
#[inline(always)]
fn reduce<const ONCE: bool, V: Number<f32>>(angle: V, k: V) -> V {
    let less = |angle: V, part: f32| k.multiply_add::<ONCE>(V::splat(-part), angle);
    if ONCE {
        return less(less(less(angle, HALF_PI[0]), HALF_PI[1]), HALF_PI[2]);
    }
    let r = less(less(angle, SHORT_HALF_PI[0]), SHORT_HALF_PI[1]);
    less(less(r, SHORT_HALF_PI[2]), SHORT_HALF_PI[3])
}

/// The polynomial with these coefficients in Horner's order.
#[inline(always)]
fn polynomial<const ONCE: bool, V: Number<f32>>(c: &[f32; 3], z: V) -> V {
    let high = V::splat(c[2]).multiply_add::<ONCE>(z, V::splat(c[1]));
    high.multiply_add::<ONCE>(z, V::splat(c[0]))
}
