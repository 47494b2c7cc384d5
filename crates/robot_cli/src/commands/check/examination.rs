//! The findings about a robot file, and the choice of those that are shown: shared by `check` and `lsp`.

use clap::Args;
use robot_build::RobotFile;
use robot_check::doctor::{self, Examination};
use robot_model::diagnostic::{Diagnostic, Diagnostics, Severity, Source, code};

use super::Report;
use crate::Terminal;
use crate::failure::{Failure, in_command_words};
use crate::function::check_once;
use crate::plan::is_of_pin;
use crate::reading::ReadingArguments;
use crate::suggested::CODE;
use crate::text;

/// The options of an examination.
#[derive(Args)]
pub(crate) struct ExaminationArguments {
    /// Hide warnings and notes with these codes
    #[arg(long, value_name = "CODE", value_delimiter = ',', value_parser = CODE,
          hide_possible_values = true)]
    allow: Vec<String>,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl ExaminationArguments {
    /// Returns an error for codes that do not exist.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        check_once("--allow", &self.allow)?;
        let unknown_codes = self.allow.iter().filter(|code| code::page(code).is_none());
        let wrong: Vec<String> = unknown_codes.map(|code| unknown(code)).collect();
        if wrong.is_empty() { Ok(()) } else { Err(Failure::Usage(wrong)) }
    }

    /// Prints a note for each allowed code with which errors remain, because only warnings and notes can be hidden.
    pub(super) fn note_kept(
        &self,
        reports: &[Report],
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        for code in &self.allow {
            if reports.iter().any(|report| report.has_error(code)) {
                writeln!(
                    terminal.errors,
                    "note: --allow {code} hides warnings and notes, but not errors"
                )?;
            }
        }
        Ok(())
    }

    /// Examines a text that is not a file, or that has no pinned plan.
    pub(crate) fn of_source(&self, source: &Source) -> Examination {
        self.wanted(self.all(source))
    }

    /// Examines a file together with the pinned plan beside it. The text is that of `file`, not that on the disk.
    pub(crate) fn of_file(&self, file: &RobotFile) -> Examination {
        self.wanted(with_pin(self.all(&file.source), file))
    }

    fn all(&self, source: &Source) -> Examination {
        doctor::check(&source.name, &source.text, &self.reading.options().reading())
    }

    /// Removes warnings that the command line allows; errors always stay.
    pub(super) fn wanted(&self, examination: Examination) -> Examination {
        let Examination { found, choices } = examination;
        let [found, choices] = [found, choices].map(|list| {
            let wanted = list.iter().filter(|one| {
                one.severity == Severity::Error || self.allow.iter().all(|code| code != one.code)
            });
            Diagnostics::new(list.source().clone(), wanted.cloned().collect())
        });
        Examination { found, choices }
    }
}

/// The message that there is no such code.
pub(super) fn unknown(wanted: &str) -> String {
    let known: Vec<&str> = code::TABLE.iter().map(|(code, _)| *code).collect();
    text::unknown("code", wanted, &known)
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
