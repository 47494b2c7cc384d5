//! The registers of the current processor.

use crate::error::Error;

/// The vector registers for which code is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Registers {
    /// 16 registers of 256 bits with fused multiply-adds: AVX2 and FMA.
    Avx2,
    /// 32 registers of 512 bits: AVX-512 F, DQ and VL.
    Avx512,
    /// The 128-bit registers of a 64-bit ARM processor, for which cranelift makes the code. With the feature
    /// `cranelift` also those of x86-64 with AVX2 and FMA, which are used only if the options name them.
    Bits128,
}

impl Registers {
    /// Finds the widest registers of this machine.
    ///
    /// # Errors
    ///
    /// An architecture other than x86-64 and 64-bit ARM, or an x86-64 without AVX2 and FMA. The interpreter computes
    /// the same there.
    pub fn detect() -> Result<Registers, Error> {
        let widest = [Registers::Avx512, Registers::Avx2, Registers::Bits128];
        let here = widest.into_iter().find(|registers| registers.are_here());
        here.ok_or(Error::Processor { needed: Registers::Avx2.needed() })
    }

    /// The processor and the extensions that are needed, for the message.
    fn needed(self) -> &'static str {
        match self {
            Registers::Avx2 => "an x86-64 processor with AVX2 and FMA, or a 64-bit ARM",
            Registers::Avx512 => "an x86-64 processor with AVX-512 F, DQ and VL",
            Registers::Bits128 => "a 64-bit ARM, or the feature `cranelift`",
        }
    }

    /// Returns these registers, if this machine has them.
    ///
    /// # Errors
    ///
    /// The machine does not have them.
    pub fn check(self) -> Result<Registers, Error> {
        let needed = self.needed();
        if self.are_here() { Ok(self) } else { Err(Error::Processor { needed }) }
    }

    /// The number of lanes of a register, which is also the number of states that are computed at once.
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
