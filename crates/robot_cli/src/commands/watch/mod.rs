//! `watch`: the changes of a robot at each save of its file.

mod files;
mod page;
mod state;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use robot_model::diagnostic::Style;
use time::{OffsetDateTime, UtcOffset};

use super::diff::show;
use crate::Terminal;
use crate::delivery::{ForceArgument, file_of};
use crate::failure::Failure;
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::screen::is_colored;
use crate::values::whole;
use files::Files;
use page::Page;
use state::{Reading, Settings, Shown, State};

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic watch robots/trttr1.toml
  robot-symbolic watch robots/trttr1.toml --report trttr1.html

Derives the robot again whenever its file or its pinned plan is saved, and shows what has changed since the last
save without errors: parameters, links, joints and frames, terms of the joint torques, operations, new and
resolved errors and warnings. If the file has errors or is missing, the command waits for the next save. With
--report, the page is rewritten at each save without errors; a browser that shows it reloads it and keeps the
scroll position. If no page can be made for a robot, the last page is kept. Operations are counted under the
pinned plans, or under the default plan if either save has no plan; the command never searches.

Changes go to standard output, errors and warnings to standard error. Ctrl-C ends the command. Exit codes: 0 if
the last save had no errors and its page was written; 1 otherwise; 2 if the command line is wrong.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Also write a page about the robot, like that of `report --without-compiler --without-live`
    #[arg(long, value_name = "PATH")]
    report: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgument,
    /// Maximum number of terms shown per equation
    #[arg(long, default_value_t = 20, value_parser = whole(0_usize..), allow_negative_numbers = true)]
    terms: usize,
    /// End after this many saves [default: run until Ctrl-C]
    #[arg(long, value_name = "COUNT", value_parser = whole(0_usize..), allow_negative_numbers = true)]
    saves: Option<usize>,
}

/// Whether Ctrl-C was pressed or a signal asked the process to end.
static OVER: AtomicBool = AtomicBool::new(false);

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let clock = clock();
        // A path that is wrong from the start is an error; the command does not wait for the file.
        self.robot.source()?;
        if self.report.is_some() && file_of(self.report.as_deref()).is_none() {
            let message = "--report needs a file, which is rewritten at each save; name one";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let writer = self.force.writer(self.robot.inputs(), self.report.is_some())?;
        let page = self.report.clone().map(|path| Page::open(path, writer)).transpose()?;
        ctrlc::set_handler(|| OVER.store(true, Ordering::Relaxed))
            .map_err(|error| Failure::input(format!("cannot wait for Ctrl-C: {error}")))?;
        self.robot.check_base_frames(&[], terminal)?;
        let saves = self.saves.unwrap_or(usize::MAX);
        let options = self.robot.reading.options();
        let readings = Files::new(self.robot.path(), options, &OVER).take(saves.saturating_add(1));
        let style = if terminal.colors { Style::Terminal } else { Style::Plain };
        let reading = self.robot.reading;
        // Output to a file or a pipe must not depend on the time.
        let clock = terminal.screen.map(|_| &clock as &(dyn Fn() -> String + Sync));
        let snap = self.robot.snap();
        let settings = Settings { snap, reading, terms: self.terms, style, clock };
        follow(readings, &settings, page, terminal)
    }
}

/// Returns a function that prints the time of day: local time, if the system gives the offset from UTC. It does
/// so only while there is a single thread.
fn clock() -> impl Fn() -> String {
    let local = UtcOffset::current_local_offset().ok();
    move || {
        let now = OffsetDateTime::now_utc().to_offset(local.unwrap_or(UtcOffset::UTC));
        let zone = if local.is_some() { "" } else { " UTC" };
        format!("{:02}:{:02}:{:02}{zone}", now.hour(), now.minute(), now.second())
    }
}

/// Prints, for each reading of the files, what has changed since the last one, and rewrites the page if there is one.
fn follow(
    readings: impl Iterator<Item = Reading>,
    settings: &Settings<'_>,
    mut page: Option<Page>,
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    let mut state = State::default();
    let mut has_page = true;
    let followed = readings.into_iter().try_for_each(|reading| {
        let shown;
        (state, shown) = watched("deriving", terminal, || state.after(&reading, settings));
        let Shown { title, problems, changes } = shown;
        let [title, changes] = [title, changes].map(|text| match is_colored(terminal.screen) {
            true => show::colored(&text),
            false => text,
        });
        write!(terminal.output, "{title}").and_then(|()| terminal.output.flush())?;
        write!(terminal.errors, "{problems}").and_then(|()| terminal.errors.flush())?;
        write!(terminal.output, "{changes}").and_then(|()| terminal.output.flush())?;
        match (&mut page, state.is_good().then_some(&reading.source)) {
            (Some(page), Some(Ok(source))) => {
                let options = state.options(settings);
                let made = watched("writing", terminal, || Page::made(source, &options));
                has_page = made.is_ok();
                match made {
                    Ok(made) => page.write(made),
                    // The next save may result in a page.
                    Err(error) => {
                        Failure::from(error).report(terminal);
                        Ok(writeln!(terminal.errors, "{}", page.described())?)
                    }
                }
            }
            _ => Ok(()),
        }
    });
    // The last page stays, without the part that reloads it, however the watch has ended.
    page.map_or(Ok(()), Page::finish).and(followed)?;
    if state.is_good() && has_page { Ok(()) } else { Err(Failure::Shown) }
}

#[cfg(test)]
mod tests;
