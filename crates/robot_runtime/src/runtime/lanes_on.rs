//! Lanes in the registers of the current processor, for kernels.

use core::fmt;
use core::marker::PhantomData;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::lanewise::{
    Difference, Lanewise, Magnitude, MultiplyAdd, Negative, Product, Quotient,
    ReciprocalOfPositive, Sign, SineCosine, SquareRoot, Sum,
};
use super::processor::Arithmetic;
use super::real::Real;
use super::scalar::Scalar;

/// `N` numbers on which operations act lane by lane, in the registers of the processor of `A`;
/// [`Lanes`](super::Lanes) use those of the target.
///
/// With `ONCE`, multiply-adds and sines round once if `A` can; without it they have the same bits for every `A`.
pub struct LanesOn<A, T, const N: usize, const ONCE: bool>([T; N], PhantomData<fn() -> A>);

impl<A: Arithmetic, T: Real, const N: usize, const ONCE: bool> LanesOn<A, T, N, ONCE> {
    /// Puts element i into lane i.
    #[inline(always)]
    pub const fn from_array(values: [T; N]) -> Self {
        Self(values, PhantomData)
    }

    /// Returns the array whose element i is lane i.
    #[inline(always)]
    pub const fn to_array(self) -> [T; N] {
        self.0
    }

    #[inline(always)]
    fn lanewise<O: Lanewise<K, 1>, const K: usize>(arguments: [&[T; N]; K]) -> Self {
        let [lanes] = A::lanewise::<T, O, ONCE, K, 1, N>(arguments);
        Self::from_array(lanes)
    }
}

impl<A, T: Copy, const N: usize, const ONCE: bool> Clone for LanesOn<A, T, N, ONCE> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A, T: Copy, const N: usize, const ONCE: bool> Copy for LanesOn<A, T, N, ONCE> {}

impl<A, T: PartialEq, const N: usize, const ONCE: bool> PartialEq for LanesOn<A, T, N, ONCE> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<A, T: fmt::Debug, const N: usize, const ONCE: bool> fmt::Debug for LanesOn<A, T, N, ONCE> {
    #[inline]
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

// Operations are inlined only if debug assertions are off: without optimization, the temporaries of each inlined
// operation on registers take kilobytes of stack, and a long function would overflow it.

macro_rules! lane_by_lane {
    ($operator:ident, $method:ident, $operation:ident) => {
        impl<A: Arithmetic, T: Real, const N: usize, const ONCE: bool> $operator
            for LanesOn<A, T, N, ONCE>
        {
            type Output = Self;

            #[cfg_attr(debug_assertions, inline)]
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $method(self, other: Self) -> Self {
                Self::lanewise::<$operation, 2>([&self.0, &other.0])
            }
        }
    };
}

lane_by_lane!(Add, add, Sum);
lane_by_lane!(Sub, sub, Difference);
lane_by_lane!(Mul, mul, Product);
lane_by_lane!(Div, div, Quotient);

impl<A: Arithmetic, T: Real, const N: usize, const ONCE: bool> Neg for LanesOn<A, T, N, ONCE> {
    type Output = Self;

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self::lanewise::<Negative, 1>([&self.0])
    }
}

impl<A: Arithmetic, T: Real, const N: usize, const ONCE: bool> Scalar for LanesOn<A, T, N, ONCE> {
    const ZERO: Self = Self::from_array([T::ZERO; N]);
    const ONE: Self = Self::from_array([T::ONE; N]);

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_f64(value: f64) -> Self {
        Self::from_array([T::from_f64(value); N])
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self::lanewise::<MultiplyAdd, 3>([&self.0, &factor.0, &addend.0])
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sqrt(self) -> Self {
        Self::lanewise::<SquareRoot, 1>([&self.0])
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn abs(self) -> Self {
        Self::lanewise::<Magnitude, 1>([&self.0])
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn signum0(self) -> Self {
        Self::lanewise::<Sign, 1>([&self.0])
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tanh(self) -> Self {
        Self::from_array(self.0.map(T::tanh))
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn recip_positive(self) -> Self {
        Self::lanewise::<ReciprocalOfPositive, 1>([&self.0])
    }

    #[cfg_attr(debug_assertions, inline)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        let [sines, cosines] = A::lanewise::<T, SineCosine, ONCE, 1, 2, N>([&self.0]);
        (Self::from_array(sines), Self::from_array(cosines))
    }
}
