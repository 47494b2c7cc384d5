//! Several numbers in lanes, which are computed at once.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::lanewise::{
    Difference, Lanewise, Magnitude, MultiplyAdd, Negative, Product, Quotient,
    ReciprocalOfPositive, Sign, SineCosine, SquareRoot, Sum,
};
use super::scalar::Scalar;

/// `N` numbers of type `T` on which every operation acts lane by lane.
///
/// The operations on this array use vector registers if `T` is `f64` or `f32` and `N` is a multiple of the numbers
/// that a register of the target holds: on x86-64 two `f64` or four `f32`, with AVX2 four or eight, with AVX-512
/// eight or sixteen; on 64-bit ARM two or four. Otherwise, and on other targets, they are loops of constant length,
/// which LLVM can vectorize.
///
/// To evaluate a function of numbers at many states, a loop over the states is equally fast, even at `opt-level` 2, and
/// needs no change to the function: see [`sin_cos_each`](super::sin_cos_each).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes<T, const N: usize>([T; N]);

/// Four `f64`: one 256-bit register.
pub type F64x4 = Lanes<f64, 4>;
/// Eight `f64`: one 512-bit register, or two of 256 bits.
pub type F64x8 = Lanes<f64, 8>;
/// Eight `f32`: one 256-bit register.
pub type F32x8 = Lanes<f32, 8>;
/// Sixteen `f32`: one 512-bit register, or two of 256 bits.
pub type F32x16 = Lanes<f32, 16>;

impl<T: Scalar, const N: usize> Lanes<T, N> {
    /// Puts the same number into every lane.
    #[inline(always)]
    pub const fn splat(value: T) -> Self {
        Self([value; N])
    }

    /// Puts element i into lane i.
    #[inline(always)]
    pub const fn from_array(values: [T; N]) -> Self {
        Self(values)
    }

    /// Returns the array whose element i is lane i.
    #[inline(always)]
    pub const fn to_array(self) -> [T; N] {
        self.0
    }

    /// The result of `function` for each lane.
    #[inline(always)]
    #[must_use]
    pub fn map(self, function: impl Fn(T) -> T) -> Self {
        let mut result = self;
        for lane in &mut result.0 {
            *lane = function(*lane);
        }
        result
    }

    #[inline(always)]
    fn lanewise<O: Lanewise<1, 1>>(self) -> Self {
        let [lanes] = T::lanewise::<O, 1, 1, N>([&self.0]);
        Self(lanes)
    }

    /// The result of `function` for each lane of `self` and the same lane of `other`.
    #[inline(always)]
    #[must_use]
    pub fn zip(self, other: Self, function: impl Fn(T, T) -> T) -> Self {
        let mut result = self;
        for (lane, other) in result.0.iter_mut().zip(&other.0) {
            *lane = function(*lane, *other);
        }
        result
    }
}

impl<T: Scalar, const N: usize> From<[T; N]> for Lanes<T, N> {
    #[inline(always)]
    fn from(values: [T; N]) -> Self {
        Self(values)
    }
}

impl<T: Scalar, const N: usize> From<Lanes<T, N>> for [T; N] {
    #[inline(always)]
    fn from(lanes: Lanes<T, N>) -> Self {
        lanes.0
    }
}

// Operations are inlined only if debug assertions are off: without optimization, the temporaries of each inlined
// operation on registers take kilobytes of stack, and a long function would overflow it.

macro_rules! lane_by_lane {
    ($operator:ident, $method:ident, $operation:ident) => {
        impl<T: Scalar, const N: usize> $operator for Lanes<T, N> {
            type Output = Self;

            #[cfg_attr(debug_assertions, inline)]
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $method(self, other: Self) -> Self {
                let [lanes] = T::lanewise::<$operation, 2, 1, N>([&self.0, &other.0]);
                Self(lanes)
            }
        }
    };
}

lane_by_lane!(Add, add, Sum);
lane_by_lane!(Sub, sub, Difference);
lane_by_lane!(Mul, mul, Product);
lane_by_lane!(Div, div, Quotient);

impl<T: Scalar, const N: usize> Neg for Lanes<T, N> {
    type Output = Self;

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        self.lanewise::<Negative>()
    }
}

impl<T: Scalar, const N: usize> Scalar for Lanes<T, N> {
    const ZERO: Self = Self([T::ZERO; N]);
    const ONE: Self = Self([T::ONE; N]);

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_f64(value: f64) -> Self {
        Self::splat(T::from_f64(value))
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        let arguments = [&self.0, &factor.0, &addend.0];
        let [lanes] = T::lanewise::<MultiplyAdd, 3, 1, N>(arguments);
        Self(lanes)
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sqrt(self) -> Self {
        self.lanewise::<SquareRoot>()
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn abs(self) -> Self {
        self.lanewise::<Magnitude>()
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn signum0(self) -> Self {
        self.lanewise::<Sign>()
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tanh(self) -> Self {
        self.map(T::tanh)
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn recip_positive(self) -> Self {
        self.lanewise::<ReciprocalOfPositive>()
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        let [sines, cosines] = T::lanewise::<SineCosine, 1, 2, N>([&self.0]);
        (Self(sines), Self(cosines))
    }
}
