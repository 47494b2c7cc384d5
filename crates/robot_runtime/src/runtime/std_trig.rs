//! Sine and cosine of the standard library.

extern crate std;

use super::lanes::Lanes;
use super::scalar::Scalar;
use super::trig::Trig;
use super::trig::block::one_by_one;

/// The sine and cosine of the standard library, which come from the platform: accurate for any angle, but not
/// branch-free, and with different bits on different platforms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StdTrig;

impl Trig<f64> for StdTrig {
    #[inline(always)]
    fn sin_cos(angle: f64) -> (f64, f64) {
        f64::sin_cos(angle)
    }

    #[inline(always)]
    fn sin_cos_array<const N: usize>(angles: &[f64; N]) -> ([f64; N], [f64; N]) {
        one_by_one(angles, f64::sin_cos)
    }
}

impl Trig<f32> for StdTrig {
    #[inline(always)]
    fn sin_cos(angle: f32) -> (f32, f32) {
        f32::sin_cos(angle)
    }

    #[inline(always)]
    fn sin_cos_array<const N: usize>(angles: &[f32; N]) -> ([f32; N], [f32; N]) {
        one_by_one(angles, f32::sin_cos)
    }
}

impl<T: Scalar, const L: usize> Trig<Lanes<T, L>> for StdTrig
where
    Self: Trig<T>,
{
    #[inline(always)]
    fn sin_cos(angle: Lanes<T, L>) -> (Lanes<T, L>, Lanes<T, L>) {
        let (sines, cosines) = <Self as Trig<T>>::sin_cos_array(&angle.to_array());
        (Lanes::from_array(sines), Lanes::from_array(cosines))
    }

    #[inline(always)]
    fn sin_cos_array<const N: usize>(
        angles: &[Lanes<T, L>; N],
    ) -> ([Lanes<T, L>; N], [Lanes<T, L>; N]) {
        one_by_one(angles, <Self as Trig<Lanes<T, L>>>::sin_cos)
    }
}

/// Sines and cosines of `angles` (radians) by the standard library; inlined
/// like [`sin_cos_array`](super::sin_cos_array).
#[cfg_attr(debug_assertions, inline(never))]
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn std_sin_cos_array<T: Scalar, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N])
where
    StdTrig: Trig<T>,
{
    StdTrig::sin_cos_array(angles)
}
