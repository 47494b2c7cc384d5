//! The state of a watched robot, and its change with each reading of the files. This code does not access the system.

use std::fmt::Write as _;

use robot_build::{Error, Errors, Options, Plan, Source};
use robot_check::difference::{Difference, Options as DifferenceOptions, difference};
use robot_check::doctor;
use robot_model::diagnostic::{Severity, Style, render, render_group};
use robot_model::robot::Robot;

use crate::commands::diff::show;
use crate::failure::in_command_words;
use crate::options::in_flags;
use crate::reading::ReadingArguments;
use crate::text::counted;

/// The contents of the files at one time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reading {
    /// The robot file, or the reason why it cannot be read.
    pub(super) source: Result<Source, Errors>,
    /// Its pinned plan, or the reason why this is not valid.
    pub(super) plan: Result<Option<Plan>, Errors>,
}

/// The options for printing changes.
pub(super) struct Settings<'a> {
    /// The tolerance of angles in rad, if one is given.
    pub(super) snap: Option<f64>,
    /// The options for reading that turn errors into warnings.
    pub(super) reading: ReadingArguments,
    /// The largest number of terms of each equation that are shown.
    pub(super) terms: usize,
    /// The style of errors and warnings.
    pub(super) style: Style,
    /// A function that prints the time of day, if it is shown.
    pub(super) clock: Option<&'a (dyn Fn() -> String + Sync)>,
}

/// The state after a reading.
#[derive(Default)]
pub(super) struct State {
    /// The number of earlier readings.
    number: usize,
    /// The last reading with a valid robot.
    valid: Option<ValidRobot>,
    /// The present errors; `None` if the file describes a robot.
    wrong: Option<Vec<Problem>>,
}

/// The robot of a reading whose file was valid.
#[derive(Clone)]
struct ValidRobot {
    number: usize,
    source: Source,
    robot: Robot,
    plan: Option<Plan>,
    problems: Vec<Problem>,
}

/// An error, or a warning.
#[derive(Clone)]
struct Problem {
    /// The message on one line, without a place. It identifies the problem, even if lines move.
    line: String,
    /// The complete text.
    text: String,
}

/// The output of a reading.
pub(super) struct Shown {
    /// The title, which gives the number of the save.
    pub(super) title: String,
    /// Errors and warnings.
    pub(super) problems: String,
    /// The changes.
    pub(super) changes: String,
}

impl State {
    /// Whether the file describes a valid robot now.
    pub(super) fn is_good(&self) -> bool {
        self.valid.is_some() && self.wrong.is_none()
    }

    /// The options for code of the last valid robot.
    pub(super) fn options(&self, settings: &Settings<'_>) -> Options {
        let plan = self.valid.as_ref().and_then(|valid| valid.plan.clone());
        Options { snap: settings.snap, plan, ..settings.reading.options() }
    }

    /// Returns the state after a reading, and the output.
    pub(super) fn after(&self, reading: &Reading, settings: &Settings<'_>) -> (State, Shown) {
        let number = self.number;
        let read = reading.source.as_ref().map_err(|errors| of_errors(errors, settings.style));
        match read.and_then(|source| valid(number, source, &reading.plan, settings)) {
            Ok(valid) => {
                let shown = self.after_valid(&valid, settings);
                (State { number: number + 1, valid: Some(valid), wrong: None }, shown)
            }
            Err(wrong) => {
                let shown = self.after_errors(&wrong, settings);
                (State { number: number + 1, valid: self.valid.clone(), wrong: Some(wrong) }, shown)
            }
        }
    }

    /// The output for a valid robot.
    fn after_valid(&self, now: &ValidRobot, settings: &Settings<'_>) -> Shown {
        let before = self.valid.iter().flat_map(|valid| &valid.problems);
        let before: Vec<&Problem> = before.chain(self.wrong.iter().flatten()).collect();
        let problems = texts(new_problems(&now.problems, &before));
        let resolved = resolved_lines(before, &now.problems);
        let Some(valid) = &self.valid else {
            let (coordinates, parameters) =
                (now.robot.degrees_of_freedom(), now.robot.parameters.len());
            let changes = format!(
                "{resolved}{}: {}, {}; watching\n",
                now.robot.name,
                counted(coordinates, "coordinate"),
                counted(parameters, "parameter")
            );
            return Shown { title: title(self.number, None, settings), problems, changes };
        };
        let found = difference(&valid.robot, &now.robot, &compared(valid, now, settings));
        let differences = differences(&found, settings.terms);
        let none = if differences.is_empty() { "no changes in the robot\n" } else { "" };
        let title = title(self.number, Some(valid.number), settings);
        Shown { title, problems, changes: format!("{resolved}{differences}{none}") }
    }

