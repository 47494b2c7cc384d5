//! Results as files: Parquet or CSV, complete or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use datafusion::arrow::array::UInt64Array;
use datafusion::arrow::array::{Array, ArrayRef, AsArray, RecordBatch};
use datafusion::arrow::compute::take;
use datafusion::arrow::csv;
use datafusion::arrow::datatypes::{DataType, Field, Schema, SchemaRef};
use datafusion::execution::SendableRecordBatchStream;
use datafusion::parquet::arrow::ArrowWriter;
use datafusion::parquet::basic::{Compression, ZstdLevel};
use datafusion::parquet::file::metadata::KeyValue;
use datafusion::parquet::file::properties::WriterProperties;
use datafusion::physical_plan::{execute_stream, execute_stream_partitioned};
use datafusion::prelude::DataFrame;
use futures::StreamExt;

use super::place::{Place, empty_folder};
use super::progress::Progress;
use crate::error::Error;

/// The destination of a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// A Parquet file; its rows are in the order of the log if the session has one thread.
    Parquet(PathBuf),
    /// A CSV file; lists become a column for each entry.
    Csv(PathBuf),
    /// A folder with a Parquet file for each thread, `part-0000.parquet` and so on.
    Folder(PathBuf),
}

impl Answer {
    /// Chooses the destination by the extension of the path: `.parquet`, `.csv`, or none for a folder.
    ///
    /// # Errors
    ///
    /// Other extensions.
    pub fn at(path: &Path) -> Result<Answer, Error> {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("parquet") => Ok(Answer::Parquet(path.to_owned())),
            Some("csv") => Ok(Answer::Csv(path.to_owned())),
            None => Ok(Answer::Folder(path.to_owned())),
            Some(_) => {
                let reason = "the output must be a .parquet or .csv file, or a folder, whose name has no extension";
                Err(Error::file(path, reason))
            }
        }
    }
}

/// Computes a table and writes it. Returns the number of rows, which must be `wanted`, if that is given.
///
/// # Errors
///
/// Errors while the table is computed or written; another number of rows. Then no file remains.
pub async fn write(table: DataFrame, answer: &Answer, wanted: Option<u64>) -> Result<u64, Error> {
    let schema = table.schema().inner().clone();
    let context = Arc::new(table.task_ctx());
    let plan = table.create_physical_plan().await?;
    let _progress = Progress::of(&plan, wanted);
    let mut sinks = vec![];
    match answer {
        Answer::Parquet(path) => {
            let sink = Sink::new(path, schema, Kind::Parquet)?;
            sinks.push(drain(execute_stream(plan, context)?, sink).await?);
        }
        Answer::Csv(path) => {
            let sink = Sink::new(path, schema, Kind::Csv)?;
            sinks.push(drain(execute_stream(plan, context)?, sink).await?);
        }
        Answer::Folder(folder) => {
            empty_folder(folder)?;
            let mut parts = vec![];
            let streams = execute_stream_partitioned(plan, context)?;
            for (place, stream) in streams.into_iter().enumerate() {
                let path = folder.join(format!("part-{place:04}.parquet"));
                let sink = Sink::new(&path, schema.clone(), Kind::Parquet)?;
                parts.push(tokio::spawn(drain(stream, sink)));
            }
            for part in parts {
                sinks.push(part.await.map_err(|error| Error::Query(error.to_string()))??);
            }
        }
    }
    let rows = sinks.iter().map(|sink| sink.rows).sum();
    is_whole(rows, wanted)?;
    sinks.into_iter().try_for_each(Sink::finish)?;
    Ok(rows)
}

/// Checks that a result has as many rows as its log, if that number is known, so that a result with a lost part is
/// not mistaken for a complete one.
///
/// # Errors
///
/// Another number of rows.
pub fn is_whole(rows: u64, wanted: Option<u64>) -> Result<(), Error> {
    match wanted.filter(|wanted| *wanted != rows) {
        None => Ok(()),
        Some(wanted) => Err(Error::Query(format!(
            "the result has {rows} of the log's {wanted} rows and was not kept; perhaps files have changed: repeat the \
             query"
        ))),
    }
}

pub(super) async fn drain(
    mut stream: SendableRecordBatchStream,
    mut sink: Sink,
) -> Result<Sink, Error> {
    while let Some(batch) = stream.next().await {
        sink.push(&batch?)?;
    }
    Ok(sink)
}

enum Kind {
    Parquet,
    Csv,
}

/// A file that is being written.
pub(super) struct Sink {
    place: Place,
    schema: SchemaRef,
    writer: Writer,
    rows: u64,
}

enum Writer {
    Parquet(Box<ArrowWriter<File>>),
    Csv(Box<csv::Writer<BufWriter<File>>>),
}

