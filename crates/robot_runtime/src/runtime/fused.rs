//! Multiply-add, as one instruction if the target has it.

#[cfg(feature = "std")]
extern crate std;

/// Whether [`Scalar::mul_add`](super::Scalar::mul_add) rounds once.
///
/// True with feature `std` (only the standard library offers the instruction in stable Rust) if the program is compiled
/// for a target that has the instruction: x86 with `fma`, 64-bit ARM, RISC-V with `d` (with a nightly compiler only). Otherwise a multiply-add is a
/// product and a sum, each rounded, with the same bits on every such target.
pub const FUSED: bool = cfg!(all(
    feature = "std",
    any(
        target_feature = "fma",
        target_arch = "aarch64",
        all(any(target_arch = "riscv64", target_arch = "riscv32"), target_feature = "d")
    )
));

macro_rules! multiply_add {
    ($name:ident, $once:ident, $float:ident) => {
        /// `a · b + c`, fused if [`FUSED`].
        #[inline(always)]
        pub(super) fn $name(a: $float, b: $float, c: $float) -> $float {
            if FUSED { $once(a, b, c) } else { a * b + c }
        }

        /// `a · b + c`, rounded once with feature `std`. Without the instruction this is slow software, so it is called
        /// only if the processor has the instruction.
        #[inline(always)]
        pub(super) fn $once(a: $float, b: $float, c: $float) -> $float {
            #[cfg(feature = "std")]
            return a.mul_add(b, c);
            #[cfg(not(feature = "std"))]
            return a * b + c;
        }
    };
}

multiply_add!(mul_add_f64, once_f64, f64);
multiply_add!(mul_add_f32, once_f32, f32);
