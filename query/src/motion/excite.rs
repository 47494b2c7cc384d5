//! Trajectories with a small condition number of the regressor.

use std::sync::Arc;

use datafusion::arrow::array::{ArrayRef, Float64Array};
use robot_symbolic::Random;

use super::trajectory::{Limits, Trajectory};
use crate::columns::Columns;
use crate::error::Error;
use crate::identify::{Measurements, Scratch};
use crate::robots::Model;

/// The number of states of a period at which the regressor is computed.
const SAMPLES: usize = 250;

/// The options of the search for a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation {
    /// The limits of the joints.
    pub limits: Vec<Limits>,
    /// The period, s.
    pub period: f64,
    /// The standard deviations of the torques' noise, N m or N.
    pub noise: Vec<f64>,
    /// The number of trajectories to try: a third of them at random, the others near the best so far.
    pub tries: usize,
    /// The seed of the pseudo-random numbers.
    pub seed: u64,
}

/// Returns the trajectory with the smallest condition number of those tried, and that number.
///
/// # Errors
///
/// A robot without base parameters; motions in which some base parameters have no effect.
pub fn excite(model: &Arc<Model>, how: &Excitation) -> Result<(Trajectory, f64), Error> {
    let mut random = Random::new(how.seed);
    let frequency = 1.0 / how.period;
    let mut best: Option<(Trajectory, f64)> = None;
    for place in 0..how.tries.max(1) {
        let next = match &best {
            Some((trajectory, _)) if place > how.tries / 3 => {
                trajectory.near(&how.limits, &mut random)
            }
            _ => Trajectory::random(&how.limits, frequency, &mut random),
        };
        let condition = condition(model, &next, &how.noise)?;
        if best.as_ref().is_none_or(|(_, least)| condition < *least) {
            best = Some((next, condition));
        }
    }
    best.filter(|(_, condition)| condition.is_finite()).ok_or_else(|| {
        Error::Identification(
            "none of the trajectories tried determines all parameters; try more, or faster ones"
                .to_owned(),
        )
    })
}

/// The condition number of the regressor along a trajectory; infinite if parameters are not identifiable.
fn condition(model: &Arc<Model>, trajectory: &Trajectory, noise: &[f64]) -> Result<f64, Error> {
    let joints = model.joints();
    let mut columns = vec![Vec::with_capacity(SAMPLES); 3 * joints];
    let mut row = vec![0.0; 3 * joints];
    for sample in 0..SAMPLES {
        trajectory.at(trajectory.period() * sample as f64 / SAMPLES as f64, &mut row);
        columns.iter_mut().zip(&row).for_each(|(column, value)| column.push(*value));
    }
    columns.extend(vec![vec![0.0; SAMPLES]; joints]);
    let array = |column: Vec<f64>| -> ArrayRef { Arc::new(Float64Array::from(column)) };
    let arrays: Vec<ArrayRef> = columns.into_iter().map(array).collect();
    let columns = Columns::new(&arrays, SAMPLES, &[4 * joints], "a trajectory")?;
    let mut measurements = Measurements::new(model.clone())?;
    measurements.push(&columns, &mut Scratch::default())?;
    measurements.condition(noise)
}
