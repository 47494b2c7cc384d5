//! Trajectories that are read in parts.

use std::io::BufRead;

use robot_model::robot::Robot;

use crate::error::Error;
use crate::table::{TableReader, Times};
use crate::trajectory::Trajectory;

/// The samples of a trajectory in a CSV file, of which one part is in memory at a time.
#[derive(Debug)]
pub struct Samples<'r, R> {
    robot: &'r Robot,
    source: String,
    reader: TableReader<R>,
    times: Times,
    wrong: Vec<String>,
    /// The first part, which is read at once to find out which columns there are.
    first: Option<Trajectory>,
    size: usize,
}

impl<'r, R: BufRead> Samples<'r, R> {
    /// Reads the first part, with up to `size` samples; `source` is the name of the reader in messages. The columns are
    /// those of [`Trajectory::from_table`].
    ///
    /// # Errors
    ///
    /// If the reader fails; all errors in the columns, and in the lines as far as they have been read.
    pub fn new(
        robot: &'r Robot,
        source: &str,
        reader: R,
        size: usize,
    ) -> Result<Samples<'r, R>, Error> {
        let reader = TableReader::new(source, reader)?;
        let (times, source) = (Times::default(), source.to_owned());
        let (wrong, first) = (vec![], None);
        let mut samples = Samples { robot, source, reader, times, wrong, first, size };
        samples.first = samples.next_part()?;
        Ok(samples)
    }

    /// Whether the trajectory contains wrenches of tips.
    #[must_use]
    pub fn has_wrenches(&self) -> bool {
        self.first.as_ref().is_some_and(|first| first.wrenches.is_some())
    }

    /// Reads the next part; `None` at the end.
    ///
    /// # Errors
    ///
    /// All errors from there to the end.
    pub fn next_part(&mut self) -> Result<Option<Trajectory>, Error> {
        if let Some(first) = self.first.take() {
            return Ok(Some(first));
        }
        // Errors in lines are reported before errors in columns.
        while let Some(table) = self.reader.rows(self.size.max(1))? {
            self.times.check(&self.source, &table);
            let mut wrong = vec![];
            let part = Trajectory::from_columns(self.robot, &self.source, &table, &mut wrong);
            self.wrong = wrong;
            if self.wrong.is_empty() && self.times.wrong.is_none() {
                return Ok(Some(part));
            }
        }
        let wrong = self.times.wrong.take().into_iter().chain(self.wrong.drain(..));
        Error::check(wrong.collect(), None)
    }
}
