//! The progress of a query on the terminal.

use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::time::Duration;

use datafusion::physical_plan::ExecutionPlan;
use tokio::task::JoinHandle;

/// The time between two messages.
const PAUSE: Duration = Duration::from_millis(500);

/// Shows the progress of a query until it is dropped.
#[derive(Debug)]
pub struct Progress(Option<JoinHandle<()>>);

impl Progress {
    /// If standard error is a terminal, shows the percentage of `rows` that the plan has read from files so far.
    #[must_use]
    pub fn of(plan: &Arc<dyn ExecutionPlan>, rows: Option<u64>) -> Progress {
        let rows = rows.filter(|rows| *rows > 0 && std::io::stderr().is_terminal());
        let plan = plan.clone();
        Progress(rows.map(|rows| {
            tokio::spawn(async move {
                loop {
                    tokio::time::sleep(PAUSE).await;
                    let percent = 100 * read(plan.as_ref()).min(rows) / rows;
                    // The query continues if the terminal no longer exists.
                    let mut terminal = std::io::stderr();
                    let _ = write!(terminal, "\r{percent:3} %\r");
                    let _ = terminal.flush();
                }
            })
        }))
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(task) = &self.0 {
            task.abort();
        }
    }
}

/// The rows that a plan has read from files.
fn read(plan: &dyn ExecutionPlan) -> u64 {
    let children = plan.children();
    if children.is_empty() {
        let rows = plan.metrics().and_then(|metrics| metrics.output_rows());
        return rows.unwrap_or(0) as u64;
    }
    children.into_iter().map(|child| read(child.as_ref())).sum()
}
