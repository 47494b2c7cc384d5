//! The measurements of a log in constant memory: for each joint the triangle of [Y τ], the regressor and the torque
//! over all rows.

use std::sync::Arc;

use robot_build::FunctionKind;

use super::prior::Prior;
use super::triangle::{Column, ROWS, Triangle};
use crate::columns::{BLOCK, Columns};
use crate::error::Error;
use crate::functions::{compute, function};
use crate::robots::{Compiled, Model};

/// The measurements of a robot, for any number of rows. Each joint has a triangle of its own, over the columns of
/// the regressor that its torque depends on. This halves the work, and the weights of joints can be chosen
/// afterwards.
#[derive(Debug)]
pub(crate) struct Measurements {
    pub(crate) model: Arc<Model>,
    regressor: Arc<Compiled>,
    /// The number of base parameters.
    parameters: usize,
    pub(super) joints: Vec<Joint>,
    /// The number of rows that were added.
    pub(super) rows: u64,
    /// The number of rows that were omitted because a value is a NaN, an infinity or null.
    pub(super) excluded: u64,
    /// Whether noise was given with the rows.
    pub(super) weighted: bool,
    /// The priors.
    pub(crate) prior: Prior,
}

/// The measurements of a joint.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    /// The columns of the regressor that are not 0 by structure.
    pub(super) columns: Vec<usize>,
    /// The triangle over these columns and the torque, with each row divided by its noise.
    pub(super) triangle: Triangle,
    /// Σ 1/noise², which is the number of rows if no noise is given.
    pub(super) weight: f64,
}

/// The working memory for adding rows.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    given: Vec<f64>,
    regressor: Vec<f64>,
    block: Vec<Column>,
}

impl Measurements {
    /// Makes measurements without rows.
    ///
    /// # Errors
    ///
    /// A robot without base parameters; parameters without a nominal value.
    pub(crate) fn new(model: Arc<Model>) -> Result<Measurements, Error> {
        let regressor = model.compiled(FunctionKind::RegressorBase)?;
        let joints = model.joints();
        let parameters = regressor.zeros.len() / joints;
        let measured = |zeros: &[bool]| {
            let columns: Vec<usize> = (0..parameters).filter(|column| !zeros[*column]).collect();
            Joint { triangle: Triangle::new(columns.len() + 1), columns, weight: 0.0 }
        };
        let joints = regressor.zeros.chunks_exact(parameters.max(1)).map(measured).collect();
        Ok(Measurements {
            model,
            joints,
            parameters,
            rows: 0,
            excluded: 0,
            weighted: false,
            prior: Prior::default(),
            regressor,
        })
    }

    /// The number of base parameters.
    pub(crate) fn parameters(&self) -> usize {
        self.parameters
    }

    /// The size in memory, bytes.
    pub(crate) fn size(&self) -> usize {
        let triangles = self.joints.iter().map(|joint| joint.triangle.size().pow(2));
        triangles.sum::<usize>() * size_of::<f64>() + size_of::<Measurements>()
    }

    /// Adds rows: columns of q, q̇, q̈, τ and, if there are more columns, the noise of all torques or of each
    /// torque.
    ///
    /// # Errors
    ///
    /// A function that cannot be called.
    pub(crate) fn push(&mut self, columns: &Columns, scratch: &mut Scratch) -> Result<(), Error> {
        let count = self.joints.len();
        self.weighted |= columns.entries() > 4 * count;
        scratch.given.resize(columns.entries() * BLOCK, 0.0);
        scratch.regressor.resize(count * self.parameters * BLOCK, 0.0);
        let regressor = self.regressor.clone();
        let handle = function(&regressor.executable, FunctionKind::RegressorBase)?;
        for start in (0..columns.rows()).step_by(BLOCK) {
            let read = columns.read(start, &mut scratch.given);
            let rows = usable(columns, start, read, 4 * count, &mut scratch.given);
            self.rows += rows as u64;
            self.excluded += (read - rows) as u64;
            if rows == 0 {
                continue;
            }
            compute(handle, &scratch.given, &mut scratch.regressor, rows)?;
            for joint in 0..count {
                self.fold(joint, rows, scratch);
            }
        }
        Ok(())
    }

