//! Sine and cosine in double precision.
//!
//! Method: Cody & Waite, *Software Manual for the Elementary Functions* (1980), chapter 8. The
//! angle x is brought to r = x − k·π/2 with k the integer nearest to 2x/π, |k| < 2³⁰, and π/2 held
//! in parts. If multiply-adds are [`FUSED`] these are three of 53 bits: the first step is exact,
//! the second rounds once. Elsewhere they are four: the first two have 23 bits, so that their
//! products with k are exact; the third has 36, its product is exact for |k| < 2¹⁷ and off by less
//! than 2⁻⁶⁹ beyond. What the last part gives is added to the sine alone, behind its polynomial,
//! where it keeps the last places next to multiples of π/2. On |r| ≤ π/4 sine and cosine are
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
//! Angles of |x| < 2³⁰ = 1 073 741 824 rad have a sine and a cosine, both within [−1, 1]; worst
//! error: see the table of the crate. From there on, and for the infinities and NaN, both are NaN,
//! by a mask of x's own bits. The sine of −0 is +0.

use super::super::fused::{FUSED, mul_add_f64};

/// Angles are of less than so many radians.
pub const LIMIT: f64 = 1073741824.0;

/// 1.5 · 2⁵²: added to a smaller number it leaves the nearest integer in the low bits of the sum.
const SHIFT: f64 = 6755399441055744.0;

/// Parts of π/2, each what the ones before leave.
const HALF_PI: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591698e-33];

/// π/2 in shorter parts, for multiply-adds that round twice.
const SHORT_HALF_PI: [f64; 4] =
    [1.570796251296997, 7.549790836947068e-08, -8.820551857060331e-15, 1.6446256936324258e-26];

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
    compute::<FUSED>(angle)
}

/// Sine and cosine of `angle` (radians) with multiply-adds that round twice on every target: the bits
/// of [`sin_cos`] if there is no [`FUSED`].
#[inline(always)]
pub fn portable_sin_cos(angle: f64) -> (f64, f64) {
    compute::<false>(angle)
}

#[inline(always)]
fn mul_add<const ONCE: bool>(a: f64, b: f64, c: f64) -> f64 {
    if ONCE { mul_add_f64(a, b, c) } else { a * b + c }
}

#[inline(always)]
fn compute<const ONCE: bool>(angle: f64) -> (f64, f64) {
    let shifted = mul_add::<ONCE>(angle, core::f64::consts::FRAC_2_PI, SHIFT);
    let (r, rest) = reduce::<ONCE>(nan_beyond_limit(angle), shifted - SHIFT);

    let z = r * r;
    let sine = r + mul_add::<ONCE>(r * z, polynomial::<ONCE>(&SINE, z), -rest);
    let cosine = mul_add::<ONCE>(z, polynomial::<ONCE>(&COSINE, z), -0.5);
    select(shifted.to_bits(), sine, mul_add::<ONCE>(z, cosine, 1.0))
}

/// `angle`, and NaN if it is not below the limit, by a mask that waits for nothing but the angle. The
/// sum's sign is the carry: LLVM turns what it sees to be a comparison into a jump.
#[inline(always)]
fn nan_beyond_limit(angle: f64) -> f64 {
    const SIGN: u64 = 1 << (u64::BITS - 1);
    let carried = angle.abs().to_bits().wrapping_add(SIGN - LIMIT.to_bits());
    let beyond = carried as i64 >> (u64::BITS - 1);
    f64::from_bits(angle.to_bits() | beyond as u64)
}

/// `angle` less `k` right angles, as a number less a rest that counts if the number is tiny.
#[inline(always)]
fn reduce<const ONCE: bool>(angle: f64, k: f64) -> (f64, f64) {
    if ONCE {
        let r = mul_add::<ONCE>(k, -HALF_PI[0], angle);
        return (mul_add::<ONCE>(k, -HALF_PI[1], r), k * HALF_PI[2]);
    }
    let r = mul_add::<ONCE>(k, -SHORT_HALF_PI[0], angle);
    let r = mul_add::<ONCE>(k, -SHORT_HALF_PI[1], r);
    (mul_add::<ONCE>(k, -SHORT_HALF_PI[2], r), k * SHORT_HALF_PI[3])
}

/// The coefficients' polynomial in Estrin's order, whose parts do not wait for each other.
#[inline(always)]
fn polynomial<const ONCE: bool>(c: &[f64; 6], z: f64) -> f64 {
    let z2 = z * z;
    let low = mul_add::<ONCE>(c[1], z, c[0]);
    let middle = mul_add::<ONCE>(c[3], z, c[2]);
    let high = mul_add::<ONCE>(c[5], z, c[4]);
    mul_add::<ONCE>(mul_add::<ONCE>(high, z2, middle), z2, low)
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
