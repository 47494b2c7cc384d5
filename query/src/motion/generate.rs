//! Logs of simulated measurements, of any size. The same seed yields the same log.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use datafusion::arrow::array::{
    ArrayRef, FixedSizeListArray, Float64Array, Int64Array, RecordBatch,
};
use datafusion::arrow::compute::cast;
use datafusion::arrow::datatypes::{DataType, Field, Schema};
use datafusion::arrow::error::ArrowError;
use datafusion::parquet::arrow::ArrowWriter;
use robot_model::variable::JointVariable;
use robot_symbolic::Random;

use super::trajectory::{Limits, Trajectory};
use crate::columns::{BLOCK, doubles};
use crate::error::Error;
use crate::functions::{compute, function, torques_of};
use crate::log::{Place, empty_folder, properties};
use crate::robots::Model;

/// The number of rows of a batch.
const BATCH: usize = 64 * BLOCK;

/// The options of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Generation {
    /// The number of rows.
    pub rows: u64,
    /// The number of files.
    pub files: u64,
    /// The number of rows per second.
    pub rate: f64,
    /// The number of rows of an episode; each episode has a trajectory of its own.
    pub episode: u64,
    /// The limits of the joints.
    pub limits: Vec<Limits>,
    /// The standard deviations of the torques' noise, N m or N.
    pub noise: Vec<f64>,
    /// The layout of the columns of the joints' variables.
    pub layout: Layout,
    /// Whether the variables are written in single precision, in half the space.
    pub single: bool,
    /// The seed of the pseudo-random numbers.
    pub seed: u64,
}

/// The layout of the variables of all joints in a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A list of fixed size for each variable.
    Lists,
    /// A column for each variable and joint, which is several times faster to read.
    Columns,
}

/// Writes a log into a folder: `episode`, `t` in seconds since the episode began, q, q̇, q̈ and the torques with the
/// friction of the robot file and normal noise.
///
/// # Errors
///
/// Files that cannot be written.
pub fn generate(model: &Model, how: &Generation, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    empty_folder(folder)?;
    let files = how.files.max(1);
    let path = |file: u64| folder.join(format!("part-{file:04}.parquet"));
    let ends = |file: u64| how.rows * file / files..how.rows * (file + 1) / files;
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let each = |first: u64| {
        let own = (first..files).step_by(threads as usize);
        own.map(|file| part(model, how, ends(file), &path(file)))
            .collect::<Result<Vec<()>, Error>>()
    };
    std::thread::scope(|scope| {
        let each = &each;
        let running: Vec<_> = (0..threads).map(|first| scope.spawn(move || each(first))).collect();
        let ended = running
            .into_iter()
            .map(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        ended.collect::<Result<Vec<_>, Error>>()
    })?;
    Ok((0..files).map(path).collect())
}

fn part(
    model: &Model,
    how: &Generation,
    rows: std::ops::Range<u64>,
    path: &Path,
) -> Result<(), Error> {
    let failed = |error: &dyn std::fmt::Display| Error::file(path, error);
    let schema = Arc::new(schema(model, how));
    let (place, file) = Place::create(path)?;
    let writer = ArrowWriter::try_new(file, schema.clone(), Some(properties(false)));
    let mut writer = writer.map_err(|error| failed(&error))?;
    let mut states = States::new(model, how);
    let mut start = rows.start;
    while start < rows.end {
        let end = rows.end.min(start + BATCH as u64);
        let arrays = states.arrays(start..end)?;
        let batch = RecordBatch::try_new(schema.clone(), arrays).map_err(|error| failed(&error))?;
        writer.write(&batch).map_err(|error| failed(&error))?;
        start = end;
    }
    writer.close().map_err(|error| failed(&error))?;
    place.keep()
}

fn schema(model: &Model, how: &Generation) -> Schema {
    let joints = model.joints();
    let variables = JointVariable::ALL.iter().flat_map(|variable| match how.layout {
        Layout::Lists => vec![Field::new(variable.name(), list(joints, how.single), false)],
        Layout::Columns => {
            let name = |joint: usize| format!("{}_{joint}", variable.name());
            (1..=joints).map(|joint| Field::new(name(joint), number(how.single), false)).collect()
        }
    });
    let first =
        [Field::new("episode", DataType::Int64, false), Field::new("t", DataType::Float64, false)];
    Schema::new(first.into_iter().chain(variables).collect::<Vec<_>>())
}

/// The type of the numbers of variables.
fn number(single: bool) -> DataType {
    if single { DataType::Float32 } else { DataType::Float64 }
}

/// The type of the lists of variables.
fn list(joints: usize, single: bool) -> DataType {
    let item = Arc::new(Field::new_list_field(number(single), true));
    DataType::FixedSizeList(item, i32::try_from(joints).unwrap_or(i32::MAX))
}

/// The generator of the states of rows.
struct States<'a> {
    model: &'a Model,
    how: &'a Generation,
    /// The trajectory of the latest episode.
    trajectory: Option<(u64, Trajectory)>,
}

