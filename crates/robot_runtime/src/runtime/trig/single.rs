//! Sine and cosine in single precision, without a single double-precision operation.
//!
//! The method is that of [`double`](super::double) with |k| < 2¹⁷: if multiply-adds are
//! [`FUSED`], π/2 in three parts of 24 bits; elsewhere in four, the first three of at most 7 bits,
//! exact in products with k. S and C are of degree 2 with polynomial errors 4.0e-9 (relative, sine)
//! and 1.1e-10 (absolute, cosine).
//!
//! Angles of |x| < 2¹⁷ = 131 072 rad have a sine and a cosine, both within [−1, 1]; worst error: see
//! the table of the crate. From there on, and for the infinities and NaN, both are NaN. Single
//! precision holds an angle of 10⁵ rad to 0.004 rad, which no sine mends: count turns elsewhere.

use super::super::fused::FUSED;
use super::super::number::Number;

/// The limit of the absolute value of angles, rad.
pub const LIMIT: f32 = 131072.0;

/// 1.5 · 2²³: added to a smaller number it leaves the nearest integer in the low bits of the sum.
pub const SHIFT: f32 = 12582912.0;

/// Parts of π/2; each is the remainder of the preceding ones.
pub const HALF_PI: [f32; 3] = [1.5707964, -4.371139e-8, -1.7151245e-15];

/// π/2 in shorter parts, for multiply-adds that round twice.
pub const SHORT_HALF_PI: [f32; 4] = [1.5625, 8.300781e-3, -4.4703484e-6, 1.5893255e-8];

/// The coefficients of S, from the lowest.
pub const SINE: [f32; 3] = [-1.6666655e-1, 8.332188e-3, -1.9518078e-4];

/// The coefficients of C, from the lowest.
pub const COSINE: [f32; 3] = [4.1666646e-2, -1.3887301e-3, 2.443067e-5];

/// Sine and cosine of `angle` (radians).
#[inline(always)]
pub fn sin_cos(angle: f32) -> (f32, f32) {
    compute::<FUSED, _>(angle)
}

/// Sine and cosine of one angle or of several side by side, with multiply-adds that round once if
/// `ONCE`.
#[inline(always)]
pub(in super::super) fn compute<const ONCE: bool, V: Number<f32>>(angle: V) -> (V, V) {
    let shift = V::splat(SHIFT);
    let shifted = angle.multiply_add::<ONCE>(V::splat(core::f32::consts::FRAC_2_PI), shift);
    let r = reduce::<ONCE, V>(angle.nan_unless_below(LIMIT), shifted - shift);

    let z = r * r;
    let sine = (r * z).multiply_add::<ONCE>(polynomial::<ONCE, V>(&SINE, z), r);
    let cosine = z.multiply_add::<ONCE>(polynomial::<ONCE, V>(&COSINE, z), V::splat(-0.5));
    shifted.turned(sine, z.multiply_add::<ONCE>(cosine, V::splat(1.0)))
}

/// `angle` less `k` right angles.
#[inline(always)]
fn reduce<const ONCE: bool, V: Number<f32>>(angle: V, k: V) -> V {
    let less = |angle: V, part: f32| k.multiply_add::<ONCE>(V::splat(-part), angle);
    if ONCE {
        return less(less(less(angle, HALF_PI[0]), HALF_PI[1]), HALF_PI[2]);
    }
    let r = less(less(angle, SHORT_HALF_PI[0]), SHORT_HALF_PI[1]);
    less(less(r, SHORT_HALF_PI[2]), SHORT_HALF_PI[3])
}

/// The coefficients' polynomial in Horner's order.
#[inline(always)]
fn polynomial<const ONCE: bool, V: Number<f32>>(c: &[f32; 3], z: V) -> V {
    let high = V::splat(c[2]).multiply_add::<ONCE>(z, V::splat(c[1]));
    high.multiply_add::<ONCE>(z, V::splat(c[0]))
}
