//! Detects when a robot file and its pin are saved.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use robot_build::{Options, RobotFile};

use super::state::Look;

/// The time from one look at the files to the next.
///
/// Texts are compared, not the times of files, which are too coarse on some systems for two saves in a
/// row; and the path is looked up anew each time, for editors save by putting another file in the place of
/// the old one.
const PAUSE: Duration = Duration::from_millis(20);
/// The looks that must agree before a text counts as saved: editors write in pieces.
const SETTLED: usize = 2;
/// The wait if the file is missing or empty: between two steps of a save it is, on a busy disk for long.
const SETTLED_AWAY: usize = 50;

/// The looks at a file that show something new, the first one at once, until it is over.
pub(super) struct Files<'a> {
    path: &'a Path,
    /// The options of reading the file, without which a pin of it cannot be read.
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

/// Which of many looks are new and will last.
#[derive(Default)]
pub(super) struct Settling {
    /// The last one that was both.
    last: Option<Look>,
    /// One that may be, and how often it was seen in a row.
    seen: Option<(Look, usize)>,
}

impl Settling {
    /// The look, if it is new and was seen often enough.
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

/// The present contents of the files.
fn look(path: &Path, options: &Options) -> Look {
    let file = RobotFile::read(path);
    let plan = match &file {
        Ok(file) => file.with_pin(options).map(|options| options.plan),
        Err(_) => Ok(None),
    };
    Look { source: file.map(|file| file.source), plan }
}