impl<'a> States<'a> {
    fn new(model: &'a Model, how: &'a Generation) -> States<'a> {
        States { model, how, trajectory: None }
    }

    /// Computes the columns of rows.
    fn arrays(&mut self, rows: std::ops::Range<u64>) -> Result<Vec<ArrayRef>, Error> {
        let joints = self.model.joints();
        let count = (rows.end - rows.start) as usize;
        let length = self.how.episode.max(1);
        let mut columns = vec![vec![0.0; count]; 4 * joints];
        let mut state = vec![0.0; 3 * joints];
        for (place, row) in rows.clone().enumerate() {
            let time = (row % length) as f64 / self.how.rate;
            self.trajectory(row / length).at(time, &mut state);
            columns.iter_mut().zip(&state).for_each(|(column, value)| column[place] = *value);
        }
        self.torques(&mut columns)?;
        self.disturb(&mut columns[3 * joints..], rows.start);
        let episode = rows.clone().map(|row| (row / length) as i64).collect::<Int64Array>();
        let time = rows.map(|row| (row % length) as f64 / self.how.rate);
        let mut arrays: Vec<ArrayRef> =
            vec![Arc::new(episode), Arc::new(time.collect::<Float64Array>())];
        let single = self.how.single;
        let failed = |error: ArrowError| Error::Query(error.to_string());
        match self.how.layout {
            Layout::Columns => {
                for column in columns {
                    let column = cast(&Float64Array::from(column), &number(single));
                    arrays.push(column.map_err(failed)?);
                }
            }
            Layout::Lists => {
                for columns in columns.chunks(joints) {
                    let lists = lists(columns, count)?;
                    arrays.push(cast(&lists, &list(joints, single)).map_err(failed)?);
                }
            }
        }
        Ok(arrays)
    }

    fn trajectory(&mut self, episode: u64) -> &Trajectory {
        if self.trajectory.as_ref().is_some_and(|(known, _)| *known != episode) {
            self.trajectory = None;
        }
        let Generation { limits, seed, .. } = self.how;
        let made = || {
            let mut random = Random::new(mixed(*seed, 2 * episode));
            (episode, Trajectory::random(limits, 0.1, &mut random))
        };
        &self.trajectory.get_or_insert_with(made).1
    }

    /// Computes the torques of the model into the last columns.
    fn torques(&self, columns: &mut [Vec<f64>]) -> Result<(), Error> {
        let joints = self.model.joints();
        let kind = torques_of(self.model);
        let compiled = self.model.compiled(kind)?;
        let handle = function(&compiled.executable, kind)?;
        let count = columns.first().map_or(0, Vec::len);
        let mut given = vec![0.0; 3 * joints * BLOCK];
        let mut found = vec![0.0; joints * BLOCK];
        for start in (0..count).step_by(BLOCK) {
            let rows = BLOCK.min(count - start);
            for (given, column) in given.chunks_exact_mut(BLOCK).zip(columns.iter()) {
                given[..rows].copy_from_slice(&column[start..start + rows]);
            }
            compute(handle, &given, &mut found, rows)?;
            for (column, found) in columns[3 * joints..].iter_mut().zip(found.chunks_exact(BLOCK)) {
                column[start..start + rows].copy_from_slice(&found[..rows]);
            }
        }
        Ok(())
    }

    /// Adds noise, which depends only on the seed and on the first row of the batch.
    fn disturb(&self, torques: &mut [Vec<f64>], start: u64) {
        let mut random = Random::new(mixed(self.how.seed, 2 * start + 1));
        for (column, deviation) in torques.iter_mut().zip(&self.how.noise) {
            if *deviation > 0.0 {
                column.iter_mut().for_each(|value| *value += deviation * normal(&mut random));
            }
        }
    }
}

/// Joins columns into one column of lists.
fn lists(columns: &[Vec<f64>], rows: usize) -> Result<ArrayRef, Error> {
    let entries = (0..rows).flat_map(|row| columns.iter().map(move |column| column[row]));
    let values: Arc<Float64Array> = Arc::new(entries.collect::<Vec<f64>>().into());
    let size = i32::try_from(columns.len()).unwrap_or(i32::MAX);
    let lists = FixedSizeListArray::try_new(doubles(), size, values, None);
    Ok(Arc::new(lists.map_err(|error| Error::Query(error.to_string()))?))
}

/// The seed of a part of a log (by the finalizer of splitmix64).
fn mixed(seed: u64, part: u64) -> u64 {
    let mut bits = seed.wrapping_add(part.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// A random number with the standard normal distribution (Box and Muller 1958).
fn normal(random: &mut Random) -> f64 {
    let radius = (-2.0 * (1.0 - random.uniform(0.0, 1.0)).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.uniform(0.0, 1.0)).cos()
}
