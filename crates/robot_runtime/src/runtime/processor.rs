//! Code that is compiled for several processors in one program, and the choice between them at run time.
//!
//! A program for any x86-64 can use neither fused multiply-adds nor registers of 256 bits, and loses half of its
//! speed. [`dispatch`] runs a [`Kernel`] that is compiled for the current processor, with feature `std` on
//! x86-64, unless the whole program is compiled for such processors anyway.

#![allow(unsafe_code)]

use super::lanewise::Lanewise;
use super::real::Real;

/// A computation that is compiled for several processors. It is `Copy`, so nothing needs to be dropped.
pub trait Kernel: Copy {
    /// The result.
    type Output;

    /// The computation. It must be `#[inline(always)]`; otherwise it is compiled for the oldest processor only. Only
    /// the multiply-adds and sines of `A` can round once.
    fn run<A: Arithmetic>(self) -> Self::Output;
}

/// The arithmetic of a kernel on one kind of processor; [`Compiled`] if the kernel is not dispatched.
pub trait Arithmetic: sealed::Sealed {
    /// `a · b + c`, in one instruction with one rounding if the processor has it.
    fn mul_add<T: Real>(a: T, b: T, c: T) -> T;

    /// Does the same as [`sin_cos_array`](super::sin_cos_array), with such multiply-adds.
    fn sin_cos_array<T: Real, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]);

    /// Does the same as [`sin_cos_each`](super::sin_cos_each), with such multiply-adds.
    fn sin_cos_each<T: Real, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]);

    /// Whether [`LanesOn`](super::LanesOn) are in vector registers, so that computing the limbs of a robot in lanes is
    /// faster than computing them one after the other.
    const SIDE_BY_SIDE: bool;

    /// An operation on each lane of arrays. With `ONCE`, it rounds once if the processor can.
    #[doc(hidden)]
    fn lanewise<T: Real, O, const ONCE: bool, const K: usize, const R: usize, const N: usize>(
        arguments: [&[T; N]; K],
    ) -> [[T; N]; R]
    where
        O: Lanewise<K, R>;
}

mod sealed {
    pub trait Sealed {}
}

/// The arithmetic of the target for which the program is compiled: fused if [`FUSED`](super::FUSED).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Compiled;

impl sealed::Sealed for Compiled {}

impl Arithmetic for Compiled {
    #[inline(always)]
    fn mul_add<T: Real>(a: T, b: T, c: T) -> T {
        T::mul_add(a, b, c)
    }

    #[inline(always)]
    fn sin_cos_array<T: Real, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
        super::sin_cos_array(angles)
    }

    #[inline(always)]
    fn sin_cos_each<T: Real, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
        super::sin_cos_each(angles)
    }

    const SIDE_BY_SIDE: bool = cfg!(target_arch = "x86_64");

    #[inline(always)]
    fn lanewise<T: Real, O, const ONCE: bool, const K: usize, const R: usize, const N: usize>(
        arguments: [&[T; N]; K],
    ) -> [[T; N]; R]
    where
        O: Lanewise<K, R>,
    {
        T::lanewise::<O, K, R, N>(arguments)
    }
}

/// Runs `kernel` on the current processor, with AVX2 and fused multiply-adds if it has them.
///
/// The choice costs one load and one branch; the kernel is then a function that is not inlined. If there is only one
/// choice, the kernel is inlined and runs as [`Compiled`].
#[inline(always)]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(all(
        feature = "std",
        target_arch = "x86_64",
        not(all(target_feature = "avx2", target_feature = "fma"))
    ))]
    return x86::dispatch(kernel);
    #[cfg(not(all(
        feature = "std",
        target_arch = "x86_64",
        not(all(target_feature = "avx2", target_feature = "fma"))
    )))]
    kernel.run::<Compiled>()
}

/// Does the same as [`dispatch`] for a kernel that follows calls of the standard library's sine and cosine: on x86-64
/// it is never inlined if multiply-adds are compiled in.
#[inline(always)]
pub fn dispatch_apart<K: Kernel>(kernel: K) -> K::Output {
    if cfg!(all(target_arch = "x86_64", target_feature = "fma")) {
        return apart(kernel);
    }
    dispatch(kernel)
}

/// Does the same as [`dispatch`] for a loop over states, also with AVX-512. The kernel is never inlined, because the
/// body of such a loop is vectorized only in a function of its own.
#[inline(always)]
pub fn dispatch_block<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx512f")))]
    return x86::dispatch_block(kernel);
    #[cfg(not(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx512f"))))]
    apart(kernel)
}

/// Returns the same reference, but hides from the compiler what it refers to; this takes no instruction.
///
/// If LLVM sees that numbers are next to each other, it loads them together and shuffles them. For lanes that are
/// gathered from several places, it does so in registers of 512 bits if there are any, and a few such instructions
/// among narrower ones slow down Intel processors by half.
#[inline(always)]
#[allow(clippy::pointers_in_nomem_asm_block, reason = "nothing follows the pointer")]
pub fn anywhere<T>(reference: &T) -> &T {
    #[cfg(all(target_arch = "x86_64", not(miri)))]
    {
        let mut pointer: *const T = reference;
        // SAFETY: the pointer does not change.
        unsafe {
            core::arch::asm!(
                "/* {0} */",
                inout(reg) pointer,
                options(nomem, nostack, preserves_flags)
            );
            &*pointer
        }
    }
    #[cfg(not(all(target_arch = "x86_64", not(miri))))]
    reference
}

