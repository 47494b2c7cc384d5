//! The options with which a command accepts robot files that would otherwise be errors.

use clap::Args;
use robot_build::{Errors, Options, Source, read_with};
use robot_model::description::Described;
use robot_symbolic::Rational;

use crate::Terminal;
use crate::failure::Failure;
use crate::help::MODEL;
use crate::options::{help, in_flags};
use crate::text;

/// What is taken with a warning.
#[derive(Args, Clone, Copy, Default)]
pub(crate) struct ReadingArguments {
    #[arg(long, help_heading = MODEL, help = help("allow_massless"))]
    pub(crate) allow_massless: bool,
    #[arg(long, help_heading = MODEL, help = help("allow_unphysical"))]
    pub(crate) allow_unphysical: bool,
}

impl ReadingArguments {
    /// The default options, with these settings.
    pub(crate) fn options(self) -> Options {
        let ReadingArguments { allow_massless, allow_unphysical } = self;
        Options { allow_massless, allow_unphysical, ..Options::default() }
    }

    /// Reads a robot. Prints warnings, and a line about data in the file that concerns dynamics but does not become
    /// part of the robot.
    pub(crate) fn read(
        self,
        source: &Source,
        terminal: &mut Terminal<'_>,
    ) -> Result<Described, Failure> {
        let described = read_with(source, &self.options())?;
        text::warnings(&described.warnings, terminal)?;
        if !described.left_out.is_empty() {
            let (name, parts) = (&source.name, in_flags(&described.left_out.join("; ")));
            writeln!(terminal.errors, "note: {name}: not part of the robot: {parts}")?;
        }
        Ok(described)
    }

    /// Applies the reader's checks to a robot file with other values of parameters; prints the resulting warnings.
    pub(crate) fn check_values(
        self,
        source: &Source,
        described: &Described,
        values: &[(&str, f64)],
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        let exact = |(name, value): &(&str, f64)| {
            Some(((*name).to_owned(), Rational::from_decimal(&value.to_string())?))
        };
        let values = values.iter().filter_map(exact).collect();
        let options = robot_model::description::Options { values, ..self.options().reading() };
        let found = robot_model::description::read_with(&source.name, &source.text, &options);
        let set = found.map_err(|found| Failure::Robot(Errors::from(found)))?;
        let is_new = |one: &&robot_model::diagnostic::Diagnostic| {
            described.warnings.iter().all(|known| known != *one)
        };
        let new = set.warnings.iter().filter(is_new).cloned().collect();
        let new = robot_model::diagnostic::Diagnostics::new(source.clone(), new);
        text::warnings(&new, terminal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_flag_sets_its_own_option() {
        for (allow_massless, allow_unphysical) in [(true, false), (false, true)] {
            let options = ReadingArguments { allow_massless, allow_unphysical }.options();
            assert_eq!(
                (options.allow_massless, options.allow_unphysical),
                (allow_massless, allow_unphysical)
            );
        }
    }
}
