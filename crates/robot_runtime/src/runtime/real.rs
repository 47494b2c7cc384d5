//! Floating-point numbers, with operations for processors that have been queried.

#![allow(unsafe_code)]

use super::lanewise::Lanewise;
use super::number::Number;
#[cfg(target_arch = "x86_64")]
use super::registers;
use super::scalar::Scalar;
use super::trig::{block, double, single};

/// `f64` or `f32`.
pub trait Real: Scalar + sealed::Sealed + 'static {
    /// An array of zeros with static lifetime.
    #[doc(hidden)]
    fn zeros<const W: usize>() -> &'static [Self; W];

    /// `a · b + c` with one rounding.
    ///
    /// # Safety
    ///
    /// The processor must have fused multiply-adds. If the calling code is not compiled for them, this is a call
    /// of a software function.
    #[doc(hidden)]
    unsafe fn mul_add_once(a: Self, b: Self, c: Self) -> Self;

    /// Sines and cosines of `angles` with such multiply-adds, in registers of 256 bits.
    ///
    /// # Safety
    ///
    /// The processor must have fused multiply-adds and, if it is an x86-64, AVX2.
    #[doc(hidden)]
    unsafe fn sin_cos_array_once<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]);

    /// Sines and cosines of `angles` with such multiply-adds, one after the other.
    ///
    /// # Safety
    ///
    /// The processor must have fused multiply-adds.
    #[doc(hidden)]
    unsafe fn sin_cos_each_once<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]);

    /// An operation on each lane of arrays, in registers of up to 256 bits that `N` numbers fill; rounds once if
    /// `ONCE`.
    ///
    /// # Safety
    ///
    /// The processor must have fused multiply-adds and, if it is an x86-64, AVX2.
    #[doc(hidden)]
    unsafe fn lanewise_asked<
        O: Lanewise<K, R>,
        const ONCE: bool,
        const K: usize,
        const R: usize,
        const N: usize,
    >(
        arguments: [&[Self; N]; K],
    ) -> [[Self; N]; R];
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! implement_real {
    ($float:ident, $polynomials:ident, $asked:ident) => {
        impl sealed::Sealed for $float {}

        impl Real for $float {
            #[inline(always)]
            fn zeros<const W: usize>() -> &'static [Self; W] {
                &[0.0; W]
            }

            #[inline(always)]
            unsafe fn mul_add_once(a: Self, b: Self, c: Self) -> Self {
                a.multiply_add::<true>(b, c)
            }

            #[inline(always)]
            unsafe fn sin_cos_array_once<const N: usize>(
                angles: &[Self; N],
            ) -> ([Self; N], [Self; N]) {
                #[cfg(target_arch = "x86_64")]
                return super::registers::x86::$polynomials::<true, N>(angles);
                #[cfg(not(target_arch = "x86_64"))]
                block::unrolled(angles, $polynomials::compute::<true, Self>)
            }

            #[inline(always)]
            unsafe fn sin_cos_each_once<const N: usize>(
                angles: &[Self; N],
            ) -> ([Self; N], [Self; N]) {
                block::unrolled(angles, $polynomials::compute::<true, Self>)
            }

            #[inline(always)]
            unsafe fn lanewise_asked<
                O: Lanewise<K, R>,
                const ONCE: bool,
                const K: usize,
                const R: usize,
                const N: usize,
            >(
                arguments: [&[Self; N]; K],
            ) -> [[Self; N]; R] {
                #[cfg(target_arch = "x86_64")]
                return registers::$asked::<O, ONCE, K, R, N>(arguments);
                #[cfg(not(target_arch = "x86_64"))]
                Self::lanewise::<O, K, R, N>(arguments)
            }
        }
    };
}

implement_real!(f64, double, asked_f64);
implement_real!(f32, single, asked_f32);
