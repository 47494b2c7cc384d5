//! What the processor at hand can do.

use crate::error::Error;

/// The vector registers that code is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Registers {
    /// 16 registers of 256 bits with fused multiply-adds: AVX2 and FMA.
    Avx2,
    /// 32 registers of 512 bits: AVX-512 F, DQ and VL.
    Avx512,
    /// Registers of 128 bits of a 64-bit ARM, for which cranelift makes the code; with the feature `cranelift` those of
    /// x86-64 with AVX2 and FMA, too, which are taken only if they are asked for.
    Bits128,
}

impl Registers {
    /// The widest registers of this machine.
    ///
    /// # Errors
    ///
    /// Another architecture than x86-64 and 64-bit ARM, or an x86-64 without AVX2 and FMA: the interpreter computes the
    /// same.
    pub fn detect() -> Result<Registers, Error> {
        let widest = [Registers::Avx512, Registers::Avx2, Registers::Bits128];
        let here = widest.into_iter().find(|registers| registers.are_here());
        here.ok_or(Error::Processor { needed: Registers::Avx2.needed() })
    }

    /// What the processor must be, or have.
    fn needed(self) -> &'static str {
        match self {
            Registers::Avx2 => "an x86-64 processor with AVX2 and FMA, or a 64-bit ARM",
            Registers::Avx512 => "an x86-64 processor with AVX-512 F, DQ and VL",
            Registers::Bits128 => "a 64-bit ARM, or the feature `cranelift`",
        }
    }

    /// These registers, if this machine has them.
    ///
    /// # Errors
    ///
    /// A machine without them.
    pub fn check(self) -> Result<Registers, Error> {
        let needed = self.needed();
        if self.are_here() { Ok(self) } else { Err(Error::Processor { needed }) }
    }

    /// The numbers of a register: as many states are computed side by side.
    #[must_use]
    pub const fn lanes(self) -> usize {
        match self {
            Registers::Avx2 => 4,
            Registers::Avx512 => 8,
            Registers::Bits128 => 2,
        }
    }

    #[cfg(target_arch = "x86_64")]
    fn are_here(self) -> bool {
        use std::is_x86_feature_detected;
        let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        match self {
            Registers::Avx2 => avx2,
            Registers::Avx512 => {
                avx2 && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
            Registers::Bits128 => avx2 && cfg!(feature = "cranelift"),
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn are_here(self) -> bool {
        self == Registers::Bits128 && cfg!(target_arch = "aarch64")
    }
}
