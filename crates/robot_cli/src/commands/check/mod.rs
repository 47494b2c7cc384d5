//! `check`: errors and likely mistakes in robot files.

mod json;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::{Error, RobotFile};
use robot_check::doctor::{self, Examination};
use robot_model::diagnostic::{Diagnostic, Diagnostics, Severity, Style, code};

use crate::Terminal;
use crate::delivery::answered;
use crate::failure::{Failure, in_command_words};
use crate::format::Format;
use crate::options::in_flags;
use crate::plan::is_of_pin;
use crate::reading::ReadingArguments;
use crate::suggested::CODE;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic check robots/*.toml arm.urdf
  robot-symbolic check arm.urdf --deny warnings --allow R0607 --format json
  robot-symbolic check --explain R0608

Errors are impossible for any robot: every other command refuses a file with errors. Warnings are likely
mistakes; they change nothing, and most are shown only by this command. Notes say how the file was interpreted.
Every diagnostic has a stable code with a page (docs/diagnostics).

Exit codes: 0 if there are no errors; 1 if a file has errors, or warnings with --deny warnings; 2 if the command
line is wrong. Text goes to standard error, JSON to standard output.")]
pub(crate) struct Arguments {
    /// Robot files, TOML or URDF
    #[arg(required_unless_present = "explain", value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Fail on warnings too
    #[arg(long, value_enum)]
    deny: Option<Deny>,
    /// Hide warnings and notes with these codes
    #[arg(long, value_name = "CODE", value_delimiter = ',', value_parser = CODE,
          hide_possible_values = true)]
    allow: Vec<String>,
    /// Show the page of a code
    #[arg(long, value_name = "CODE", exclusive = true, value_parser = CODE, hide_possible_values = true)]
    explain: Option<String>,
    #[command(flatten)]
    reading: ReadingArguments,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Deny {
    Warnings,
}

/// The result for one file.
enum Report {
    Examined(Examination),
    /// A file that cannot be read, and the reason.
    Unread {
        file: String,
        reason: String,
    },
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        if let Some(wanted) = &self.explain {
            return explain(wanted, terminal);
        }
        let wrong: Vec<String> = self
            .allow
            .iter()
            .filter(|code| code::page(code).is_none())
            .map(|code| unknown(code))
            .collect();
        if !wrong.is_empty() {
            return Err(Failure::Usage(wrong));
        }
        let reports: Vec<Report> = self.files.iter().map(|file| self.report(file)).collect();
        match self.format {
            Format::Text => {
                for report in &reports {
                    show(report, terminal)?;
                }
            }
            Format::Json => answered(&format!("{:#}\n", json::document(&reports)), terminal)?,
        }
        let count = |severity| reports.iter().map(|report| report.count(severity)).sum::<usize>();
        let denied = self.deny == Some(Deny::Warnings) && count(Severity::Warning) > 0;
        if denied || count(Severity::Error) > 0 { Err(Failure::Shown) } else { Ok(()) }
    }

    fn report(&self, path: &std::path::Path) -> Report {
        let options = self.reading.options().reading();
        let examination = match RobotFile::read(path) {
            Ok(file) => {
                let examination = doctor::check(&file.source.name, &file.source.text, &options);
                with_pin(examination, &file)
            }
            Err(errors) => match errors.as_slice() {
                // The bytes are not text.
                [Error::Robot(found)] => Examination::refused((**found).clone()),
                others => {
                    let file = path.to_string_lossy().into_owned();
                    let reasons: Vec<String> = others.iter().map(ToString::to_string).collect();
                    return Report::Unread { file, reason: reasons.join("; ") };
                }
            },
        };
        let Examination { found, choices } = examination;
        Report::Examined(Examination { found: self.wanted(&found), choices: self.wanted(&choices) })
    }

    /// Removes warnings that the command line allows; errors always stay.
    fn wanted(&self, found: &Diagnostics) -> Diagnostics {
        let wanted = found.iter().filter(|one| {
            one.severity == Severity::Error || self.allow.iter().all(|code| code != one.code)
        });
        Diagnostics::new(found.source().clone(), wanted.cloned().collect())
    }
}

/// Adds a warning if builds would reject the pinned plan of the file.
fn with_pin(examination: Examination, file: &RobotFile) -> Examination {
    let Err(errors) = file.with_pin(&robot_build::Options::default()) else { return examination };
    if !is_of_pin(&errors) {
        // Errors of the file itself have already been found.
        return examination;
    }
    let Examination { found, choices } = examination;
    let pins = errors.as_slice().iter().map(|error| {
        Diagnostic::warning(code::PIN, in_command_words(error)).help(
            "until then, no code is generated from the file, and other commands search for a \
             plan at each call",
        )
    });
    let list = found.iter().cloned().chain(pins).collect();
    Examination { found: Diagnostics::new(found.source().clone(), list), choices }
}

impl Report {
    fn count(&self, severity: Severity) -> usize {
        match self {
            Report::Examined(Examination { found, choices }) => {
                let all = found.iter().chain(choices.iter());
                all.filter(|one| one.severity == severity).count()
            }
            Report::Unread { .. } => usize::from(severity == Severity::Error),
        }
    }
}

fn show(report: &Report, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    let Examination { found, choices } = match report {
        Report::Examined(examination) => examination,
        Report::Unread { reason, .. } => {
            writeln!(terminal.errors, "error: {reason}")?;
            return Ok(());
        }
    };
    let name = &choices.source().name;
    for group in choices.groups() {
        let choice = group.first;
        let place = choice.primary.as_ref().map_or(0, |label| label.span.start);
        let (line, column) = choices.source().position(place);
        let (code, message) = (choice.code, group.line(choices.source()));
        writeln!(terminal.errors, "note[{code}]: {name}:{line}:{column}: {message}")?;
    }
    if found.is_empty() {
        answered(&format!("{name}: no errors, no warnings\n"), terminal)?;
    } else {
        let style = if terminal.colors { Style::Terminal } else { Style::Plain };
        writeln!(terminal.errors, "{}", in_flags(found.render(style).trim_end()))?;
    }
    Ok(())
}

fn unknown(wanted: &str) -> String {
    let known: Vec<&str> = code::TABLE.iter().map(|(code, _)| *code).collect();
    text::unknown("code", wanted, &known)
}

fn explain(wanted: &str, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    let Some(page) = code::page(&wanted.to_uppercase()) else {
        return Err(Failure::Usage(vec![unknown(wanted)]));
    };
    Ok(terminal.output.write_all(page.as_bytes())?)
}
