//! The files of a log.

use std::fs::File;
use std::path::{Path, PathBuf};

use datafusion::arrow::datatypes::SchemaRef;
use datafusion::parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use crate::error::Error;

/// The files of one table, Parquet or CSV.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    files: Vec<PathBuf>,
    format: Format,
    /// The number of rows of each file, from the footers of Parquet files.
    rows: Vec<u64>,
}

/// The format of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Parquet,
    Csv,
}

impl Log {
    /// Opens the log of files and folders. A folder contributes all `.parquet` files in it and its subfolders, in
    /// the order of their names. The footer of each Parquet file is read. Files and folders of buckets, such as
    /// `s3://logs/arm`, are read only by the query.
    ///
    /// # Errors
    ///
    /// Paths that do not exist; files of different formats or with different columns; Parquet files that are
    /// incomplete.
    pub fn open(paths: &[PathBuf]) -> Result<Log, Error> {
        let mut files = vec![];
        for path in paths {
            collect(path, &mut files)?;
        }
        let (Some(first), formats) = (files.first(), files.iter().map(|path| format_of(path)))
        else {
            return Err(Error::Columns(
                "the log has no file; name a .parquet or .csv file".to_owned(),
            ));
        };
        let formats: Result<Vec<Format>, Error> = formats.collect();
        let formats = formats?;
        let format = formats[0];
        if let Some(place) = formats.iter().position(|other| *other != format) {
            let reason = format!(
                "its format differs from that of {}; read them separately",
                first.display()
            );
            return Err(Error::file(&files[place], reason));
        }
        let mut log = Log { files, format, rows: vec![] };
        if format == Format::Parquet {
            log.rows = log.check_columns()?;
        }
        Ok(log)
    }

    /// The files.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// The number of rows, from the footers of Parquet files; `None` for CSV and for buckets.
    #[must_use]
    pub fn rows(&self) -> Option<u64> {
        let are_known = self.format == Format::Parquet && self.remote().is_none();
        are_known.then(|| self.rows.iter().sum())
    }

    /// The first file or folder that is in a bucket.
    fn remote(&self) -> Option<&PathBuf> {
        self.files.iter().find(|path| is_remote(path))
    }

    /// The files, if they are Parquet.
    ///
    /// # Errors
    ///
    /// CSV files and buckets, which `what`, a command or an option, does not support.
    pub(super) fn parquet(&self, what: &str) -> Result<&[PathBuf], Error> {
        if let Some(path) = self.remote() {
            let reason =
                format!("`{what}` reads files of this machine; copy it from the bucket first");
            return Err(Error::file(path, reason));
        }
        match self.format {
            Format::Parquet => Ok(&self.files),
            Format::Csv => {
                let reason = format!(
                    "`{what}` reads Parquet files; `robot-query sql --log FILE \"SELECT * FROM log\" -o log.parquet` makes one"
                );
                Err(Error::file(&self.files[0], reason))
            }
        }
    }

    /// Each Parquet file with its number of rows.
    ///
    /// # Errors
    ///
    /// CSV files.
    pub(super) fn with_rows(&self) -> Result<impl Iterator<Item = (&PathBuf, u64)>, Error> {
        Ok(self.parquet("--resume")?.iter().zip(self.rows.iter().copied()))
    }

    pub(super) fn format(&self) -> Format {
        self.format
    }

    /// Checks that all files have the same columns, and returns the number of rows of each.
    fn check_columns(&self) -> Result<Vec<u64>, Error> {
        let mut known: Option<(&Path, SchemaRef)> = None;
        let mut rows = vec![];
        for path in self.files.iter().filter(|path| !is_remote(path)) {
            let reader = reader(path)?;
            rows.push(reader.metadata().file_metadata().num_rows().unsigned_abs());
            let schema = reader.schema().clone();
            match &known {
                None => known = Some((path, schema)),
                Some((first, wanted)) if wanted.fields() != schema.fields() => {
                    let mut fields = schema.fields().iter();
                    let column =
                        fields.find(|field| wanted.fields().iter().all(|other| other != *field));
                    let column = column.map_or("a column is missing".to_owned(), |field| {
                        format!("column `{}` is {}", field.name(), field.data_type())
                    });
                    let first = first.display();
                    let reason = format!("its columns are not those of {first} ({column})");
                    return Err(Error::file(path, reason));
                }
                Some(_) => {}
            }
        }
        Ok(rows)
    }

