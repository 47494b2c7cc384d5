//! Vector registers, on which operations act lane by lane.
//!
//! The processor's instructions are functions of `core::arch` that must run only on processors that
//! have them. A type of this module exists if the program is compiled for such processors;
//! in addition, [`processor`](super::processor) uses those of 256 bits after it has queried the processor.

#[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
mod neon;
#[cfg(any(target_arch = "x86_64", all(target_arch = "aarch64", target_feature = "neon")))]
mod register;
#[cfg(target_arch = "x86_64")]
pub(super) mod x86;

#[cfg(any(target_arch = "x86_64", all(target_arch = "aarch64", target_feature = "neon")))]
use super::fused::FUSED;
use super::lanewise::{Lanewise, one_by_one};
#[cfg(any(target_arch = "x86_64", all(target_arch = "aarch64", target_feature = "neon")))]
use super::scalar::Scalar;

#[cfg(any(target_arch = "x86_64", all(target_arch = "aarch64", target_feature = "neon")))]
/// A register of `W` numbers of type `F`.
pub(super) trait Register<F, const W: usize>: Scalar {
    /// Loads element i into lane i.
    fn load(from: &[F; W]) -> Self;

    /// Stores lane i in element i.
    fn store(self, to: &mut [F; W]);
}

#[cfg(any(target_arch = "x86_64", all(target_arch = "aarch64", target_feature = "neon")))]
/// Applies an operation to arrays register by register; their length is a multiple of the register's. The first
/// four registers are computed without a loop.
#[inline(always)]
pub(super) fn by_register<V, O, F, const W: usize, const A: usize, const R: usize, const N: usize>(
    arguments: [&[F; N]; A],
) -> [[F; N]; R]
where
    V: Register<F, W>,
    O: Lanewise<A, R>,
    F: Scalar,
{
    let mut results = [[F::ZERO; N]; R];
    if N >= W {
        at::<V, O, F, W, A, R, N>(&arguments, &mut results, 0);
    }
    if N >= 2 * W {
        at::<V, O, F, W, A, R, N>(&arguments, &mut results, 1);
    }
    if N >= 3 * W {
        at::<V, O, F, W, A, R, N>(&arguments, &mut results, 2);
    }
    if N >= 4 * W {
        at::<V, O, F, W, A, R, N>(&arguments, &mut results, 3);
    }
    for index in 4..(N / W).max(4) {
        at::<V, O, F, W, A, R, N>(&arguments, &mut results, index);
    }
    results
}

macro_rules! by_widest {
    ($float:ident: $narrow:ident $narrow_lanes:literal, $middle:ident $middle_lanes:literal, $wide:ident $wide_lanes:literal) => {
        /// Applies an operation to each lane of arrays, in the widest registers whose number of lanes divides their
        /// length.
        #[inline(always)]
        pub(super) fn $float<O, const A: usize, const R: usize, const N: usize>(
            arguments: [&[$float; N]; A],
        ) -> [[$float; N]; R]
        where
            O: Lanewise<A, R>,
        {
            #[cfg(all(target_arch = "x86_64", target_feature = "avx512f"))]
            if N % $wide_lanes == 0 {
                return by_register::<x86::$wide<FUSED>, O, $float, $wide_lanes, A, R, N>(
                    arguments,
                );
            }
            #[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
            if N % $middle_lanes == 0 {
                return by_register::<x86::$middle<FUSED>, O, $float, $middle_lanes, A, R, N>(
                    arguments,
                );
            }
            #[cfg(target_arch = "x86_64")]
            if N % $narrow_lanes == 0 {
                return by_register::<x86::$narrow<FUSED>, O, $float, $narrow_lanes, A, R, N>(
                    arguments,
                );
            }
            #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
            if N % $narrow_lanes == 0 {
                return by_register::<neon::$narrow<FUSED>, O, $float, $narrow_lanes, A, R, N>(
                    arguments,
                );
            }
            one_by_one::<$float, O, A, R, N>(arguments)
        }
    };
}

/// Applies an operation to the registers at `index`. If this were a closure, instructions that depend on the queried
/// processor would not be inlined.
#[cfg(any(target_arch = "x86_64", all(target_arch = "aarch64", target_feature = "neon")))]
#[inline(always)]
fn at<V, O, F, const W: usize, const A: usize, const R: usize, const N: usize>(
    arguments: &[&[F; N]; A],
    results: &mut [[F; N]; R],
    index: usize,
) where
    V: Register<F, W>,
    O: Lanewise<A, R>,
    F: Scalar,
{
    let mut loaded = [V::ZERO; A];
    for (register, argument) in loaded.iter_mut().zip(arguments) {
        if let Some(chunk) = argument.as_chunks::<W>().0.get(index) {
            *register = V::load(chunk);
        }
    }
    for (register, result) in O::of(loaded).into_iter().zip(results) {
        if let Some(chunk) = result.as_chunks_mut::<W>().0.get_mut(index) {
            register.store(chunk);
        }
    }
}

#[cfg(target_arch = "x86_64")]
macro_rules! asked {
    ($name:ident, $float:ident: $narrow:ident $narrow_lanes:literal, $middle:ident $middle_lanes:literal) => {
        /// Applies an operation to each lane of arrays on a processor that has AVX2 and fused multiply-adds.
        #[inline(always)]
        pub(super) fn $name<O, const ONCE: bool, const A: usize, const R: usize, const N: usize>(
            arguments: [&[$float; N]; A],
        ) -> [[$float; N]; R]
        where
            O: Lanewise<A, R>,
        {
            // Without `ONCE`, operations round as in the rest of the program.
            match (ONCE, N % $middle_lanes == 0) {
                (true, true) => {
                    by_register::<x86::$middle<true>, O, $float, $middle_lanes, A, R, N>(arguments)
                }
                (false, true) => {
                    by_register::<x86::$middle<FUSED>, O, $float, $middle_lanes, A, R, N>(arguments)
                }
                (true, false) if N % $narrow_lanes == 0 => {
                    by_register::<x86::$narrow<true>, O, $float, $narrow_lanes, A, R, N>(arguments)
                }
                _ => $float::<O, A, R, N>(arguments),
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
asked!(asked_f64, f64: F64x2 2, F64x4 4);
#[cfg(target_arch = "x86_64")]
asked!(asked_f32, f32: F32x4 4, F32x8 8);

by_widest!(f64: F64x2 2, F64x4 4, F64x8 8);
by_widest!(f32: F32x4 4, F32x8 8, F32x16 16);