    /// Adds the first rows of a block to the triangle of a joint.
    fn fold(&mut self, joint: usize, rows: usize, scratch: &mut Scratch) {
        let count = self.joints.len();
        let column = |values: &'_ [f64], place: usize| {
            place * BLOCK..place * BLOCK + values.len().min(BLOCK)
        };
        let Scratch { given, regressor, block } = scratch;
        let noise = match given.len() / BLOCK - 4 * count {
            0 => None,
            1 => Some(4 * count),
            _ => Some(4 * count + joint),
        };
        let noise = noise.map(|place| &given[column(given, place)]);
        let torque = &given[column(given, 3 * count + joint)];
        let Joint { columns, triangle, weight } = &mut self.joints[joint];
        let first = joint * self.parameters;
        for start in (0..rows).step_by(ROWS) {
            let end = rows.min(start + ROWS);
            block.clear();
            let sources = columns.iter().map(|place| &regressor[column(regressor, first + place)]);
            for source in sources.chain([torque]) {
                let mut values = [0.0; ROWS];
                values[..end - start].copy_from_slice(&source[start..end]);
                if let Some(noise) = noise {
                    let noise = &noise[start..end];
                    values.iter_mut().zip(noise).for_each(|(value, noise)| *value /= noise);
                }
                block.push(values);
            }
            triangle.fold(block);
            *weight += match noise {
                None => (end - start) as f64,
                Some(noise) => noise[start..end].iter().map(|noise| noise.powi(-2)).sum(),
            };
        }
    }

    /// The state as numbers: the counts of rows, then the weight and the triangle of each joint.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        // Counts are exact up to 2⁵³ rows.
        let mut numbers =
            vec![self.rows as f64, self.excluded as f64, f64::from(u8::from(self.weighted))];
        for joint in &self.joints {
            numbers.push(joint.weight);
            numbers.extend(joint.triangle.packed());
        }
        numbers
    }

    /// Adds the state of other rows, as returned by [`Measurements::numbers`].
    ///
    /// # Errors
    ///
    /// A state of another robot.
    pub(crate) fn merge(&mut self, numbers: &[f64]) -> Result<(), Error> {
        let other = || Error::Query("the state of `identify` belongs to another robot".to_owned());
        let (counts, mut numbers) = numbers.split_at_checked(3).ok_or_else(other)?;
        let mut merged = self.joints.clone();
        for joint in &mut merged {
            let size = joint.triangle.size();
            let (own, rest) =
                numbers.split_at_checked(1 + size * (size + 1) / 2).ok_or_else(other)?;
            let triangle = Triangle::unpacked(size, &own[1..]).ok_or_else(other)?;
            joint.triangle.merge(&triangle);
            joint.weight += own[0];
            numbers = rest;
        }
        if !numbers.is_empty() {
            return Err(other());
        }
        self.joints = merged;
        self.rows += counts[0] as u64;
        self.excluded += counts[1] as u64;
        self.weighted |= counts[2] != 0.0;
        Ok(())
    }
}

/// Moves the rows of a block that are complete and finite and have noise above 0 to its front; returns their
/// number.
fn usable(columns: &Columns, start: usize, rows: usize, first: usize, given: &mut [f64]) -> usize {
    let mut wanted = [true; BLOCK];
    if let Some(valid) = columns.valid() {
        (0..rows).for_each(|row| wanted[row] = valid.is_valid(start + row));
    }
    for (place, column) in given.chunks_exact(BLOCK).enumerate() {
        for (wanted, value) in wanted.iter_mut().zip(&column[..rows]) {
            *wanted &= value.is_finite() && (place < first || *value > 0.0);
        }
    }
    let count = wanted[..rows].iter().filter(|wanted| **wanted).count();
    if count < rows {
        for column in given.chunks_exact_mut(BLOCK) {
            for (front, row) in (0..rows).filter(|row| wanted[*row]).enumerate() {
                column[front] = column[row];
            }
        }
    }
    count
}
