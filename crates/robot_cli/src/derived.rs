//! The programs of functions, for the commands that print code.

use robot_build::{Options, Programs, Source, budget};
use robot_model::diagnostic::{Diagnostics, code};

use crate::Terminal;
use crate::failure::Failure;
use crate::progress::watched;
use crate::text;

/// Derives the functions and checks their budgets. Prints the warnings that only the derivation finds; those about the
/// file are printed when it is read.
pub(crate) fn programs(
    source: &Source,
    options: &Options,
    terminal: &mut Terminal<'_>,
) -> Result<Programs, Failure> {
    let programs = watched("generating", terminal, || budget::programs(source, options))?;
    let derived = programs.warnings.iter().filter(|warning| warning.code == code::INFINITE);
    text::warnings(&Diagnostics::new(source.clone(), derived.cloned().collect()), terminal)?;
    Ok(programs)
}
