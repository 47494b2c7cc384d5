//! Sine and cosine: the branch-free polynomials, and the choice of their source.

pub(crate) mod block;
pub mod double;
pub mod single;

use super::scalar::Scalar;

/// A source of sines and cosines, chosen by type: [`PolyTrig`], or with feature `std`
/// `StdTrig`.
pub trait Trig<T: Scalar> {
    /// Sine and cosine of an angle in radians.
    fn sin_cos(angle: T) -> (T, T);

    /// Sines and cosines of angles in radians, with the same values as for single angles.
    fn sin_cos_array<const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]);
}

/// The polynomials of [`double`] and [`single`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PolyTrig;

impl<T: Scalar> Trig<T> for PolyTrig {
    #[inline(always)]
    fn sin_cos(angle: T) -> (T, T) {
        angle.sin_cos()
    }

    #[inline(always)]
    fn sin_cos_array<const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
        T::sin_cos_array(angles)
    }
}

/// Sines and cosines of `angles` (radians) by the branch-free polynomials, several at a time in
/// vector registers; meant for one state.
///
/// Inlined if debug assertions are off; otherwise it is a call, so callers stay flat in both cases.
#[cfg_attr(debug_assertions, inline(never))]
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn sin_cos_array<T: Scalar, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    T::sin_cos_array(angles)
}

/// Sines and cosines of `angles` (radians), one after the other in straight-line code; meant for the
/// body of a loop over many states.
///
/// LLVM vectorizes such a loop across the states, even at `opt-level` 2, if its body is straight-line code and it
/// is in a function of its own that is not inlined, takes the states by reference as arrays (`&[[f64; N]; 8]`) and
/// returns an array. The values are those of [`sin_cos_array`].
#[inline(always)]
pub fn sin_cos_each<T: Scalar, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    block::unrolled(angles, T::sin_cos)
}
