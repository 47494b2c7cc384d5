//! The reasons why a command did not do its work.

use std::io;

use robot_build::{Error, Errors, system_reason};
use robot_model::diagnostic::Style;

use crate::Terminal;
use crate::complaints::Complaints;
use crate::options::in_flags;

/// The reason why a command did not do its work.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Errors in the robot file or in the request.
    Robot(Errors),
    /// Errors in other inputs, each with a message.
    Input(Vec<String>),
    /// Errors in other inputs, of which there can be more than are stored.
    Inputs(Complaints),
    /// Arguments that contradict each other or name something that does not exist.
    Usage(Vec<String>),
    /// A failure that has already been shown.
    Shown,
    /// A failure with the exit code 2: of arguments, or of comparisons, which use 1 for differences.
    Refused(Box<Failure>),
    /// Standard output cannot be written.
    Stream(io::Error),
}

impl From<Errors> for Failure {
    fn from(errors: Errors) -> Failure {
        Failure::Robot(errors)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Failure {
        Failure::Robot(Errors::from(error))
    }
}

impl From<robot_simulation::Error> for Failure {
    fn from(error: robot_simulation::Error) -> Failure {
        match error {
            robot_simulation::Error::Robot(errors) => Failure::Robot(errors),
            robot_simulation::Error::Input(messages) => Failure::Input(messages),
            other => Failure::input(other.to_string()),
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Failure {
        Failure::Stream(error)
    }
}

impl Failure {
    /// A failure because of one wrong input.
    pub(crate) fn input(message: impl Into<String>) -> Failure {
        Failure::Input(vec![message.into()])
    }

    /// The failure with the exit code 2: because of arguments, or of a command whose code 1 means that two things
    /// differ.
    pub(crate) fn refused(self) -> Failure {
        Failure::Refused(Box::new(self))
    }

    /// Prints the messages; returns the exit code.
    pub(crate) fn report(&self, terminal: &mut Terminal<'_>) -> u8 {
        let (messages, code) = match self {
            Failure::Robot(errors) => {
                let code = if errors.as_slice().iter().all(is_of_options) { 2 } else { 1 };
                (robot_messages(errors, terminal.colors), code)
            }
            Failure::Input(messages) => (shown(messages), 1),
            Failure::Inputs(complaints) => (complaints.lines(), 1),
            Failure::Usage(messages) => (shown(messages), 2),
            Failure::Shown => (vec![], 1),
            Failure::Refused(failure) => {
                failure.report(terminal);
                return 2;
            }
            // The reader of the output has closed the stream.
            Failure::Stream(error) if error.kind() == io::ErrorKind::BrokenPipe => return 0,
            Failure::Stream(error) => {
                (vec![format!("error: cannot write the results: {}", system_reason(error))], 2)
            }
        };
        for message in messages {
            // If this fails, nobody reads the messages.
            let _ = writeln!(terminal.errors, "{}", in_flags(message.trim_end()));
        }
        code
    }
}

/// Whether the error is in the command line; the same error in a file would have a place.
fn is_of_options(error: &Error) -> bool {
    matches!(
        error,
        Error::Batch { .. }
            | Error::Bundle { .. }
            | Error::FunctionName(_)
            | Error::NoFunctions
            | Error::AllFunctionsAndOthers
            | Error::OfRust { .. }
            | Error::ParallelWithoutBatch
            | Error::Snap(_)
    )
}

fn robot_messages(errors: &Errors, colors: bool) -> Vec<String> {
    let style = if colors { Style::Terminal } else { Style::Plain };
    let messages = errors.as_slice().iter().map(|error| match error {
        Error::Robot(diagnostics) => diagnostics.render(style),
        _ => format!("error: {}", in_command_words(error)),
    });
    messages.collect()
}

/// Prints an error with the command that helps, which libraries do not mention.
pub(crate) fn in_command_words(error: &Error) -> String {
    match error {
        Error::Pin { robot, .. } => {
            let command = format!("run `robot-symbolic search {robot}` again");
            error.to_string().replace("search for a plan again", &command)
        }
        _ => error.to_string(),
    }
}

fn shown(messages: &[String]) -> Vec<String> {
    messages.iter().cloned().collect::<Complaints>().lines()
}
