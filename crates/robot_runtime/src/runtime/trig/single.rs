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

use super::super::fused::{FUSED, mul_add_f32 as mul_add};

/// Angles are of less than so many radians.
pub const LIMIT: f32 = 131072.0;

/// 1.5 · 2²³: added to a smaller number it leaves the nearest integer in the low bits of the sum.
const SHIFT: f32 = 12582912.0;

/// Parts of π/2, each what the ones before leave.
const HALF_PI: [f32; 4] = if FUSED {
    [1.5707964, -4.371139e-8, -1.7151245e-15, 0.0]
} else {
    [1.5625, 8.300781e-3, -4.4703484e-6, 1.5893255e-8]
};

const SINE: [f32; 3] = [-1.6666655e-1, 8.332188e-3, -1.9518078e-4];

const COSINE: [f32; 3] = [4.1666646e-2, -1.3887301e-3, 2.443067e-5];

/// Sine and cosine of `angle` (radians).
#[inline(always)]
pub fn sin_cos(angle: f32) -> (f32, f32) {
    let shifted = mul_add(angle, core::f32::consts::FRAC_2_PI, SHIFT);
    let r = reduce(nan_beyond_limit(angle), shifted - SHIFT);

    let z = r * r;
    let sine = mul_add(r * z, polynomial(&SINE, z), r);
    let cosine = mul_add(z, mul_add(z, polynomial(&COSINE, z), -0.5), 1.0);
    select(shifted.to_bits(), sine, cosine)
}

/// `angle`, and NaN if it is not below the limit, by a mask that waits for nothing but the angle. The
/// sum's sign is the carry: LLVM turns what it sees to be a comparison into a jump.
#[inline(always)]
fn nan_beyond_limit(angle: f32) -> f32 {
    const SIGN: u32 = 1 << (u32::BITS - 1);
    let carried = angle.abs().to_bits().wrapping_add(SIGN - LIMIT.to_bits());
    let beyond = carried as i32 >> (u32::BITS - 1);
    f32::from_bits(angle.to_bits() | beyond as u32)
}

/// `angle` less `k` right angles.
#[inline(always)]
fn reduce(angle: f32, k: f32) -> f32 {
    let r = mul_add(k, -HALF_PI[0], angle);
    let r = mul_add(k, -HALF_PI[1], r);
    let r = mul_add(k, -HALF_PI[2], r);
    if FUSED { r } else { mul_add(k, -HALF_PI[3], r) }
}

/// The coefficients' polynomial in Horner's order.
#[inline(always)]
fn polynomial(c: &[f32; 3], z: f32) -> f32 {
    mul_add(mul_add(c[2], z, c[1]), z, c[0])
}

/// Sine and cosine of r + k·π/2 from those of r; the low bits of `k` count.
#[inline(always)]
fn select(k: u32, sine: f32, cosine: f32) -> (f32, f32) {
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let swap = (sine ^ cosine) & (k & 1).wrapping_neg();
    let sine_sign = (k & 2) << 30;
    let cosine_sign = (k.wrapping_add(1) & 2) << 30;
    (f32::from_bits(sine ^ swap ^ sine_sign), f32::from_bits(cosine ^ swap ^ cosine_sign))
}
