//! Finds likely mistakes in a log.

use std::fmt;
use std::path::{Path, PathBuf};

use datafusion::arrow::array::{ArrayRef, RecordBatch};
use datafusion::arrow::datatypes::Schema;
use robot_model::robot::JointKind;
use robot_model::variable::JointVariable;
use robot_symbolic::Rational;

use super::files::{Log, reader};
use super::torques::Torques;
use super::variables::Names;
use crate::columns::{BLOCK, Columns};
use crate::error::Error;
use crate::robots::Model;

/// The position of a revolute joint, in turns, beyond which it is more likely in degrees.
const TURNS: f64 = 10.0;

/// The time between two samples, s, beyond which time is more likely in another unit than seconds.
const APART: f64 = 60.0;

/// A finding about a row group.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The file.
    pub path: PathBuf,
    /// The row group, from 0.
    pub row_group: usize,
    /// The first row of the file that the finding is about, from 0.
    pub row: u64,
    /// The number of such rows in the row group.
    pub rows: u64,
    /// The text of the finding.
    pub what: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Finding { path, row_group, row, rows, what } = self;
        let path = path.display();
        write!(f, "{path}, row group {row_group}: {what}, {rows} rows, the first is row {row}")
    }
}

/// The distance beyond its limits at which a position is reported, as a fraction of the range.
const BEYOND: f64 = 0.1;

/// The number of kinds of mistakes in a row; [`WHAT`] lists them.
const KINDS: usize = 7;

/// Checks the Parquet files of a log and finds rows with nulls, NaN or infinities, times that repeat, go back or
/// are not in seconds, positions that are not in radians, and torques that are not in N m. `time` and `episode` are
/// columns; times are compared within an episode.
///
/// # Errors
///
/// Columns that are missing; files that cannot be read.
pub fn check(
    log: &Log,
    model: &Model,
    names: &Names,
    time: Option<&str>,
    episode: Option<&str>,
) -> Result<Vec<Finding>, Error> {
    let mut search = Search { model, names, time, episode, last: Last::default(), found: vec![] };
    for path in log.parquet("check")? {
        let mut row = 0;
        for group in 0..reader(path)?.metadata().num_row_groups() {
            row = search.group(path, group, row)?;
        }
    }
    Ok(search.found)
}

/// A check of the files of a log, in their order.
struct Search<'a> {
    model: &'a Model,
    names: &'a Names,
    time: Option<&'a str>,
    episode: Option<&'a str>,
    last: Last,
    found: Vec<Finding>,
}

impl Search<'_> {
    /// Checks a row group, whose first row in the file is `first`; returns the row after its last.
    fn group(&mut self, path: &Path, group: usize, first: u64) -> Result<u64, Error> {
        let failed = |error: &dyn fmt::Display| Error::File {
            path: path.to_owned(),
            row_group: Some(group),
            reason: format!("it cannot be read ({error}); copy or write the file again"),
        };
        let batches = reader(path)?.with_row_groups(vec![group]).build();
        let mut row = first;
        let mut rows = None;
        for batch in batches.map_err(|error| failed(&error))? {
            let batch = batch.map_err(|error| failed(&error))?;
            let wanted = CheckedColumns::of(self, &batch.schema(), path)?;
            let arrays = wanted.arrays(&batch, path)?;
            let rows = match &mut rows {
                Some(rows) => rows,
                rows => rows.insert(Rows::new(self.model, &wanted)?),
            };
            rows.check_batch(&wanted, &arrays, batch.num_rows(), row, &mut self.last)?;
            row += batch.num_rows() as u64;
        }
        let Some(rows) = rows else { return Ok(row) };
        let mut note = |row: u64, rows: u64, what: String| {
            self.found.push(Finding { path: path.to_owned(), row_group: group, row, rows, what });
        };
        for (kind, found) in rows.first.iter().enumerate() {
            if let Some(row) = found {
                note(*row, rows.count[kind], WHAT[kind].to_owned());
            }
        }
        if let Some(torques) = &rows.torques {
            for what in torques.units(self.model) {
                note(first, torques.rows(), what);
            }
        }
        Ok(row)
    }
}

