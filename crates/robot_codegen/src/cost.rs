//! The cost that the passes minimize.

use crate::counts::Counts;
use crate::passes::{fusing, product_last};
use crate::program::Program;

/// A measure of programs: the result of a pass is discarded if it costs more than its input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cost {
    /// Multiplications, additions and divisions at a call.
    #[default]
    Operations,
    /// Instructions at a call on a target with fused multiply-add: the operations, without the products
    /// that are fused with a sum.
    Instructions,
}

impl Cost {
    /// The cost of a call of a program that loads parameters.
    #[must_use]
    pub fn of(self, program: &Program) -> usize {
        let weigh = |counts: Counts| counts.operations() + counts.sqrt + counts.other;
        match self {
            Cost::Operations => weigh(Counts::of_calls(program)),
            Cost::Instructions => {
                let counts = Counts::of_calls(&fusing::run(&product_last::run(program)));
                weigh(counts) - counts.fused
            }
        }
    }
}
