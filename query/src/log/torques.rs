//! Checks whether measured torques are in the units of the model.

use std::sync::Arc;

use robot_build::FunctionKind;

use crate::columns::BLOCK;
use crate::error::Error;
use crate::functions::{compute, function, torques_of};
use crate::robots::{Compiled, Model};

/// The ratio of measured torques to those of the model, or its inverse, beyond which they are more likely in
/// another unit.
const OFTEN: f64 = 20.0;

/// The correlation with the model's torques above which a joint's torques are the same in another unit or
/// direction.
const ALIKE: f64 = 0.5;

/// The ratio of the variance to the mean square below which torques count as constant.
const RESTING: f64 = 1e-9;

/// The number of rows below which nothing is reported.
const ROWS: u64 = 30;

/// Sums over measured torques and those of the model, over rows that are added a block at a time.
pub(super) struct Torques {
    kind: FunctionKind,
    compiled: Arc<Compiled>,
    found: Vec<f64>,
    rows: u64,
    sums: Vec<Sums>,
}

/// The sums over the rows of a joint: of the measured torques, of the model's, and of their products.
#[derive(Clone, Copy, Default)]
struct Sums {
    measured: f64,
    model: f64,
    measured_squared: f64,
    model_squared: f64,
    product: f64,
}

impl Torques {
    /// Makes empty sums.
    ///
    /// # Errors
    ///
    /// A model without inverse dynamics.
    pub(super) fn new(model: &Model) -> Result<Torques, Error> {
        let kind = torques_of(model);
        let joints = model.joints();
        let found = vec![0.0; joints * BLOCK];
        let sums = vec![Sums::default(); joints];
        Ok(Torques { kind, compiled: model.compiled(kind)?, found, rows: 0, sums })
    }

    /// The number of rows so far.
    pub(super) fn rows(&self) -> u64 {
        self.rows
    }

    /// Adds the rows of a block that have no nulls or NaN: columns of q, q̇, q̈ and τ of [`BLOCK`] rows each.
    ///
    /// # Errors
    ///
    /// A function that cannot be called.
    pub(super) fn push(&mut self, given: &[f64], are_whole: &[bool]) -> Result<(), Error> {
        let handle = function(&self.compiled.executable, self.kind)?;
        compute(handle, given, &mut self.found, are_whole.len())?;
        let measured = given.chunks_exact(BLOCK).skip(3 * self.sums.len());
        let columns = measured.zip(self.found.chunks_exact(BLOCK));
        for (sums, (measured, model)) in self.sums.iter_mut().zip(columns) {
            let rows = measured.iter().zip(model).zip(are_whole);
            for ((measured, model), _) in rows.filter(|(_, is_whole)| **is_whole) {
                sums.measured += measured;
                sums.model += model;
                sums.measured_squared += measured * measured;
                sums.model_squared += model * model;
                sums.product += measured * model;
            }
        }
        self.rows += are_whole.iter().filter(|is_whole| **is_whole).count() as u64;
        Ok(())
    }

    /// The likely mistakes in the units or directions of torques, joint by joint.
    pub(super) fn units(&self, model: &Model) -> Vec<String> {
        if self.rows < ROWS {
            return vec![];
        }
        let joints = model.robot.coordinates.iter().zip(&self.sums);
        let found = joints.filter_map(|(coordinate, sums)| {
            let what = sums.unit(self.rows as f64)?;
            Some(format!("torques of joint `{}` are {what}", coordinate.joint))
        });
        found.collect()
    }
}

impl Sums {
    /// The likely mistake in the unit over this number of rows.
    fn unit(&self, rows: f64) -> Option<String> {
        // Torques that are 0 in all rows were not measured.
        if self.measured_squared == 0.0 {
            return None;
        }
        let ratio = (self.measured_squared / self.model_squared).sqrt();
        let measured = self.measured_squared - self.measured.powi(2) / rows;
        let model = self.model_squared - self.model.powi(2) / rows;
        // The torques of a robot at rest vary only by rounding.
        let vary =
            measured > RESTING * self.measured_squared && model > RESTING * self.model_squared;
        let product = self.product - self.measured * self.model / rows;
        unit((ratio, if vary { product / (measured * model).sqrt() } else { 0.0 }))
    }
}

/// The likely mistake in the unit of torques, from their ratio to those of the model and the correlation of the
/// two.
pub(crate) fn unit((ratio, alike): (f64, f64)) -> Option<String> {
    // Friction can make torques many times larger than the model's, but then the correlation is low.
    if ratio > OFTEN && alike.abs() > ALIKE || ratio < 1.0 / OFTEN {
        return Some(format!(
            "{ratio:.3e} times those of the model: are they in N m or N (see --tau-factor), and of this robot?"
        ));
    }
    (alike < -ALIKE).then(|| {
        format!(
            "opposite to those of the model, with a correlation of {alike:.2}: are they those that the drive exerts (see \
             --tau-factor)?"
        )
    })
}
