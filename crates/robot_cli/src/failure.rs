//! Why a command ended without having done its work.

use std::io;

use robot_build::{Error, Errors};
use robot_model::diagnostic::Style;

use crate::Terminal;
use crate::complaints::Complaints;
use crate::options::in_flags;

/// Why a command ended without having done its work.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The robot file, or what was asked of it.
    Robot(Errors),
    /// Other inputs, a message each.
    Input(Vec<String>),
    /// Other inputs, of which more may be wrong than is kept.
    Inputs(Complaints),
    /// Arguments that do not fit together, or name what there is not.
    Usage(Vec<String>),
    /// A failure that has been shown already.
    Shown,
    /// As the failure, with the code 2: a comparison keeps 1 for what differs.
    Refused(Box<Failure>),
    /// Standard output, which cannot be written.
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
    /// One wrong input.
    pub(crate) fn input(message: impl Into<String>) -> Failure {
        Failure::Input(vec![message.into()])
    }

    /// The failure of a command whose code 1 means that two things differ.
    pub(crate) fn refused(self) -> Failure {
        Failure::Refused(Box::new(self))
    }

    /// Shows what is wrong; gives the exit code.
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
            // The reader of the output has closed it.
            Failure::Stream(error) if error.kind() == io::ErrorKind::BrokenPipe => return 0,
            Failure::Stream(error) => {
                (vec![format!("error: cannot write the results: {error}")], 2)
            }
        };
        for message in messages {
            // Nobody is listening if this fails.
            let _ = writeln!(terminal.errors, "{}", in_flags(message.trim_end()));
        }
        code
    }
}

/// Whether the command line is what is wrong: the same in a file would have a place.
fn is_of_options(error: &Error) -> bool {
    matches!(
        error,
        Error::Batch { .. }
            | Error::Bundle { .. }
            | Error::FunctionName(_)
            | Error::NoFunctions
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

/// An error with the command that helps: a library does not know how it is called.
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
