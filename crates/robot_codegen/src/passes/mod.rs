//! Passes over programs: each takes a [`Program`] and gives one that computes the same results.

pub mod dead_code;
pub mod value_numbering;

use crate::counts::{Counts, PassCounts};
use crate::program::Program;

/// What the passes do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {}

/// Runs the passes on a program that loads parameters.
pub(crate) fn run(program: &Program, _: &Options) -> (Program, Vec<PassCounts>) {
    let mut report = vec![];
    let program = dead_code::run(program);
    report.push(PassCounts { pass: "lowered", counts: Counts::of_calls(&program) });
    (program, report)
}

/// The passes for small programs off the path of a call.
pub(crate) fn tidy(program: &Program) -> Program {
    dead_code::run(program)
}

/// The passes on a program that loads fields: what depends on the final operations.
pub(crate) fn finish(program: &Program, _: &Options) -> Program {
    dead_code::run(program)
}
