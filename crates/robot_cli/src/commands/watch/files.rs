//! Detects when a robot file and its pinned plan are saved.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use robot_build::{Options, RobotFile};

use super::state::Look;

/// The time between two looks at the files.
///
/// Texts are compared, not modification times, which are too coarse on some systems for two saves in quick
/// succession. The path is opened again for each look, because editors save by replacing the old file with
/// another.
const PAUSE: Duration = Duration::from_millis(20);
/// The number of equal looks in a row after which a text counts as saved, because editors write in pieces.
const SETTLED: usize = 2;
/// The same number if the file is missing or empty, as it is between two steps of a save, on a busy disk for some time.
const SETTLED_AWAY: usize = 50;

/// An iterator over looks at a file that show a new content, until `is_over` is set.
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
    type Item = Look;

    fn next(&mut self) -> Option<Look> {
        while !self.is_over.load(Ordering::Relaxed) {
            let settled = self.settling.after(look(self.path, &self.options));
            if settled.is_some() {
                return settled;
            }
            std::thread::sleep(PAUSE);
        }
        None
    }
}

/// Selects the looks that are new and stable.
#[derive(Default)]
pub(super) struct Settling {
    /// The last look that was selected.
    last: Option<Look>,
    /// The present candidate, and how often it was seen in a row.
    seen: Option<(Look, usize)>,
}

impl Settling {
    /// Returns the look if it is new and was seen often enough.
    pub(super) fn after(&mut self, look: Look) -> Option<Look> {
        let times = match self.seen.take() {
            Some((earlier, times)) if earlier == look => times + 1,
            _ => 1,
        };
        if self.last.as_ref() == Some(&look) {
            return None;
        }
        if times < needed(&look) {
            self.seen = Some((look, times));
            return None;
        }
        self.last = Some(look.clone());
        Some(look)
    }
}

fn needed(look: &Look) -> usize {
    match &look.source {
        Ok(source) if !source.text.trim().is_empty() => SETTLED,
        _ => SETTLED_AWAY,
    }
}

/// Reads the present contents of the files.
fn look(path: &Path, options: &Options) -> Look {
    let file = RobotFile::read(path);
    let plan = match &file {
        Ok(file) => file.with_pin(options).map(|options| options.plan),
        Err(_) => Ok(None),
    };
    Look { source: file.map(|file| file.source), plan }
}
