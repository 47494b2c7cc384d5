//! What is likely wrong with a log.

use std::fmt;
use std::path::PathBuf;

use datafusion::arrow::array::ArrayRef;
use robot_model::robot::JointKind;
use robot_model::variable::JointVariable;
use robot_symbolic::Rational;

use super::files::{Log, reader};
use super::variables::Names;
use crate::columns::{BLOCK, Columns};
use crate::error::Error;
use crate::robots::Model;

/// A revolute joint's position beyond this many turns is more likely in degrees.
const TURNS: f64 = 10.0;

/// Samples that lie further apart than this are more likely in another unit than seconds.
const APART: f64 = 60.0;

/// A finding about a row group.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The file.
    pub path: PathBuf,
    /// The row group, from 0.
    pub row_group: usize,
    /// The first row of the file that it is about, from 0, and how many there are in the row group.
    pub row: u64,
    /// The number of rows.
    pub rows: u64,
    /// What is found.
    pub what: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Finding { path, row_group, row, rows, what } = self;
        let path = path.display();
        write!(f, "{path}, row group {row_group}: {what}, {rows} rows, the first is row {row}")
    }
}

/// How far beyond its limits a joint may be, of its range.
const BEYOND: f64 = 0.1;

/// What is looked for in a row, in the order of checks.
const KINDS: usize = 7;

/// Looks through the Parquet files of a log: rows with nulls, NaN or infinities, times that repeat, go back or are not in
/// seconds, and positions that are not in radians. `time` and `episode` are columns; time is compared within an episode.
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
    let mut found = vec![];
    let mut last = Last::default();
    for path in log.parquet("check")? {
        let mut row = 0;
        for group in 0..reader(path)?.metadata().num_row_groups() {
            let failed = |error: &dyn fmt::Display| Error::File {
                path: path.clone(),
                row_group: Some(group),
                reason: format!("it cannot be read ({error}); copy or write the file again"),
            };
            let batches = reader(path)?.with_row_groups(vec![group]).build();
            let mut rows = Rows { first: [None; KINDS], count: [0; KINDS], bounds: vec![] };
            for batch in batches.map_err(|error| failed(&error))? {
                let batch = batch.map_err(|error| failed(&error))?;
                let schema = batch.schema();
                let mut wanted: Vec<String> = vec![];
                wanted.extend(episode.map(str::to_owned));
                wanted.extend(time.map(str::to_owned));
                let before = wanted.len();
                if names.of(&schema, JointVariable::Position, model).is_some() {
                    rows.bounds = bounds(model);
                }
                for variable in JointVariable::ALL {
                    // A log may lack variables; what needs them says so.
                    wanted.extend(names.of(&schema, variable, model).unwrap_or_default());
                }
                let arrays: Result<Vec<ArrayRef>, Error> = wanted
                    .iter()
                    .map(|name| {
                        let missing = || Error::file(path, format!("it has no column `{name}`"));
                        batch.column_by_name(name).cloned().ok_or_else(missing)
                    })
                    .collect();
                let arrays = arrays?;
                if arrays.len() == before {
                    return Err(Error::file(path, "it has no column of q, qd, qdd or tau"));
                }
                let has = [episode.is_some(), time.is_some()];
                rows.look(&arrays, batch.num_rows(), row, has, &mut last)?;
                row += batch.num_rows() as u64;
            }
            for (kind, first) in rows.first.iter().enumerate() {
                if let Some(row) = first {
                    let (path, what) = (path.clone(), WHAT[kind].to_owned());
                    let rows = rows.count[kind];
                    found.push(Finding { path, row_group: group, row: *row, rows, what });
                }
            }
        }
    }
    Ok(found)
}

const WHAT: [&str; KINDS] = [
    "a value is null",
    "a value is NaN or infinite",
    "the time equals that of the previous row",
    "the time is before that of the previous row",
    "the time is more than 60 s after that of the previous row: is it in seconds?",
    "a position is beyond 10 turns: is it in radians?",
    "a position is beyond the limits of the robot file: is it in radians or meters, and is it the right joint?",
];

/// What positions a coordinate may have.
#[derive(Clone, Copy)]
struct Bounds {
    /// The largest absolute value.
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

/// Episode and time of the row before.
#[derive(Clone, Copy, Debug, Default)]
struct Last {
    episode: f64,
    time: Option<f64>,
}

/// What was found in a row group.
struct Rows {
    first: [Option<u64>; KINDS],
    count: [u64; KINDS],
    bounds: Vec<Bounds>,
}

impl Rows {
    fn note(&mut self, kind: usize, row: u64) {
        self.first[kind].get_or_insert(row);
        self.count[kind] += 1;
    }

    /// Looks at the rows of a batch, whose first is `first`.
    fn look(
        &mut self,
        arrays: &[ArrayRef],
        rows: usize,
        first: u64,
        [has_episode, has_time]: [bool; 2],
        last: &mut Last,
    ) -> Result<(), Error> {
        let columns = Columns::of_all(arrays, rows)?;
        let mut values = vec![0.0; columns.entries() * BLOCK];
        let before = usize::from(has_episode) + usize::from(has_time);
        for start in (0..rows).step_by(BLOCK) {
            let count = columns.read(start, &mut values);
            for place in 0..count {
                let row = first + (start + place) as u64;
                if columns.valid().is_some_and(|valid| valid.is_null(start + place)) {
                    self.note(0, row);
                    continue;
                }
                let value = |entry: usize| values[entry * BLOCK + place];
                if (before..columns.entries()).any(|entry| !value(entry).is_finite()) {
                    self.note(1, row);
                }
                let positions = self.bounds.iter().enumerate();
                let positions = positions.filter(|(joint, _)| before + joint < columns.entries());
                let mut positions =
                    positions.map(|(joint, bounds)| (value(before + joint), bounds));
                if positions.clone().any(|(position, bounds)| position.abs() > bounds.turns) {
                    self.note(5, row);
                } else if positions.any(|(at, bounds)| at < bounds.low || at > bounds.high) {
                    self.note(6, row);
                }
                if has_time {
                    let now = value(usize::from(has_episode));
                    let episode = if has_episode { value(0) } else { 0.0 };
                    if let Some(time) = last.time.filter(|_| last.episode == episode) {
                        match now - time {
                            0.0 => self.note(2, row),
                            step if step < 0.0 => self.note(3, row),
                            step if step > APART => self.note(4, row),
                            _ => {}
                        }
                    }
                    *last = Last { episode, time: Some(now) };
                }
            }
        }
        Ok(())
    }
}
