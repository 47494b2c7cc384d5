//! What the processor at hand can do.

use crate::error::Error;

/// The vector registers that code is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Registers {
    /// 16 registers of 256 bits with fused multiply-adds: AVX2 and FMA.
    Avx2,
    /// 32 registers of 512 bits: AVX-512 F, DQ and VL.
    Avx512,
}

impl Registers {
    /// The widest registers of this machine.
    ///
    /// # Errors
    ///
    /// Another architecture than x86-64, or a processor without AVX2 and FMA: the interpreter computes the same.
    pub fn detect() -> Result<Registers, Error> {
        if Registers::Avx512.are_here() {
            Ok(Registers::Avx512)
        } else if Registers::Avx2.are_here() {
            Ok(Registers::Avx2)
        } else {
            Err(Error::Processor { needed: "AVX2 and FMA" })
        }
    }

    /// These registers, if this machine has them.
    ///
    /// # Errors
    ///
    /// A machine without them.
    pub fn check(self) -> Result<Registers, Error> {
        let needed = match self {
            Registers::Avx2 => "AVX2 and FMA",
            Registers::Avx512 => "AVX-512 F, DQ and VL",
        };
        if self.are_here() { Ok(self) } else { Err(Error::Processor { needed }) }
    }

    /// The numbers of a register: as many states are computed side by side.
    #[must_use]
    pub const fn lanes(self) -> usize {
        match self {
            Registers::Avx2 => 4,
            Registers::Avx512 => 8,
        }
    }

    /// How many registers there are.
    pub(crate) const fn count(self) -> usize {
        match self {
            Registers::Avx2 => 16,
            Registers::Avx512 => 32,
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
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn are_here(self) -> bool {
        false
    }
}