/// The properties with which tables of numbers are written. Doubles have few repeated values, and compression
/// hardly shrinks them.
pub(crate) fn properties(compressed: bool) -> WriterProperties {
    let compression = if compressed {
        Compression::ZSTD(ZstdLevel::default())
    } else {
        Compression::UNCOMPRESSED
    };
    WriterProperties::builder()
        .set_dictionary_enabled(false)
        .set_compression(compression)
        .set_max_row_group_row_count(Some(1 << 17))
        .build()
}

impl Sink {
    fn new(path: &Path, schema: SchemaRef, kind: Kind) -> Result<Sink, Error> {
        if matches!(kind, Kind::Parquet) {
            return Sink::parquet(path, schema, None);
        }
        let (place, file) = Place::create(path)?;
        let writer = Writer::Csv(Box::new(csv::Writer::new(BufWriter::new(file))));
        Ok(Sink { place, schema, writer, rows: 0 })
    }

    /// Creates a Parquet file, with a key and a text in its metadata if they are given.
    ///
    /// # Errors
    ///
    /// A file that cannot be created.
    pub(super) fn parquet(
        path: &Path,
        schema: SchemaRef,
        words: Option<(&str, String)>,
    ) -> Result<Sink, Error> {
        let (place, file) = Place::create(path)?;
        let words = words.map(|(key, text)| vec![KeyValue::new(key.to_owned(), text)]);
        let properties = properties(false).into_builder().set_key_value_metadata(words).build();
        let writer = ArrowWriter::try_new(file, schema.clone(), Some(properties));
        let writer = Writer::Parquet(Box::new(writer.map_err(|error| Error::file(path, error))?));
        Ok(Sink { place, schema, writer, rows: 0 })
    }

    /// The number of rows so far.
    pub(super) fn rows(&self) -> u64 {
        self.rows
    }

    fn push(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        let path = self.place.path();
        self.rows += batch.num_rows() as u64;
        match &mut self.writer {
            Writer::Parquet(writer) => {
                writer.write(batch).map_err(|error| Error::file(path, error))
            }
            Writer::Csv(writer) => {
                writer.write(&flat(batch)?).map_err(|error| Error::file(path, error))
            }
        }
    }

    pub(super) fn finish(self) -> Result<(), Error> {
        let path = self.place.path();
        match self.writer {
            Writer::Parquet(writer) => {
                writer.close().map_err(|error| Error::file(path, error))?;
            }
            Writer::Csv(mut writer) => {
                // A result without rows still has its header.
                let empty = flat(&RecordBatch::new_empty(self.schema))?;
                writer.write(&empty).map_err(|error| Error::file(path, error))?;
                writer.into_inner().flush().map_err(|error| Error::file(path, error))?;
            }
        }
        self.place.keep()
    }
}

/// Replaces lists of fixed length and structs by columns of their own: `tau` becomes `tau_1`, `tau_2` …
///
/// # Errors
///
/// Columns of lists of another kind.
fn flat(batch: &RecordBatch) -> Result<RecordBatch, Error> {
    let mut columns: Vec<(String, ArrayRef)> = vec![];
    for (field, column) in batch.schema().fields().iter().zip(batch.columns()) {
        flatten(field.name(), column, &mut columns)?;
    }
    let fields =
        columns.iter().map(|(name, column)| Field::new(name, column.data_type().clone(), true));
    let schema = Schema::new(fields.collect::<Vec<_>>());
    let columns = columns.into_iter().map(|(_, column)| column).collect();
    RecordBatch::try_new(Arc::new(schema), columns).map_err(|error| Error::Query(error.to_string()))
}

fn flatten(
    name: &str,
    column: &ArrayRef,
    found: &mut Vec<(String, ArrayRef)>,
) -> Result<(), Error> {
    match column.data_type() {
        DataType::FixedSizeList(_, size) => {
            let lists = column.as_fixed_size_list();
            let size = size.unsigned_abs() as usize;
            for entry in 0..size {
                let place = |row: usize| lists.is_valid(row).then_some((row * size + entry) as u64);
                let places: UInt64Array = (0..lists.len()).map(place).collect();
                let values = take(lists.values(), &places, None);
                let values = values.map_err(|error| Error::Query(error.to_string()))?;
                flatten(&format!("{name}_{}", entry + 1), &values, found)?;
            }
            Ok(())
        }
        DataType::Struct(fields) => {
            let values = column.as_struct();
            let parts = fields.iter().zip(values.columns());
            parts.into_iter().try_for_each(|(field, part)| {
                flatten(&format!("{name}_{}", field.name()), part, found)
            })
        }
        DataType::List(_) | DataType::LargeList(_) | DataType::ListView(_) => {
            Err(Error::Columns(format!(
                "column `{name}` has lists of any length, which CSV cannot represent; write Parquet, or leave it out with \
                 --columns"
            )))
        }
        _ => {
            found.push((name.to_owned(), column.clone()));
            Ok(())
        }
    }
}
