//! The progress of a long run, on a terminal.

use std::io::Write;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crate::Terminal;

/// A line on standard error that shows the progress of a run, only on a terminal, and only if the
/// run takes longer than a second.
pub(crate) struct Progress<'e> {
    errors: Option<&'e mut dyn Write>,
    /// The time of the next output.
    next: Instant,
    shown: bool,
}

/// The time before the first line is shown.
const PATIENCE: Duration = Duration::from_secs(1);
/// The time between two lines.
const PAUSE: Duration = Duration::from_millis(100);

impl<'e> Progress<'e> {
    pub(crate) fn new(terminal: &'e mut Terminal<'_>) -> Progress<'e> {
        let errors = terminal.progress.then_some(&mut *terminal.errors as &mut dyn Write);
        Progress { errors, next: Instant::now() + PATIENCE, shown: false }
    }

    /// Shows the line, if enough time has passed.
    pub(crate) fn show(&mut self, line: impl FnOnce() -> String) {
        let now = Instant::now();
        if let Some(errors) = self.errors.as_mut().filter(|_| now >= self.next) {
            // If this fails, nobody sees the line.
            let _ = write!(errors, "\r\x1b[K{}", line()).and_then(|()| errors.flush());
            self.next = now + PAUSE;
            self.shown = true;
        }
    }
}

/// Does work that does not report progress, and shows the time that has passed.
pub(crate) fn watched<T: Send>(
    what: &str,
    terminal: &mut Terminal<'_>,
    work: impl FnOnce() -> T + Send,
) -> T {
    if !terminal.progress {
        return work();
    }
    let mut progress = Progress::new(terminal);
    let start = Instant::now();
    std::thread::scope(|scope| {
        let (done, ended) = channel::<()>();
        let worker = scope.spawn(move || {
            // Dropped when the work is done or panics.
            let _done = done;
            work()
        });
        while ended.recv_timeout(PAUSE) == Err(RecvTimeoutError::Timeout) {
            progress.show(|| format!("{what}: {} s", start.elapsed().as_secs()));
        }
        worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// Removes the line when the run is over.
impl Drop for Progress<'_> {
    fn drop(&mut self) {
        if let Some(errors) = self.errors.as_mut().filter(|_| self.shown) {
            let _ = write!(errors, "\r\x1b[K").and_then(|()| errors.flush());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The output of work that takes two seconds.
    fn shown(progress: bool) -> String {
        let (mut output, mut errors) = (vec![], vec![]);
        let mut terminal = Terminal {
            input: &mut std::io::empty(),
            output: &mut output,
            errors: &mut errors,
            colors: false,
            progress,
            screen: None,
        };
        let answer = watched("thinking", &mut terminal, || {
            std::thread::sleep(Duration::from_millis(1500));
            42
        });
        assert_eq!((answer, output.len()), (42, 0));
        String::from_utf8_lossy(&errors).into_owned()
    }

    #[test]
    fn long_work_is_told_of_on_a_terminal_alone() {
        let told = shown(true);
        assert!(told.starts_with("\r\x1b[Kthinking: 1 s"), "{told:?}");
        assert!(told.ends_with("\r\x1b[K"), "{told:?}");
        assert_eq!(shown(false), "");
    }

    #[test]
    fn lines_are_no_closer_than_the_pause() {
        let mut errors = vec![];
        let start = Instant::now();
        let mut progress = Progress { errors: Some(&mut errors), next: start, shown: false };
        for round in 0..1000 {
            progress.show(|| format!("{round}."));
        }
        let pauses = start.elapsed().as_millis() / PAUSE.as_millis();
        drop(progress);
        let lines = errors.iter().filter(|byte| **byte == b'.').count();
        assert!(lines > 0 && lines as u128 <= 1 + pauses, "{lines} lines, {pauses} pauses");
    }
}
