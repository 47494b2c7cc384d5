//! Writes a log episode by episode.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use datafusion::arrow::array::{
    ArrayRef, FixedSizeListArray, Float64Array, Int64Array, RecordBatch,
};
use datafusion::arrow::datatypes::{DataType, Field, Schema};
use datafusion::parquet::arrow::ArrowWriter;

use super::Converted;

use crate::columns::doubles;
use crate::derivative::{Samples, derivatives};
use crate::error::Error;
use crate::log::{Place, properties};

/// The number of samples after which a part of an episode is written.
const PART: usize = 1 << 16;

/// A log that is being written.
pub(super) struct Episodes {
    place: Place,
    writer: ArrowWriter<File>,
    schema: Arc<Schema>,
    window: usize,
    samples: Samples,
    /// Torques, a column for each joint.
    torques: Option<Vec<Vec<f64>>>,
    /// The number of samples at the beginning that have been written and are kept for the windows of later samples.
    written: usize,
    converted: Converted,
}

impl Episodes {
    pub(super) fn new(
        path: &Path,
        joints: usize,
        torques: bool,
        window: usize,
    ) -> Result<Episodes, Error> {
        let kind = DataType::FixedSizeList(doubles(), i32::try_from(joints).unwrap_or(i32::MAX));
        let mut fields = vec![
            Field::new("episode", DataType::Int64, false),
            Field::new("t", DataType::Float64, false),
        ];
        let lists: &[&str] = if torques { &["q", "qd", "qdd", "tau"] } else { &["q", "qd", "qdd"] };
        fields.extend(lists.iter().map(|name| Field::new(*name, kind.clone(), false)));
        let schema = Arc::new(Schema::new(fields));
        let (place, file) = Place::create(path)?;
        let writer = ArrowWriter::try_new(file, schema.clone(), Some(properties(true)))
            .map_err(|error| Error::file(path, error))?;
        Ok(Episodes {
            place,
            writer,
            schema,
            window,
            samples: Samples { times: vec![], positions: vec![vec![]; joints] },
            torques: torques.then(|| vec![vec![]; joints]),
            written: 0,
            converted: Converted::default(),
        })
    }

    /// Whether the log has torques.
    pub(super) fn has_torques(&self) -> bool {
        self.torques.is_some()
    }

    /// Adds a sample: positions, and torques if the log has them.
    ///
    /// # Errors
    ///
    /// A time that is not after the previous one; `place` is its place in the recording, for the message.
    pub(super) fn push(
        &mut self,
        time: f64,
        positions: impl Iterator<Item = f64>,
        torques: impl Iterator<Item = f64>,
        place: &dyn Fn() -> String,
    ) -> Result<(), Error> {
        if let Some(last) = self.samples.times.last().filter(|last| **last >= time) {
            let what = if *last == time { "occurs twice" } else { "is before the previous one" };
            return Err(Error::Columns(format!(
                "{}: time {time} s {what} ({last} s); remove the sample",
                place()
            )));
        }
        self.samples.times.push(time);
        self.samples.positions.iter_mut().zip(positions).for_each(|(column, one)| column.push(one));
        for (column, torque) in self.torques.iter_mut().flatten().zip(torques) {
            column.push(torque);
        }
        if self.samples.times.len() - self.written >= PART + self.window {
            self.write(self.samples.times.len() - self.window)?;
        }
        Ok(())
    }

    /// Ends an episode.
    ///
    /// # Errors
    ///
    /// Errors while samples are written.
    pub(super) fn end(&mut self) -> Result<(), Error> {
        self.write(self.samples.times.len())?;
        if !self.samples.times.is_empty() {
            self.converted.episodes += 1;
        }
        self.keep(self.samples.times.len());
        self.written = 0;
        Ok(())
    }

    /// Completes the log and renames the file to its final path.
    ///
    /// # Errors
    ///
    /// Errors while the file is written or renamed.
    pub(super) fn finish(self) -> Result<Converted, Error> {
        self.writer.close().map_err(|error| Error::file(self.place.path(), error))?;
        self.place.keep()?;
        Ok(self.converted)
    }

    /// Writes the samples up to `end` that are not written yet, and drops the samples that no window needs any
    /// more.
    fn write(&mut self, end: usize) -> Result<(), Error> {
        let rows = self.written..end;
        let [velocities, accelerations] = derivatives(&self.samples, self.window);
        let episode = vec![self.converted.episodes as i64; rows.len()];
        let mut arrays: Vec<ArrayRef> = vec![
            Arc::new(Int64Array::from(episode)),
            Arc::new(Float64Array::from(self.samples.times[rows.clone()].to_vec())),
        ];
        let tables = [&self.samples.positions, &velocities, &accelerations];
        for columns in tables.into_iter().chain(&self.torques) {
            let entries =
                rows.clone().flat_map(|row| columns.iter().map(move |column| column[row]));
            let values = Arc::new(Float64Array::from(entries.collect::<Vec<f64>>()));
            let size = i32::try_from(columns.len()).unwrap_or(i32::MAX);
            let lists = FixedSizeListArray::try_new(doubles(), size, values, None);
            arrays.push(Arc::new(lists.map_err(|error| Error::file(self.place.path(), error))?));
        }
        let batch = RecordBatch::try_new(self.schema.clone(), arrays);
        let batch = batch.map_err(|error| Error::file(self.place.path(), error))?;
        self.writer.write(&batch).map_err(|error| Error::file(self.place.path(), error))?;
        self.converted.rows += rows.len() as u64;
        let needed = end.saturating_sub(self.window);
        self.keep(needed);
        self.written = end - needed;
        Ok(())
    }

    /// Drops the samples before `from`.
    fn keep(&mut self, from: usize) {
        self.samples.times.drain(..from);
        self.samples.positions.iter_mut().for_each(|column| drop(column.drain(..from)));
        self.torques.iter_mut().flatten().for_each(|column| drop(column.drain(..from)));
    }
}
