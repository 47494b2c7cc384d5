//! Sine and cosine in double precision.
//!
//! Method: Cody & Waite, *Software Manual for the Elementary Functions* (1980), chapter 8. The
//! angle x is brought to r = x − k·π/2 with k the integer nearest to 2x/π; π/2 is held in three
//! parts, the first two of 37 bits, so that their products with |k| < 2¹⁶ are exact and r is good
//! to its last place even where it is tiny. On |r| ≤ π/4 sine and cosine are
//!
//! ```text
//! sin r = r + r³ S(r²)      relative error of the polynomial 3.8e-18
//! cos r = 1 − r²/2 + r⁴ C(r²)      absolute error of the polynomial 4.8e-20
//! ```
//!
//! with S and C of degree 5: the minimax polynomials under those two measures by Remez's exchange
//! in 300-bit arithmetic, their coefficients rounded to double one by one from the lowest, the
//! rest fitted anew after each. The two low bits of k select and sign the results by masks.
//!
//! Worst error over |x| ≤ 10⁵: see the table of the crate. Beyond, k·π/2 is no longer exact and
//! the error grows like that of an angle known to one unit in its last place; from 2⁵¹ on the
//! values mean nothing. They stay within [−1, 1] for every finite angle. NaN and the infinities
//! give NaN.

use super::super::fused::mul_add_f64 as mul_add;

/// 1.5 · 2⁵²: added to a smaller number it leaves the nearest integer in the low bits of the sum.
const SHIFT: f64 = 6755399441055744.0;

const HALF_PI_HIGH: f64 = 1.5707963267923333;
const HALF_PI_MIDDLE: f64 = 2.5633441515839558e-12;
const HALF_PI_LOW: f64 = 1.0562999066987428e-23;

const SINE: [f64; 6] = [
    -0.1666666666666663,
    0.00833333333332184,
    -0.00019841269829358525,
    2.7557313538512324e-06,
    -2.5050734388819435e-08,
    1.589543325649899e-10,
];

const COSINE: [f64; 6] = [
    0.0416666666666666,
    -0.0013888888888874474,
    2.480158728967154e-05,
    -2.7557314401032893e-07,
    2.0875729281739625e-09,
    -1.1359934279794189e-11,
];

/// Sine and cosine of `angle` (radians).
#[inline(always)]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    let shifted = mul_add(angle, core::f64::consts::FRAC_2_PI, SHIFT);
    let quarters = shifted - SHIFT;
    let reduced = mul_add(quarters, -HALF_PI_HIGH, angle);
    let reduced = mul_add(quarters, -HALF_PI_MIDDLE, reduced);
    let r = mul_add(quarters, -HALF_PI_LOW, reduced);

    let z = r * r;
    let sine = mul_add(r * z, polynomial(&SINE, z), r);
    let cosine = mul_add(z, mul_add(z, polynomial(&COSINE, z), -0.5), 1.0);
    select(shifted.to_bits(), sine, cosine)
}

/// The coefficients' polynomial in Estrin's order, whose parts do not wait for each other.
#[inline(always)]
fn polynomial(c: &[f64; 6], z: f64) -> f64 {
    let z2 = z * z;
    let low = mul_add(c[1], z, c[0]);
    let middle = mul_add(c[3], z, c[2]);
    let high = mul_add(c[5], z, c[4]);
    mul_add(mul_add(high, z2, middle), z2, low)
}

/// Sine and cosine of r + k·π/2 from those of r; the low bits of `k` count.
#[inline(always)]
fn select(k: u64, sine: f64, cosine: f64) -> (f64, f64) {
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let swap = (sine ^ cosine) & (k & 1).wrapping_neg();
    let sine_sign = (k & 2) << 62;
    let cosine_sign = (k.wrapping_add(1) & 2) << 62;
    (f64::from_bits(sine ^ swap ^ sine_sign), f64::from_bits(cosine ^ swap ^ cosine_sign))
}