/// The columns to check: episode and time, if they are named, then those of the variables that the log has.
struct CheckedColumns {
    names: Vec<String>,
    has_episode: bool,
    has_time: bool,
    /// The factors that convert the columns of variables to SI units, in their order.
    factors: Vec<f64>,
    has_positions: bool,
    has_all: bool,
}

impl CheckedColumns {
    fn of(search: &Search<'_>, schema: &Schema, path: &Path) -> Result<CheckedColumns, Error> {
        let Search { model, names, time, episode, .. } = search;
        let mut wanted: Vec<String> = vec![];
        wanted.extend(episode.map(str::to_owned));
        wanted.extend(time.map(str::to_owned));
        let mut factors = vec![];
        let mut are_there = vec![];
        for variable in JointVariable::ALL {
            // A log need not have all variables; the functions that need a missing one report it.
            let columns = names.of(schema, variable, model)?;
            are_there.push(columns.is_some());
            if let Some(columns) = columns {
                wanted.extend(columns);
                let own = names.factors(variable, model)?;
                factors.extend(own.unwrap_or_else(|| vec![1.0; model.joints()]));
            }
        }
        if factors.is_empty() {
            return Err(Error::file(path, "it has no column of q, qd, qdd or tau"));
        }
        Ok(CheckedColumns {
            names: wanted,
            has_episode: episode.is_some(),
            has_time: time.is_some(),
            factors,
            has_positions: are_there[0],
            has_all: are_there.iter().all(|is_there| *is_there),
        })
    }

    /// The number of columns before those of variables.
    fn before(&self) -> usize {
        usize::from(self.has_episode) + usize::from(self.has_time)
    }

    fn arrays(&self, batch: &RecordBatch, path: &Path) -> Result<Vec<ArrayRef>, Error> {
        let column = |name: &String| {
            let missing = || Error::file(path, format!("it has no column `{name}`"));
            batch.column_by_name(name).cloned().ok_or_else(missing)
        };
        self.names.iter().map(column).collect()
    }
}

const WHAT: [&str; KINDS] = [
    "a value is null",
    "a value is NaN or infinite",
    "the time equals that of the previous row",
    "the time is before that of the previous row",
    "the time is more than 60 s after that of the previous row: is it in seconds?",
    "a position is beyond 10 turns: is it in radians (see --degrees)?",
    "a position is beyond the limits of the robot file: is it in radians (see --degrees) or meters, and is it the right \
     joint?",
];

/// The plausible positions of a coordinate.
#[derive(Clone, Copy)]
struct Bounds {
    /// The largest absolute value, rad or m.
    turns: f64,
    low: f64,
    high: f64,
}

fn bounds(model: &Model) -> Vec<Bounds> {
    let bounds = model.robot.coordinates.iter().map(|coordinate| {
        let turns = match coordinate.kind {
            JointKind::Revolute => std::f64::consts::TAU * TURNS,
            JointKind::Prismatic => f64::INFINITY,
        };
        let unlimited = Bounds { turns, low: f64::NEG_INFINITY, high: f64::INFINITY };
        coordinate.limits.as_ref().map_or(unlimited, |limits| {
            let [low, high] = limits.each_ref().map(Rational::to_f64);
            let more = BEYOND * (high - low);
            Bounds { turns, low: low - more, high: high + more }
        })
    });
    bounds.collect()
}

/// The episode and the time of the row before.
#[derive(Clone, Copy, Debug, Default)]
struct Last {
    episode: f64,
    time: Option<f64>,
}

/// The findings in a row group.
struct Rows {
    first: [Option<u64>; KINDS],
    count: [u64; KINDS],
    bounds: Vec<Bounds>,
    torques: Option<Torques>,
}

