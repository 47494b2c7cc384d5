//! `check`: errors and likely mistakes in robot files.

mod examination;
mod json;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::{Error, RobotFile, visible};
use robot_check::doctor::Examination;
use robot_model::diagnostic::{Severity, Style, code};

use crate::Terminal;
use crate::delivery::answered;
use crate::failure::Failure;
use crate::format::Format;
use crate::options::in_flags;
use crate::suggested::CODE;
pub(super) use examination::ExaminationArguments;
use examination::unknown;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic check robots/*.toml arm.urdf
  robot-symbolic check arm.urdf --deny warnings --allow R0607 --format json
  robot-symbolic check --explain R0608

Errors are impossible for any robot: every other command refuses a file with errors. Warnings are likely
mistakes; they change nothing, and most are shown only by this command. Notes say how the file was interpreted.
Every diagnostic has a stable code with a page (docs/diagnostics).

Exit codes: 0 if there are no errors; 1 if a file has errors, or warnings with --deny warnings; 2 if the command
line is wrong. Errors, warnings and notes go to standard error as text; the line `no errors, no warnings`, and
JSON, go to standard output.")]
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
    #[command(flatten)]
    examination: ExaminationArguments,
    /// Show the page of a code
    #[arg(long, value_name = "CODE", exclusive = true, value_parser = CODE, hide_possible_values = true)]
    explain: Option<String>,
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
        self.examination.check()?;
        let reports: Vec<Report> = self.files.iter().map(|file| self.report(file)).collect();
        match self.format {
            Format::Text => {
                for report in &reports {
                    show(report, terminal)?;
                }
            }
            Format::Json => answered(&format!("{:#}\n", json::document(&reports)), terminal)?,
        }
        self.examination.note_kept(&reports, terminal)?;
        let count = |severity| reports.iter().map(|report| report.count(severity)).sum::<usize>();
        let denied = self.deny == Some(Deny::Warnings) && count(Severity::Warning) > 0;
        if denied || count(Severity::Error) > 0 { Err(Failure::Shown) } else { Ok(()) }
    }

    fn report(&self, path: &std::path::Path) -> Report {
        match RobotFile::read(path) {
            Ok(file) => Report::Examined(self.examination.of_file(&file)),
            Err(errors) => match errors.as_slice() {
                // The bytes are not text.
                [Error::Robot(found)] => Report::Examined(
                    self.examination.wanted(Examination::refused((**found).clone())),
                ),
                others => {
                    let file = path.to_string_lossy().into_owned();
                    let reasons: Vec<String> = others.iter().map(ToString::to_string).collect();
                    Report::Unread { file, reason: reasons.join("; ") }
                }
            },
        }
    }
}

impl Report {
    fn has_error(&self, code: &str) -> bool {
        match self {
            Report::Examined(Examination { found, .. }) => {
                found.iter().any(|one| one.severity == Severity::Error && one.code == code)
            }
            Report::Unread { .. } => false,
        }
    }

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
        answered(&format!("{}: no errors, no warnings\n", visible(name)), terminal)?;
    } else {
        let style = if terminal.colors { Style::Terminal } else { Style::Plain };
        writeln!(terminal.errors, "{}", in_flags(found.render(style).trim_end()))?;
    }
    Ok(())
}

fn explain(wanted: &str, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    let Some(page) = code::page(&wanted.to_uppercase()) else {
        return Err(Failure::Usage(vec![unknown(wanted)]));
    };
    Ok(terminal.output.write_all(page.as_bytes())?)
}
