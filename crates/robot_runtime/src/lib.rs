#![no_std]
//! The functions that generated robot code calls at run time: numbers, and sines and cosines.
//!
//! The dynamics of a robot are additions and multiplications of its velocities, its accelerations and the sines and
//! cosines of its angles. Generated code contains the additions and multiplications; this crate provides the rest,
//! without dependencies, allocation, or a branch that depends on a value.
//!
//! ```
//! use robot_runtime::{Scalar, sin_cos_array, sin_cos_each};
//!
//! /// Gravity torques of two links, as a generator writes them: from sines and cosines.
//! fn gravity_sc<T: Scalar>(s: &[T; 2], c: &[T; 2]) -> [T; 2] {
//!     let c12 = c[0] * c[1] - s[0] * s[1];
//!     let outer = T::from_f64(2.0) * c12;
//!     [T::from_f64(5.0) * c[0] + outer, outer]
//! }
//!
//! /// At one state: the angles go through vector registers together.
//! fn gravity(q: &[f64; 2]) -> [f64; 2] {
//!     let (s, c) = sin_cos_array(q);
//!     gravity_sc(&s, &c)
//! }
//!
//! /// At eight states: LLVM vectorizes the loop, states side by side.
//! #[inline(never)]
//! fn gravity_block(q: &[[f64; 2]; 8]) -> [[f64; 2]; 8] {
//!     let mut torques = [[0.0; 2]; 8];
//!     for (torque, q) in torques.iter_mut().zip(q) {
//!         let (s, c) = sin_cos_each(q);
//!         *torque = gravity_sc(&s, &c);
//!     }
//!     torques
//! }
//!
//! let q = [0.3, -0.7];
//! assert_eq!(gravity_block(&[q; 8]), [gravity(&q); 8]);
//! ```
//!
//! # Sines and cosines
//!
//! | function | source | meant for |
//! |---|---|---|
//! | [`sin_cos_array`] | polynomials | all angles of one state, in vector registers |
//! | [`sin_cos_each`] | polynomials | the body of a loop over states |
//! | [`Scalar::sin_cos`] | polynomials | one angle, or one in every lane |
//! | `std_sin_cos_array` (feature `std`) | standard library | angles of any size |
//!
//! The three functions with polynomials give the same bits. [`Trig`] makes the source a type parameter.
//!
//! | type | range | largest absolute error in this range | with [`FUSED`] | in last places |
//! |---|---|---|---|---|
//! | `f64` | ǀxǀ < 2³⁰ = 1 073 741 824 | 1.7e-16 | 1.4e-16 | 1.6 |
//! | `f32` | ǀxǀ < 2¹⁷ = 131 072 | 8.8e-8 | 7.2e-8 | 1.2 for ǀxǀ ≤ π/4 |
//!
//! These errors were found in `f32` for every number in the range, and in `f64` for 4·10⁷ random numbers, the three
//! neighbors of each multiple of π/2 up to 3·10⁵ and of 2·10⁶ multiples beyond, and the angles in the range that are
//! closest to a multiple. The last places of `f64` without [`FUSED`] are valid up to 2·10⁵; beyond, a sine or cosine
//! below 10⁻⁵ can have an additional error of 10⁻²¹.
//!
//! **Beyond the range, sine and cosine are NaN**, as for NaN and infinite angles: no finite result is wrong,
//! and none lies outside [−1, 1]. Reduce angles that grow without bound, such as those of wheels and spindles,
//! by whole turns before they reach the limit; the standard library's sine and cosine accept angles of any
//! size.
//!
//! With polynomials, the same program gives the same bits on every target with the same [`FUSED`]; the standard
//! library's sines differ between platforms. [`trig::double::portable_sin_cos`] gives those without [`FUSED`] on
//! every target.
//!
//! # Other functions
//!
//! | function | error |
//! |---|---|
//! | [`Scalar::sqrt`] | correctly rounded with `std`; else, no bit differed for any `f32` or 3·10⁸ random `f64` |
//! | [`Scalar::tanh`] | below 3 last places everywhere (2.61 in `f32`, every number tried) |
//! | [`Scalar::mul_add`] | rounds once if [`FUSED`], otherwise twice |
//! | [`Scalar::abs`], [`Scalar::signum0`] | exact |
//! | [`Scalar::recip_positive`] | correctly rounded |
//!
//! # Lanes
//!
//! [`Lanes`] are several numbers that act as one [`Scalar`]:
//!
//! ```
//! use robot_runtime::{F64x4, Scalar};
//!
//! let velocity = F64x4::from_array([-0.2, 0.0, 0.1, 3.0]);
//! let friction = velocity * F64x4::splat(0.5) + velocity.signum0();
//! assert_eq!(friction.to_array(), [-1.1, 0.0, 1.05, 2.5]);
//! ```
//!
//! If the number of lanes fills vector registers of the target, lanes of `f64` and `f32` are computed in these
//! registers.
//!
//! # The current processor
//!
//! A program for any x86-64 processor can use neither fused multiply-adds nor wide registers. With feature `std` a
//! [`Kernel`] is compiled for several processors, and [`dispatch`] chooses at run time:
//!
//! ```
//! use robot_runtime::{Arithmetic, Kernel, dispatch};
//!
//! #[derive(Clone, Copy)]
//! struct Energy([f64; 2]);
//!
//! impl Kernel for Energy {
//!     type Output = f64;
//!
//!     #[inline(always)]
//!     fn run<A: Arithmetic>(self) -> f64 {
//!         let (_, [c1, c2]) = A::sin_cos_array(&self.0);
//!         A::mul_add(5.0, c1, 2.0 * c2)
//!     }
//! }
//!
//! assert!((dispatch(Energy([0.3, -0.7])) - 6.3063668).abs() < 1e-6);
//! ```
//!
//! | | levels on x86-64 |
//! |---|---|
//! | [`dispatch`], [`dispatch_apart`] | any; AVX2 with fused multiply-adds |
//! | [`dispatch_block`], for loops over states | also AVX-512 |
//!
//! [`Arithmetic`] rounds once if the processor can; everything else in a kernel has the same bits on every level. A
//! program that is compiled for such a processor, or for another architecture, contains no choice.
//!
//! # Features
//!
//! - `std` (on): the choice of the processor, `StdTrig` and `std_sin_cos_array`, the processor's square root, and
//!   fused multiply-add if the target has it. Without it, the crate needs only `core`.
//! - `sources` (off): `SOURCES`, the text of the modules, for generators of self-contained crates.

mod runtime;
#[cfg(feature = "sources")]
mod sources;

pub use self::runtime::*;
#[cfg(feature = "sources")]
pub use self::sources::{RUST_VERSION, SOURCES};
