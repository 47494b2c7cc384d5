//! LeRobot data sets, version 3: Parquet files with a row for each frame, and their columns in `meta/info.json`.

use std::path::{Path, PathBuf};

use datafusion::arrow::array::{ArrayRef, RecordBatch};
use serde_json::Value;

use super::episodes::Episodes;
use super::{Conversion, Converted, places};
use crate::columns::{BLOCK, Columns};
use crate::error::Error;
use crate::log::{Log, reader};
use crate::robots::Model;

/// The column of positions.
const STATE: &str = "observation.state";

/// Converts a data set to a log.
///
/// # Errors
///
/// Files that are missing, cannot be read or are of another version; frames out of order.
pub(super) fn convert(
    model: &Model,
    input: &Path,
    how: &Conversion,
    output: &Path,
) -> Result<Converted, Error> {
    let (names, info) = names(input)?;
    let set = Set {
        places: places(model, how, &names, &info)?,
        state: names.len(),
        unit: if how.degrees { 1_f64.to_radians() } else { 1.0 },
        how,
    };
    let log = Log::open(&[input.join("data")])?;
    let mut episodes = Episodes::new(output, model.joints(), how.tau.is_some(), how.window)?;
    let mut episode = None;
    for path in log.files() {
        let failed = |error: &dyn std::fmt::Display| Error::file(path, error);
        let batches = reader(path)?.build().map_err(|error| failed(&error))?;
        let mut row = 0;
        for batch in batches {
            let batch = batch.map_err(|error| failed(&error))?;
            set.push(&batch, path, row, &mut episode, &mut episodes)?;
            row += batch.num_rows();
        }
    }
    episodes.end()?;
    episodes.finish()
}

/// The parts of a data set that are converted.
struct Set<'a> {
    /// The places of the robot's joints in the state.
    places: Vec<usize>,
    /// The entries of the state.
    state: usize,
    unit: f64,
    how: &'a Conversion,
}

impl Set<'_> {
    /// Adds the frames of a batch; the first frame is the given row of its file.
    fn push(
        &self,
        batch: &RecordBatch,
        path: &Path,
        first: usize,
        episode: &mut Option<i64>,
        episodes: &mut Episodes,
    ) -> Result<(), Error> {
        let column = |name: &str| -> Result<ArrayRef, Error> {
            let missing = || Error::file(path, format!("it has no column `{name}`"));
            batch.column_by_name(name).cloned().ok_or_else(missing)
        };
        let mut arrays = vec![column("episode_index")?, column("timestamp")?, column(STATE)?];
        let tau = self.how.tau.as_deref().map(column).transpose()?;
        let has_torques = tau.is_some();
        arrays.extend(tau);
        let rows = batch.num_rows();
        let entries = 2 + self.state * if has_torques { 2 } else { 1 };
        let columns = Columns::new(&arrays, rows, &[entries], &path.display().to_string())?;
        let mut values = vec![0.0; entries * BLOCK];
        for start in (0..rows).step_by(BLOCK) {
            let count = columns.read(start, &mut values);
            for row in 0..count {
                let place = || format!("{}, row {}", path.display(), first + start + row);
                if columns.valid().is_some_and(|valid| valid.is_null(start + row)) {
                    return Err(Error::Columns(format!("{}: a value is null", place())));
                }
                let value = |entry: usize| values[entry * BLOCK + row];
                let this = value(0) as i64;
                if episode.is_some_and(|before| before != this) {
                    episodes.end()?;
                }
                *episode = Some(this);
                let positions = self.places.iter().map(|place| value(2 + place) * self.unit);
                let torques = self.places.iter().map(|place| value(2 + self.state + place));
                let torques = torques.take(if has_torques { self.places.len() } else { 0 });
                episodes.push(value(1), positions, torques, &place)?;
            }
        }
        Ok(())
    }
}

/// The names of the entries of the state, and the file that contains them.
fn names(folder: &Path) -> Result<(Vec<String>, PathBuf), Error> {
    let path = folder.join("meta/info.json");
    let failed = |reason: String| Error::file(&path, reason);
    let text = std::fs::read_to_string(&path).map_err(|error| failed(error.to_string()))?;
    let info: Value = serde_json::from_str(&text).map_err(|error| failed(error.to_string()))?;
    let version = info["codebase_version"].as_str().unwrap_or("unknown");
    if !version.starts_with("v3") {
        return Err(failed(format!(
            "the data set has version {version}; convert it to v3.0 with LeRobot"
        )));
    }
    let mut found = vec![];
    collect(&info["features"][STATE]["names"], &mut found);
    if found.is_empty() {
        return Err(failed(format!("the feature {STATE} has no names")));
    }
    Ok((found, path))
}

/// The names in the order of a list, or of the lists in an object; names of positions can be marked as such.
fn collect(names: &Value, found: &mut Vec<String>) {
    match names {
        Value::String(name) => found.push(name.strip_suffix(".pos").unwrap_or(name).to_owned()),
        Value::Array(list) => list.iter().for_each(|name| collect(name, found)),
        Value::Object(lists) => lists.values().for_each(|list| collect(list, found)),
        _ => {}
    }
}
