//! Sine and cosine in single precision, without a single double-precision operation.
//!
//! The method is that of [`double`](super::double): π/2 in three parts, the first two of 11 bits,
//! exact in products with |k| < 2¹³; S and C of degree 2 with polynomial errors 4.0e-9 (relative,
//! sine) and 1.1e-10 (absolute, cosine).
//!
//! Worst error over |x| ≤ 10⁴: see the table of the crate. Beyond, the error grows with the angle;
//! from 2²² on the values mean nothing. They stay within [−1, 1] for every finite angle. NaN and
//! the infinities give NaN.

use super::super::fused::mul_add_f32 as mul_add;

/// 1.5 · 2²³: added to a smaller number it leaves the nearest integer in the low bits of the sum.
const SHIFT: f32 = 12582912.0;

const HALF_PI_HIGH: f32 = 1.5703125;
const HALF_PI_MIDDLE: f32 = 4.837513e-4;
const HALF_PI_LOW: f32 = 7.54979e-8;

const SINE: [f32; 3] = [-1.6666655e-1, 8.332188e-3, -1.9518078e-4];

const COSINE: [f32; 3] = [4.1666646e-2, -1.3887301e-3, 2.443067e-5];

/// Sine and cosine of `angle` (radians).
#[inline(always)]
pub fn sin_cos(angle: f32) -> (f32, f32) {
    let shifted = mul_add(angle, core::f32::consts::FRAC_2_PI, SHIFT);
    let quarters = shifted - SHIFT;
    let reduced = mul_add(quarters, -HALF_PI_HIGH, angle);
    let reduced = mul_add(quarters, -HALF_PI_MIDDLE, reduced);
    let r = mul_add(quarters, -HALF_PI_LOW, reduced);

    let z = r * r;
    let sine = mul_add(r * z, polynomial(&SINE, z), r);
    let cosine = mul_add(z, mul_add(z, polynomial(&COSINE, z), -0.5), 1.0);
    select(shifted.to_bits(), sine, cosine)
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
