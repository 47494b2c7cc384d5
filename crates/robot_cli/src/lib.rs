//! The command `robot-symbolic`, which turns robot files into equations, code and numbers.
//!
//! [`run`] is the whole command, given its arguments and streams. It reads arguments and shows results; the other
//! crates do everything else.

mod commands;
mod complaints;
mod counts;
mod delivery;
mod derived;
mod displayed;
mod failure;
mod files;
mod format;
mod forms;
mod friction;
mod function;
mod help;
mod interrupt;
mod limits;
mod messages;
mod motion;
mod options;
mod outgoing;
mod plan;
mod progress;
mod reading;
mod recording;
mod robot;
mod screen;
mod settings;
mod states;
mod suggested;
mod text;
mod values;

use std::ffi::{OsStr, OsString};
use std::io::{Read, Write};

use clap::error::ErrorKind;
use clap::{FromArgMatches, Parser};

use commands::Command;
use failure::Failure;
use messages::Messages;
pub use screen::Screen;

/// The name of the command.
const NAME: &str = "robot-symbolic";

/// Symbolic equations of motion and plain Rust code from robot files.
///
/// Without a command: show the equations of the robot TRTTR1 and run its generated code.
#[derive(Parser)]
#[command(
    name = NAME,
    version,
    after_help = "Examples:
  robot-symbolic equations robots/trttr1.toml --quantity Q,F_l --format latex
  robot-symbolic eval robots/trttr1.toml --function inverse_dynamics --states states.json
  robot-symbolic crate robots/trttr1.toml -o trttr1

Exit codes of every command:
  0  done
  1  the robot file or another input is wrong, what the options ask for cannot be done, or the result is negative: a
     checked file is out of date, a claim is false, two things differ
  2  the command line cannot be understood: an option is unknown, has an unreadable value, or has no effect and no note
     says so; or standard output cannot be written; for `compare` and `diff`, also any wrong input

Results go to standard output, messages to standard error. Colors appear only on a terminal, and not if the
variable NO_COLOR is set."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// The streams of a command.
pub struct Terminal<'a> {
    /// Standard input, which can be read by a thread of its own.
    pub input: &'a mut (dyn Read + Send),
    /// Standard output.
    pub output: &'a mut dyn Write,
    /// Standard error.
    pub errors: &'a mut dyn Write,
    /// Whether standard error shows colors; see [`colors`].
    pub colors: bool,
    /// Whether standard error is a terminal: it then shows the progress of long runs, and notes that only a reader needs.
    pub progress: bool,
    /// The terminal, if standard output is one; results are then formatted for people.
    pub screen: Option<Screen>,
}

impl Terminal<'_> {
    /// Splits off standard input; returns it and the terminal without it.
    fn without_input<'t>(
        &'t mut self,
        nothing: &'t mut std::io::Empty,
    ) -> (&'t mut (dyn Read + Send), Terminal<'t>) {
        let (output, errors) = (&mut *self.output, &mut *self.errors);
        let Terminal { colors, progress, screen, .. } = *self;
        (&mut *self.input, Terminal { input: nothing, output, errors, colors, progress, screen })
    }
}

/// Whether a stream shows colors. It does on a terminal, unless the variable `NO_COLOR` is set and not
/// empty (<https://no-color.org>).
#[must_use]
pub fn colors(is_terminal: bool, no_color: Option<&OsStr>) -> bool {
    is_terminal && no_color.is_none_or(OsStr::is_empty)
}

/// Runs the command; the first argument is its own name. Returns the exit code: 0 if the work is done, 1 if an input
/// is wrong (2 for `compare` and `diff`) or the result is negative, 2 if the command line is wrong or the output cannot
/// be written.
pub fn run(
    arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>,
    terminal: &mut Terminal<'_>,
) -> u8 {
    let mut errors =
        Messages { stream: &mut *terminal.errors, commands: terminal.colors || terminal.progress };
    let terminal = &mut Terminal {
        input: &mut *terminal.input,
        output: &mut *terminal.output,
        errors: &mut errors,
        ..*terminal
    };
    let arguments: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    let mut whole = help::command(terminal.screen);
    let cli = whole.try_get_matches_from_mut(&arguments).and_then(|matches| {
        Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut whole))
    });
    let cli = match cli {
        Ok(cli) => cli,
        Err(error) => return usage(&help::with_tips(error, &arguments, &whole), terminal),
    };
    let command = cli.command.unwrap_or_default();
    let result = command.run(terminal).and_then(|()| Ok(terminal.output.flush()?));
    match result {
        Ok(()) => 0,
        Err(failure) => failure.report(terminal),
    }
}

/// Prints help and version on standard output, and errors of usage on standard error.
fn usage(error: &clap::Error, terminal: &mut Terminal<'_>) -> u8 {
    let wanted = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
    if wanted {
        let text = rendered(error, screen::is_colored(terminal.screen));
        let shown = write!(terminal.output, "{text}").and_then(|()| terminal.output.flush());
        return shown.map_or_else(|error| Failure::from(error).report(terminal), |()| 0);
    }
    // If this fails, nobody reads the message.
    let _ = write!(terminal.errors, "{}", rendered(error, terminal.colors));
    2
}

fn rendered(error: &clap::Error, colors: bool) -> String {
    let text = error.render();
    if colors { text.ansi().to_string() } else { text.to_string() }
}
