//! The substitute for the standard library's sine and cosine without feature `std`: items that cannot be called,
//! so that the error message of the compiler names the missing feature.

use super::scalar::Scalar;
use super::trig::Trig;

/// A placeholder for the sine and cosine of the standard library, which do not exist without feature `std`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StdTrig;

/// Numbers with the sines and cosines of the standard library; without feature `std` there are none.
#[diagnostic::on_unimplemented(
    message = "sines and cosines of the standard library need the feature `std` of `robot_runtime`",
    label = "there is no sine of `{Self}` without the feature",
    note = "either enable it: robot_runtime = {{ …, features = [\"std\"] }} (in a generated crate: its own feature `std`)",
    note = "or generate the code with the runtime's polynomials: \
        `.trigonometry(Trigonometry::Polynomial)` in the builder, `trigonometry = \
        \"polynomial\"` in the macro, the option `trigonometry` of the command"
)]
pub trait FeatureStd: Scalar {
    /// Sine and cosine.
    fn std_sin_cos(self) -> (Self, Self);
}

impl<T: FeatureStd> Trig<T> for StdTrig {
    fn sin_cos(angle: T) -> (T, T) {
        angle.std_sin_cos()
    }

    fn sin_cos_array<const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
        let pairs = angles.map(T::std_sin_cos);
        (pairs.map(|(sine, _)| sine), pairs.map(|(_, cosine)| cosine))
    }
}

/// Sines and cosines of `angles` by the standard library; cannot be called without feature `std`.
pub fn std_sin_cos_array<T: Scalar, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N])
where
    StdTrig: Trig<T>,
{
    StdTrig::sin_cos_array(angles)
}
