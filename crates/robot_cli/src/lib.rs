//! The command `robot-symbolic`: robot files to equations, code and numbers.
//!
//! [`run`] is the whole command, given its arguments and streams. It knows how to ask and how to
//! show; all else is done by the other crates.

mod commands;
mod counts;
mod failure;
mod files;
mod progress;
mod robot;
mod settings;
mod states;
mod text;

use std::ffi::OsString;
use std::io::{Read, Write};

use clap::Parser;
use clap::error::ErrorKind;

use commands::Command;

/// Symbolic equations of motion and plain Rust code from robot files.
///
/// Without a command, shows the equations of the robot TRTTR1 and runs its generated code.
#[derive(Parser)]
#[command(
    name = "robot-symbolic",
    version,
    after_help = "Examples:
  robot-symbolic equations robots/trttr1.toml --quantity Q,F_l --format latex
  robot-symbolic eval robots/trttr1.toml --function inverse_dynamics --states states.json
  robot-symbolic crate robots/trttr1.toml -o trttr1

Exit codes: 0 done; 1 the robot file or another input is wrong, or a checked file is out of date;
2 the command line is wrong."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// The streams of a command.
pub struct Terminal<'a> {
    /// Standard input.
    pub input: &'a mut dyn Read,
    /// Standard output.
    pub output: &'a mut dyn Write,
    /// Standard error.
    pub errors: &'a mut dyn Write,
    /// Whether standard error is a terminal: it shows colours and progress.
    pub colours: bool,
}

/// Runs the command; the first argument is its own name. Gives the exit code: 0 done, 1 an input is
/// wrong, 2 the command line is wrong.
pub fn run(
    arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>,
    terminal: &mut Terminal<'_>,
) -> u8 {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => return usage(&error, terminal),
    };
    let command = cli.command.unwrap_or_default();
    let result = command.run(terminal).and_then(|()| Ok(terminal.output.flush()?));
    match result {
        Ok(()) => 0,
        Err(failure) => failure.report(terminal),
    }
}

/// Help and version go to standard output, wrong usage to standard error.
fn usage(error: &clap::Error, terminal: &mut Terminal<'_>) -> u8 {
    let wanted = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
    let stream = if wanted { &mut terminal.output } else { &mut terminal.errors };
    // Nobody is listening where this fails.
    let _ = write!(stream, "{error}");
    if wanted { 0 } else { 2 }
}
