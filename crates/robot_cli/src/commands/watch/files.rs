//! Detects when a robot file and its pinned plan are saved.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use robot_build::{Options, RobotFile};

use super::state::Reading;

/// The time between two readings of the files.
///
/// Texts are compared, not modification times, which are too coarse on some systems for two saves in quick
/// succession. The path is opened again for each reading, because editors save by replacing the old file with
/// another.
const PAUSE: Duration = Duration::from_millis(20);
/// The number of equal readings in a row after which a text counts as saved, because editors write in pieces.
const SETTLED: usize = 2;
/// The same number if the file is missing or empty, as it is between two steps of a save, on a busy disk for some time.
const SETTLED_AWAY: usize = 50;

/// An iterator over readings of a file that show a new content, until `is_over` is set.
pub(super) struct Files<'a> {
    path: &'a Path,
    /// The options for reading the file, which are needed to read its pinned plan.
    options: Options,
    is_over: &'a AtomicBool,
    settling: Settling,
}

impl<'a> Files<'a> {
    pub(super) fn new(path: &'a Path, options: Options, is_over: &'a AtomicBool) -> Files<'a> {
        Files { path, options, is_over, settling: Settling::default() }
    }
}

impl Iterator for Files<'_> {
    type Item = Reading;

    fn next(&mut self) -> Option<Reading> {
        while !self.is_over.load(Ordering::Relaxed) {
            let settled = self.settling.after(reading(self.path, &self.options));
            if settled.is_some() {
                return settled;
            }
            std::thread::sleep(PAUSE);
        }
        None
    }
}

/// Selects the readings that are new and stable.
#[derive(Default)]
pub(super) struct Settling {
    /// The reading that was returned last.
    last: Option<Reading>,
    /// The present candidate, and how often it was seen in a row.
    seen: Option<(Reading, usize)>,
}

impl Settling {
    /// Returns the reading if it is new and was seen often enough.
    pub(super) fn after(&mut self, reading: Reading) -> Option<Reading> {
        let times = match self.seen.take() {
            Some((earlier, times)) if earlier == reading => times + 1,
            _ => 1,
        };
        if self.last.as_ref() == Some(&reading) {
            return None;
        }
        if times < needed(&reading) {
            self.seen = Some((reading, times));
            return None;
        }
        self.last = Some(reading.clone());
        Some(reading)
    }
}

fn needed(reading: &Reading) -> usize {
    match &reading.source {
        Ok(source) if !source.text.trim().is_empty() => SETTLED,
        _ => SETTLED_AWAY,
    }
}

/// Reads the present contents of the files.
fn reading(path: &Path, options: &Options) -> Reading {
    let file = RobotFile::read(path);
    let plan = match &file {
        Ok(file) => file.with_pin(options).map(|options| options.plan),
        Err(_) => Ok(None),
    };
    Reading { source: file.map(|file| file.source), plan }
}