/// Runs `kernel` as compiled for the target, not inlined.
#[inline(never)]
fn apart<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Compiled>()
}

#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx512f")))]
mod x86 {
    extern crate std;

    use core::sync::atomic::{AtomicU8, Ordering};
    use std::is_x86_feature_detected;

    use super::super::lanewise::Lanewise;
    use super::super::real::Real;
    use super::{Arithmetic, Kernel, apart, sealed};

    /// The processor has not been queried yet, or has nothing beyond what every x86-64 has.
    const PLAIN: u8 = 0;
    /// The processor has AVX2 and fused multiply-adds.
    const AVX2: u8 = 1;
    /// The processor also has AVX-512 F, DQ and VL.
    const AVX512: u8 = 2;

    /// The features of the processor, after it has been queried.
    static LEVEL: AtomicU8 = AtomicU8::new(PLAIN);

    /// The features of the processor as known so far. With debug assertions this is a call, so that callers do not
    /// contain the branches of an unoptimized load.
    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn detected_level() -> u8 {
        LEVEL.load(Ordering::Relaxed)
    }

    #[cfg(not(all(target_feature = "avx2", target_feature = "fma")))]
    #[inline(always)]
    pub(super) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
        if detected_level() >= AVX2 {
            // SAFETY: the processor was queried and has these features.
            return unsafe { with_avx2(kernel) };
        }
        run_after_detection(kernel)
    }

    #[inline(always)]
    pub(super) fn dispatch_block<K: Kernel>(kernel: K) -> K::Output {
        if detected_level() == AVX512 {
            // SAFETY: the processor was queried and has these features.
            return unsafe { with_avx512(kernel) };
        }
        run_block_after_detection(kernel)
    }

    /// Queries the processor and runs the kernel. This happens in the first call, and in each call on a processor that
    /// has only the baseline features.
    #[cfg(not(all(target_feature = "avx2", target_feature = "fma")))]
    #[inline(never)]
    fn run_after_detection<K: Kernel>(kernel: K) -> K::Output {
        if detect() >= AVX2 {
            // SAFETY: the processor was queried and has these features.
            return unsafe { with_avx2(kernel) };
        }
        apart(kernel)
    }

    #[inline(never)]
    fn run_block_after_detection<K: Kernel>(kernel: K) -> K::Output {
        match detect() {
            // SAFETY: the processor was queried and has these features.
            AVX512 => unsafe { with_avx512(kernel) },
            #[cfg(not(all(target_feature = "avx2", target_feature = "fma")))]
            AVX2 => unsafe { with_avx2(kernel) },
            _ => apart(kernel),
        }
    }

    #[inline(never)]
    fn detect() -> u8 {
        let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        let avx512 = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        let level = match (avx2, avx512) {
            (true, true) => AVX512,
            (true, false) => AVX2,
            _ => PLAIN,
        };
        LEVEL.store(level, Ordering::Relaxed);
        level
    }

    /// Runs `kernel` with AVX2 and fused multiply-adds.
    ///
    /// # Safety
    ///
    /// The processor must have both.
    #[cfg(not(all(target_feature = "avx2", target_feature = "fma")))]
    #[target_feature(enable = "avx2,fma")]
    #[inline(never)]
    unsafe fn with_avx2<K: Kernel>(kernel: K) -> K::Output {
        kernel.run::<Fused>()
    }

    /// Runs `kernel` with AVX-512.
    ///
    /// # Safety
    ///
    /// The processor must have AVX-512 F, DQ and VL, AVX2 and fused multiply-adds.
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    #[inline(never)]
    unsafe fn with_avx512<K: Kernel>(kernel: K) -> K::Output {
        kernel.run::<Fused>()
    }

    /// The arithmetic of a processor with AVX2 and fused multiply-adds. Code outside this file cannot
    /// name it, so kernels run with it only on processors that have both.
    pub(super) struct Fused;

    impl sealed::Sealed for Fused {}

    impl Arithmetic for Fused {
        #[inline(always)]
        fn mul_add<T: Real>(a: T, b: T, c: T) -> T {
            // SAFETY: here and below, see the documentation of the type.
            unsafe { T::mul_add_once(a, b, c) }
        }

        #[inline(always)]
        fn sin_cos_array<T: Real, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
            unsafe { T::sin_cos_array_once(angles) }
        }

        #[inline(always)]
        fn sin_cos_each<T: Real, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
            unsafe { T::sin_cos_each_once(angles) }
        }

        const SIDE_BY_SIDE: bool = true;

        #[inline(always)]
        fn lanewise<T: Real, O, const ONCE: bool, const K: usize, const R: usize, const N: usize>(
            arguments: [&[T; N]; K],
        ) -> [[T; N]; R]
        where
            O: Lanewise<K, R>,
        {
            unsafe { T::lanewise_queried::<O, ONCE, K, R, N>(arguments) }
        }
    }
}
