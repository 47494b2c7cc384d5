//! The size of a function's machine code, estimated from its operations, and the time to fetch it.

use crate::counts::Counts;
use crate::module::Function;

/// The size of the first-level instruction cache of common x86-64 and ARM processors, in bytes.
pub const INSTRUCTION_CACHE: usize = 32 * 1024;

/// Bytes of x86-64 code for each operation, including the loads and stores that it needs. Measured; see
/// `docs/performance.md`.
const OPERATION: usize = 8;
/// Bytes of code for each entry that the function returns.
const ENTRY: usize = 7;
/// Bytes of code that a processor fetches per cycle from outside its instruction cache, measured on an AMD Zen 4.
const FETCHED: f64 = 15.0;
/// The clock rate, in cycles per nanosecond, for which [`CodeSize::fetching`] states times.
pub const GIGAHERTZ: f64 = 3.7;

/// The estimated size of a function's machine code, compiled for x86-64 with optimization.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeSize {
    /// The length of the machine code, in bytes.
    pub bytes: usize,
}

impl CodeSize {
    /// Estimates the size of a function's code; `call` holds the operation counts of one call.
    #[must_use]
    pub fn of(function: &Function, call: &Counts) -> CodeSize {
        let operations = call.operations() + call.sqrt + call.other;
        CodeSize { bytes: OPERATION * operations + ENTRY * function.core.results().len() }
    }

    /// Whether the code fits into the instruction cache, so that later calls do not have to fetch it again.
    #[must_use]
    pub fn fits(self) -> bool {
        self.bytes <= INSTRUCTION_CACHE
    }

    /// The time to fetch code that does not fit into the cache, in ns at [`GIGAHERTZ`]. A call takes at least this
    /// long.
    #[must_use]
    pub fn fetching(self) -> Option<f64> {
        (!self.fits()).then_some(self.bytes as f64 / (FETCHED * GIGAHERTZ))
    }
}

#[cfg(test)]
mod tests {
    use super::{CodeSize, INSTRUCTION_CACHE};

    #[test]
    fn code_that_does_not_fit_costs_its_fetching() {
        let [fits, does_not] = [0, 1].map(|more| CodeSize { bytes: INSTRUCTION_CACHE + more });
        assert!(fits.fits() && fits.fetching().is_none());
        // 32 769 bytes at 15 bytes · 3.7 GHz.
        let time = does_not.fetching().unwrap();
        assert!(!does_not.fits() && (time - 590.4).abs() < 0.1, "{time}");
    }
}
