//! Sine and cosine in double precision.
//!
//! Method: Cody & Waite, *Software Manual for the Elementary Functions* (1980), chapter 8. The
//! angle x is reduced to r = x − k·π/2, where k is the integer nearest to 2x/π, |k| < 2³⁰, and π/2
//! is a sum of parts. If multiply-adds are [`FUSED`], there are three parts of 53 bits: the first step is
//! exact, the second rounds once. Otherwise there are four: the first two have 23 bits, so that their
//! products with k are exact; the third has 36 bits, and its product is exact for |k| < 2¹⁷ and has an error
//! of less than 2⁻⁶⁹ beyond. The term of the last part is added only to the sine, after its polynomial,
//! where it keeps the last places accurate close to multiples of π/2. For |r| ≤ π/4, sine and cosine are
//!
//! ```text
//! sin r = r + r³ S(r²)      relative error of the polynomial 3.8e-18
//! cos r = 1 − r²/2 + r⁴ C(r²)      absolute error of the polynomial 4.8e-20
//! ```
//!
//! with S and C of degree 5: the minimax polynomials for these two errors, computed by Remez's exchange
//! in 300-bit arithmetic. Their coefficients were rounded to double one by one from the lowest, and the
//! others were fitted again after each. The two low bits of k swap the results and set their signs by masks.
//!
//! Angles of |x| < 2³⁰ = 1 073 741 824 rad have a sine and a cosine, both within [−1, 1]; for the worst
//! error see the table in the crate's documentation. For larger angles, infinities and NaN, both are NaN,
//! by a mask of x's own bits. The sine of −0 is +0.

use super::super::fused::FUSED;
use super::super::number::Number;

/// The limit below which the absolute value of angles must be, in rad.
pub const LIMIT: f64 = 1073741824.0;

/// 1.5 · 2⁵²: if it is added to a number of at most 2⁵¹ in magnitude, the low bits of the sum are the nearest integer.
pub const SHIFT: f64 = 6755399441055744.0;

/// Parts of π/2; each is the rounded remainder after the parts before it.
pub const HALF_PI: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591698e-33];

/// π/2 in shorter parts, for multiply-adds that round twice.
pub const SHORT_HALF_PI: [f64; 4] =
    [1.570796251296997, 7.549790836947068e-08, -8.820551857060331e-15, 1.6446256936324258e-26];

/// The coefficients of S, from the lowest.
pub const SINE: [f64; 6] = [
    -0.1666666666666663,
    0.00833333333332184,
    -0.00019841269829358525,
    2.7557313538512324e-06,
    -2.5050734388819435e-08,
    1.589543325649899e-10,
];

/// The coefficients of C, from the lowest.
pub const COSINE: [f64; 6] = [
    0.0416666666666666,
    -0.0013888888888874474,
    2.480158728967154e-05,
    -2.7557314401032893e-07,
    2.0875729281739625e-09,
    -1.1359934279794189e-11,
];

/// Sine and cosine of `angle` (radians).
// Without optimization it is a function, so that what calls it has none of its checks.
#[cfg_attr(debug_assertions, inline)]
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    compute::<FUSED, _>(angle)
}

/// Sine and cosine of `angle` (radians) with multiply-adds that round twice on every target: the bits
/// of [`sin_cos`] without [`FUSED`].
#[inline(always)]
pub fn portable_sin_cos(angle: f64) -> (f64, f64) {
    compute::<false, _>(angle)
}

/// Sine and cosine of one angle or of several in lanes, with multiply-adds that round once if
/// `ONCE`.
#[inline(always)]
pub(in super::super) fn compute<const ONCE: bool, V: Number<f64>>(angle: V) -> (V, V) {
    let shift = V::splat(SHIFT);
    let shifted = angle.multiply_add::<ONCE>(V::splat(core::f64::consts::FRAC_2_PI), shift);
    let (r, rest) = reduce::<ONCE, V>(angle.nan_unless_below(LIMIT), shifted - shift);

    let z = r * r;
    let sine = r + (r * z).multiply_add::<ONCE>(polynomial::<ONCE, V>(&SINE, z), -rest);
    let cosine = z.multiply_add::<ONCE>(polynomial::<ONCE, V>(&COSINE, z), V::splat(-0.5));
    shifted.apply_quadrant(sine, z.multiply_add::<ONCE>(cosine, V::splat(1.0)))
}

/// `angle` minus `k` right angles, as a number minus a remainder that matters if the number is tiny.
#[inline(always)]
fn reduce<const ONCE: bool, V: Number<f64>>(angle: V, k: V) -> (V, V) {
    let less = |angle: V, part: f64| k.multiply_add::<ONCE>(V::splat(-part), angle);
    if ONCE {
        let r = less(less(angle, HALF_PI[0]), HALF_PI[1]);
        return (r, k * V::splat(HALF_PI[2]));
    }
    let r = less(less(angle, SHORT_HALF_PI[0]), SHORT_HALF_PI[1]);
    (less(r, SHORT_HALF_PI[2]), k * V::splat(SHORT_HALF_PI[3]))
}

/// The polynomial with these coefficients in Estrin's order, whose parts do not wait for each other.
#[inline(always)]
fn polynomial<const ONCE: bool, V: Number<f64>>(c: &[f64; 6], z: V) -> V {
    let pair = |low: f64, high: f64| V::splat(high).multiply_add::<ONCE>(z, V::splat(low));
    let z2 = z * z;
    let (low, middle, high) = (pair(c[0], c[1]), pair(c[2], c[3]), pair(c[4], c[5]));
    high.multiply_add::<ONCE>(z2, middle).multiply_add::<ONCE>(z2, low)
}