    /// The output for a file that does not describe a robot.
    fn after_errors(&self, wrong: &[Problem], settings: &Settings<'_>) -> Shown {
        let resolved = resolved_lines(self.wrong.iter().flatten().collect(), wrong);
        let stands = match &self.valid {
            None => "the file has errors; waiting for a save without errors".to_owned(),
            Some(valid) => {
                format!(
                    "the file has errors; the last valid robot, from {}, is kept",
                    name(valid.number)
                )
            }
        };
        Shown {
            title: title(self.number, None, settings),
            problems: texts(wrong.iter().collect()),
            changes: format!("{resolved}{stands}\n"),
        }
    }
}

/// Returns the robot of a file, or all its errors.
fn valid(
    number: usize,
    source: &Source,
    plan: &Result<Option<Plan>, Errors>,
    settings: &Settings<'_>,
) -> Result<ValidRobot, Vec<Problem>> {
    let style = settings.style;
    let options = settings.reading.options();
    let described =
        robot_build::read_with(source, &options).map_err(|errors| of_errors(&errors, style))?;
    let examination = doctor::examine(&described);
    let mut problems: Vec<Problem> = examination
        .found
        .groups()
        .iter()
        .map(|group| Problem {
            line: line(group.first.severity, group.first.code, &group.message()),
            text: in_flags(&render_group(source, group, style)),
        })
        .collect();
    let (plan, stale) = match plan {
        Ok(plan) => (plan.clone(), vec![]),
        Err(errors) => (None, errors.as_slice().to_vec()),
    };
    problems.extend(stale.iter().map(|error| {
        let line = format!("warning: {}", in_command_words(error));
        Problem { text: line.clone(), line }
    }));
    Ok(ValidRobot { number, source: source.clone(), robot: described.robot, plan, problems })
}

fn of_errors(errors: &Errors, style: Style) -> Vec<Problem> {
    let mut found = vec![];
    for error in errors.as_slice() {
        match error {
            Error::Robot(diagnostics) => found.extend(diagnostics.iter().map(|one| Problem {
                line: line(one.severity, one.code, &one.message),
                text: in_flags(&render(diagnostics.source(), one, style)),
            })),
            other => {
                let line = format!("error: {}", in_command_words(other));
                found.push(Problem { text: line.clone(), line });
            }
        }
    }
    found
}

/// Prints a problem on one line: `error[R0303]: …`.
fn line(severity: Severity, code: &str, message: &str) -> String {
    let severity = match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    format!("{severity}[{code}]: {message}")
}

/// Returns the problems that are not in `among`.
fn new_problems<'p>(problems: &'p [Problem], among: &[&Problem]) -> Vec<&'p Problem> {
    let is_new = |one: &&Problem| among.iter().all(|other| other.line != one.line);
    problems.iter().filter(is_new).collect()
}

fn texts(problems: Vec<&Problem>) -> String {
    problems.into_iter().map(|one| format!("{}\n\n", one.text.trim_end())).collect()
}

/// Prints a line for each problem that no longer exists.
fn resolved_lines(before: Vec<&Problem>, now: &[Problem]) -> String {
    let is_resolved = |one: &&Problem| now.iter().all(|other| other.line != one.line);
    // The message of a parser about a pinned plan has several lines.
    let first = |one: &Problem| one.line.lines().next().unwrap_or_default().to_owned();
    before.into_iter().filter(is_resolved).map(|one| format!("gone: {}\n", first(one))).collect()
}

/// The name of a reading of the file: `save 3`, or `the start`.
fn name(number: usize) -> String {
    match number {
        0 => "the start".to_owned(),
        number => format!("save {number}"),
    }
}

/// The title of a reading: empty for the start, otherwise a blank line and `save 3, 14:02:31, from save 2:`.
fn title(number: usize, from: Option<usize>, settings: &Settings<'_>) -> String {
    if number == 0 {
        return String::new();
    }
    let time = settings.clock.map(|clock| format!(", {}", clock())).unwrap_or_default();
    let from = from.map(|from| format!(", from {}", name(from))).unwrap_or_default();
    format!("\n{}{time}{from}:\n", name(number))
}

/// Chooses the plans under which two robots are compared: their own, if both have one. A pinned plan becomes stale with
/// each change of the mechanics; a comparison with the default plan would then show a difference of plans, not of
/// robots.
fn compared(before: &ValidRobot, now: &ValidRobot, settings: &Settings<'_>) -> DifferenceOptions {
    let own = before.plan.is_some() == now.plan.is_some() || before.source == now.source;
    let code = [before, now].map(|one| Options {
        snap: settings.snap,
        plan: one.plan.clone().filter(|_| own),
        ..settings.reading.options()
    });
    DifferenceOptions { code, seed: 0, states: 0 }
}

/// Prints the parts with differences, each under its title.
fn differences(found: &Difference, terms: usize) -> String {
    let mut shown = String::new();
    for (title, lines) in show::parts(found, terms) {
        if !lines.is_empty() {
            // Writing to a string does not fail.
            let _ = write!(shown, "{title}\n{lines}");
        }
    }
    shown
}
