//! Conversion of the numbers that a model stores to the scalars with which a function computes.

use super::lanes::Lanes;
use super::scalar::Scalar;

/// A field of a generated `Model<P>`, in functions over the scalar `T`.
///
/// A single number, `f64` or `f32`, is the same in every lane. [`Lanes`] have a number for each lane, so that each lane
/// can have its own parameters of the robot. A scalar type defined elsewhere implements this trait for itself if
/// models are to store it.
#[diagnostic::on_unimplemented(
    message = "a model that stores `{Self}` does not compute with `{T}`",
    label = "states are of the type that the model stores, or the model stores `f64` or `f32`"
)]
pub trait Field<T: Scalar>: Copy {
    /// Converts the number to a `T`.
    fn broadcast(self) -> T;
}

impl<T: Scalar> Field<T> for f64 {
    #[inline(always)]
    fn broadcast(self) -> T {
        T::from_f64(self)
    }
}

impl<T: Scalar> Field<T> for f32 {
    #[inline(always)]
    fn broadcast(self) -> T {
        T::from_f64(self.into())
    }
}

impl<T: Scalar, const N: usize> Field<Lanes<T, N>> for Lanes<T, N> {
    #[inline(always)]
    fn broadcast(self) -> Lanes<T, N> {
        self
    }
}
