//! How far a long run has come, on a terminal.

use std::io::Write;
use std::time::{Duration, Instant};

use crate::Terminal;

/// A line on standard error that says how far a run has come: on a terminal only, and only where the
/// run takes longer than a second.
pub(crate) struct Progress<'e> {
    errors: Option<&'e mut dyn Write>,
    /// When it is next shown.
    next: Instant,
    shown: bool,
}

/// How long a run is watched in silence.
const PATIENCE: Duration = Duration::from_secs(1);
/// The time from one line to the next.
const PAUSE: Duration = Duration::from_millis(100);

impl<'e> Progress<'e> {
    pub(crate) fn new(terminal: &'e mut Terminal<'_>) -> Progress<'e> {
        let errors = terminal.colours.then_some(&mut *terminal.errors as &mut dyn Write);
        Progress { errors, next: Instant::now() + PATIENCE, shown: false }
    }

    /// Shows the line, where it is time.
    pub(crate) fn show(&mut self, line: impl FnOnce() -> String) {
        let now = Instant::now();
        if let Some(errors) = self.errors.as_mut().filter(|_| now >= self.next) {
            // Nobody is watching where this fails.
            let _ = write!(errors, "\r\x1b[K{}", line()).and_then(|()| errors.flush());
            self.next = now + PAUSE;
            self.shown = true;
        }
    }
}

/// The line goes when the run is over.
impl Drop for Progress<'_> {
    fn drop(&mut self) {
        if let Some(errors) = self.errors.as_mut().filter(|_| self.shown) {
            let _ = write!(errors, "\r\x1b[K").and_then(|()| errors.flush());
        }
    }
}
