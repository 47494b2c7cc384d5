//! Results of long queries, one file for each file of the log; results that exist already are not computed again.

use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use datafusion::prelude::DataFrame;
use futures::StreamExt;

use super::files::{Log, reader};
use super::write::{Sink, drain, is_whole};
use crate::error::Error;

/// The key in a file's metadata whose value describes the query of which the file is the result.
const KEY: &str = "robot-query";

/// The query that is computed for each file of a log.
#[derive(Clone, Debug)]
pub struct Question {
    /// A description of the query with the robot and the columns, which must match that of a result to keep it.
    pub words: String,
    /// Whether the query selects rows, so that a result can have fewer rows than the log.
    pub filtered: bool,
    /// The number of files that are computed at the same time.
    pub threads: usize,
}

/// The numbers of rows that were computed and kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Resumed {
    /// The number of rows in files that were computed.
    pub computed: u64,
    /// The number of rows in files that existed already.
    pub kept: u64,
}

/// Writes a Parquet file into a folder for each file of a log, under the same name. A file that exists and is the
/// result of the same query over the same file is kept. `table` computes the result for a log of one file, whose
/// rows keep their order.
///
/// # Errors
///
/// Two files with the same name; a file in the folder that is the result of another query; errors while a result is
/// computed or written. Files that were finished before the error are complete and are kept.
pub async fn resume(
    log: &Log,
    folder: &Path,
    question: &Question,
    table: impl AsyncFn(Log) -> Result<DataFrame, Error>,
) -> Result<Resumed, Error> {
    std::fs::create_dir_all(folder).map_err(|error| Error::file(folder, error))?;
    let mut tasks = vec![];
    let mut seen: Vec<PathBuf> = vec![];
    for (path, rows) in log.with_rows()? {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let output = folder.join(format!("{stem}.parquet"));
        if seen.contains(&output) {
            let reason =
                "another file of the log has the same name; rename it, or compute them separately";
            return Err(Error::file(path, reason));
        }
        seen.push(output.clone());
        tasks.push((path.to_owned(), rows, output));
    }
    let table = &table;
    let answers = tasks.into_iter().map(|(path, rows, output)| async move {
        let words = format!("{}\nof {}", question.words, version(&path)?);
        if output.exists() {
            return kept(&output, &words);
        }
        let answer = table(Log::open(std::slice::from_ref(&path))?).await?;
        let schema = answer.schema().inner().clone();
        let sink = Sink::parquet(&output, schema, Some((KEY, words)))?;
        // Each file is computed in a thread of its own.
        let stream = answer.execute_stream().await?;
        let sink = tokio::spawn(drain(stream, sink)).await;
        let sink = sink.map_err(|error| Error::Query(error.to_string()))??;
        let rows_found = sink.rows();
        is_whole(rows_found, (!question.filtered).then_some(rows))?;
        sink.finish()?;
        Ok(Resumed { computed: rows_found, kept: 0 })
    });
    let mut found = Resumed::default();
    let mut answers = futures::stream::iter(answers).buffer_unordered(question.threads.max(1));
    while let Some(answer) = answers.next().await {
        let Resumed { computed, kept } = answer?;
        found.computed += computed;
        found.kept += kept;
    }
    Ok(found)
}

/// The path, size and time of change of a file, by which a changed file is recognized.
fn version(path: &Path) -> Result<String, Error> {
    let failed = |error: std::io::Error| Error::file(path, error);
    let found = std::fs::metadata(path).map_err(failed)?;
    let changed = found.modified().map_err(failed)?;
    let changed = changed.duration_since(UNIX_EPOCH).unwrap_or_default();
    Ok(format!("{}, {} bytes, changed at {changed:?}", path.display(), found.len()))
}

/// The number of rows of an existing file, if it is the result of the same query.
fn kept(path: &Path, words: &str) -> Result<Resumed, Error> {
    let reader = reader(path)?;
    let metadata = reader.metadata().file_metadata();
    let mut pairs = metadata.key_value_metadata().into_iter().flatten();
    let found = pairs.find(|pair| pair.key == KEY).and_then(|pair| pair.value.as_deref());
    if found != Some(words) {
        let reason = "it is the result of a different query (another robot, other columns or another file); remove it or choose \
                      another folder";
        return Err(Error::file(path, reason));
    }
    Ok(Resumed { computed: 0, kept: metadata.num_rows().unsigned_abs() })
}