    /// Adds the place in the log to an error of a query over the log, if the log is the reason.
    #[must_use]
    pub fn located(&self, error: Error) -> Error {
        let Error::Engine(reason) = &error else {
            return error;
        };
        match (self.first_unreadable(), self.remote()) {
            (Some(unreadable), _) => unreadable,
            (None, Some(path)) => {
                let advice = "`robot-query check` over a copy names the file and the row group";
                Error::file(path, format!("{reason}; if a file is not whole, {advice}"))
            }
            (None, None) => error,
        }
    }

    /// The first place at which the files cannot be read, which is why a query over them failed.
    #[must_use]
    pub fn first_unreadable(&self) -> Option<Error> {
        if self.format == Format::Csv {
            return None;
        }
        let mut local = self.files.iter().filter(|path| !is_remote(path));
        local.find_map(|path| match reader(path) {
            Err(error) => Some(error),
            Ok(found) => (0..found.metadata().num_row_groups()).find_map(|group| {
                let reason = unreadable(path, group)?;
                Some(Error::File { path: path.clone(), row_group: Some(group), reason })
            }),
        })
    }
}

/// The reason why a row group cannot be read; `None` if it can be read.
fn unreadable(path: &Path, group: usize) -> Option<String> {
    let batches = match reader(path).map(|reader| reader.with_row_groups(vec![group]).build()) {
        Err(error) => return Some(error.to_string()),
        Ok(Err(error)) => return Some(error.to_string()),
        Ok(Ok(batches)) => batches,
    };
    let error = batches.into_iter().find_map(Result::err)?;
    Some(format!("it cannot be read ({error}); copy or write the file again"))
}

/// A reader of a Parquet file.
///
/// # Errors
///
/// A file that cannot be opened, or that is incomplete.
pub(crate) fn reader(path: &Path) -> Result<ParquetRecordBatchReaderBuilder<File>, Error> {
    let file = File::open(path).map_err(|error| Error::file(path, error))?;
    ParquetRecordBatchReaderBuilder::try_new(file).map_err(|error| {
        let reason = "it is not a whole Parquet file; it may be truncated";
        Error::file(path, format!("{reason} ({error}); copy or write it again"))
    })
}

/// Whether a path is in a bucket.
fn is_remote(path: &Path) -> bool {
    path.to_str().is_some_and(|path| path.starts_with("s3://"))
}

fn collect(path: &Path, files: &mut Vec<PathBuf>) -> Result<(), Error> {
    if is_remote(path) {
        // The engine recognizes a folder by the slash at the end of its name.
        let folder = if path.extension().is_none() { path.join("") } else { path.to_owned() };
        files.push(folder);
        return Ok(());
    }
    let failed = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => Error::file(path, "there is no such file or folder"),
        _ => Error::file(path, error),
    };
    let found = std::fs::metadata(path).map_err(failed)?;
    if !found.is_dir() {
        files.push(path.to_owned());
        return Ok(());
    }
    let mut entries = vec![];
    for entry in std::fs::read_dir(path).map_err(failed)? {
        entries.push(entry.map_err(failed)?.path());
    }
    entries.sort();
    let before = files.len();
    for entry in entries {
        if entry.is_dir() || entry.extension().is_some_and(|ending| ending == "parquet") {
            collect(&entry, files)?;
        }
    }
    if files.len() == before {
        return Err(Error::file(path, "the folder has no .parquet file"));
    }
    Ok(())
}

fn format_of(path: &Path) -> Result<Format, Error> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("parquet") => Ok(Format::Parquet),
        Some("csv") => Ok(Format::Csv),
        Some("mcap") => {
            let reason = "an MCAP file is not a table; `robot-query convert` converts it to one";
            Err(Error::file(path, reason))
        }
        // A folder of a bucket.
        None if is_remote(path) => Ok(Format::Parquet),
        _ => Err(Error::file(path, "its name ends neither in .parquet nor in .csv")),
    }
}