impl Rows {
    fn new(model: &Model, wanted: &CheckedColumns) -> Result<Rows, Error> {
        let torques = wanted.has_all.then(|| Torques::new(model)).transpose()?;
        let bounds = if wanted.has_positions { bounds(model) } else { vec![] };
        Ok(Rows { first: [None; KINDS], count: [0; KINDS], bounds, torques })
    }

    fn note(&mut self, kind: usize, row: u64) {
        self.first[kind].get_or_insert(row);
        self.count[kind] += 1;
    }

    /// Checks the rows of a batch, whose first row in the file is `first`.
    fn check_batch(
        &mut self,
        wanted: &CheckedColumns,
        arrays: &[ArrayRef],
        rows: usize,
        first: u64,
        last: &mut Last,
    ) -> Result<(), Error> {
        let columns = Columns::of_all(arrays, rows)?;
        let before = wanted.before();
        // If all rows are null, the length of their lists is unknown.
        let are_null = columns.valid().is_some_and(|valid| valid.null_count() == rows);
        if columns.entries() != before + wanted.factors.len() && !are_null {
            return Err(Error::Columns(format!(
                "the columns of the joints' variables have {} entries, where the robot needs {}",
                columns.entries() - before,
                wanted.factors.len()
            )));
        }
        let mut values = vec![0.0; columns.entries() * BLOCK];
        for start in (0..rows).step_by(BLOCK) {
            let count = columns.read(start, &mut values);
            let variables = values.chunks_exact_mut(BLOCK).skip(before);
            for (column, factor) in variables.zip(&wanted.factors) {
                column.iter_mut().for_each(|value| *value *= factor);
            }
            let mut are_whole = [true; BLOCK];
            for (place, is_whole) in are_whole[..count].iter_mut().enumerate() {
                let is_null = columns.valid().is_some_and(|valid| valid.is_null(start + place));
                let row = Row { values: &values, place, row: first + (start + place) as u64 };
                *is_whole = self.row(wanted, &row, is_null, last);
            }
            if let Some(torques) = &mut self.torques
                && !are_null
            {
                torques.push(&values[before * BLOCK..], &are_whole[..count])?;
            }
        }
        Ok(())
    }

    /// Checks a row; returns whether all its values are numbers.
    fn row(
        &mut self,
        wanted: &CheckedColumns,
        row: &Row<'_>,
        is_null: bool,
        last: &mut Last,
    ) -> bool {
        if is_null {
            self.note(0, row.row);
            return false;
        }
        let before = wanted.before();
        let are_finite =
            (before..before + wanted.factors.len()).all(|entry| row.value(entry).is_finite());
        if !are_finite {
            self.note(1, row.row);
        }
        let positions = self.bounds.iter().enumerate();
        let mut positions = positions.map(|(joint, bounds)| (row.value(before + joint), bounds));
        if positions.clone().any(|(position, bounds)| position.abs() > bounds.turns) {
            self.note(5, row.row);
        } else if positions.any(|(at, bounds)| at < bounds.low || at > bounds.high) {
            self.note(6, row.row);
        }
        if wanted.has_time {
            let now = row.value(usize::from(wanted.has_episode));
            let episode = if wanted.has_episode { row.value(0) } else { 0.0 };
            if let Some(time) = last.time.filter(|_| last.episode == episode) {
                match now - time {
                    0.0 => self.note(2, row.row),
                    step if step < 0.0 => self.note(3, row.row),
                    step if step > APART => self.note(4, row.row),
                    _ => {}
                }
            }
            *last = Last { episode, time: Some(now) };
        }
        are_finite
    }
}

/// A row of a block.
struct Row<'a> {
    values: &'a [f64],
    place: usize,
    /// Its number in the file.
    row: u64,
}

impl Row<'_> {
    fn value(&self, entry: usize) -> f64 {
        self.values[entry * BLOCK + self.place]
    }
}
