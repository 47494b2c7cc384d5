//! Trajectories that are read part by part.

use std::io::BufRead;

use robot_model::robot::Robot;

use crate::error::Error;
use crate::table::{TableReader, Times};
use crate::trajectory::Trajectory;

/// The samples of a trajectory in CSV, some of them in memory.
#[derive(Debug)]
pub struct Samples<'r, R> {
    robot: &'r Robot,
    source: String,
    reader: TableReader<R>,
    times: Times,
    wrong: Vec<String>,
    /// The first part, which was read to know what there is.
    first: Option<Trajectory>,
    size: usize,
}

impl<'r, R: BufRead> Samples<'r, R> {
    /// Reads the first part, of up to `size` samples; `source` is the name of the reader in messages. The columns are
    /// those of [`Trajectory::from_table`].
    ///
    /// # Errors
    ///
    /// What the reader says, everything that is wrong with the columns, and with the lines if the first part shows it.
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

    /// Whether tips exert wrenches.
    #[must_use]
    pub fn has_wrenches(&self) -> bool {
        self.first.as_ref().is_some_and(|first| first.wrenches.is_some())
    }

    /// The next part; `None` at the end.
    ///
    /// # Errors
    ///
    /// Everything that is wrong from there on to the end.
    pub fn next_part(&mut self) -> Result<Option<Trajectory>, Error> {
        if let Some(first) = self.first.take() {
            return Ok(Some(first));
        }
        // What is wrong with the lines comes before what is wrong with the columns.
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
