//! The numbers that a model stores, as those that a function computes with.

use super::lanes::Lanes;
use super::scalar::Scalar;

/// A field of a generated `Model<P>`, in functions over the scalar `T`.
///
/// One number, `f64` or `f32`, is the same in every lane. [`Lanes`] have a number for each lane, so that the
/// parameters of a robot differ between the lanes. A scalar of one's own implements it for itself if models are
/// to store it.
#[diagnostic::on_unimplemented(
    message = "a model that stores `{Self}` does not compute with `{T}`",
    label = "states are of the type that the model stores, or the model stores `f64` or `f32`"
)]
pub trait Field<T: Scalar>: Copy {
    /// The number as a `T`.
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
