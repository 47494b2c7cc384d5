//! Measures, estimates and predicts: the base parameters of the PUMA 560 from its torques.

use nalgebra::{DMatrix, DVector};
use robot_numeric::random::Random;

use crate::trajectory::{JOINTS, Joints, Trajectory};

robot_macros::include_robot!(
    "robots/puma560.toml",
    functions = ["inverse_dynamics", "regressor_base", "base_parameters"],
);
use puma560::Model;

/// The number of base parameters.
pub(crate) const PARAMETERS: usize = 36;

/// Limits of the joints' positions, rad: those of the robot file.
pub(crate) const LIMITS: [(f64, f64); JOINTS] =
    [(-2.79, 2.79), (-0.79, 3.93), (-3.93, 0.79), (-1.92, 2.97), (-1.75, 1.75), (-4.64, 4.64)];

/// The standard deviation of each torque's noise, N m.
pub(crate) const NOISE: Joints = [1.0, 1.0, 0.5, 0.01, 0.01, 0.01];

/// The base parameters from the robot file, in the order of the regressor's columns.
pub(crate) fn true_parameters() -> [f64; PARAMETERS] {
    Model::NOMINAL.base_parameters()
}

/// States along a trajectory and the torques measured there.
#[derive(Debug)]
pub(crate) struct Measurements {
    /// q, q̇ and q̈, which are assumed to be exact.
    pub(crate) states: Vec<[Joints; 3]>,
    /// Torques with noise, N m.
    pub(crate) torques: Vec<Joints>,
}

/// Simulates measurements at equal times over a period. The torques come from inverse dynamics, which
/// shares no expression with the regressor; noise is normal and independent.
pub(crate) fn measure(trajectory: &Trajectory, samples: u32, random: &mut Random) -> Measurements {
    let time = |sample| Trajectory::period() * f64::from(sample) / f64::from(samples);
    let states: Vec<[Joints; 3]> = (0..samples).map(|sample| trajectory.at(time(sample))).collect();
    let torques = states.iter().map(|[q, qd, qdd]| {
        let mut tau = Model::NOMINAL.inverse_dynamics(q, qd, qdd);
        for (tau, deviation) in tau.iter_mut().zip(NOISE) {
            *tau += deviation * normal(random);
        }
        tau
    });
    Measurements { torques: torques.collect(), states }
}

/// A random number with the standard normal distribution (Box and Muller 1958).
fn normal(random: &mut Random) -> f64 {
    let radius = (-2.0 * (1.0 - random.uniform(0.0, 1.0)).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.uniform(0.0, 1.0)).cos()
}

/// The regressor over all states, with a row for each torque, divided by the standard deviation of its noise.
pub(crate) fn weighted_regressor(states: &[[Joints; 3]]) -> DMatrix<f64> {
    let mut stacked = DMatrix::zeros(states.len() * JOINTS, PARAMETERS);
    for (sample, [q, qd, qdd]) in states.iter().enumerate() {
        let rows = Model::NOMINAL.regressor_base(q, qd, qdd);
        for (joint, row) in rows.iter().enumerate() {
            for (column, entry) in row.iter().enumerate() {
                stacked[(sample * JOINTS + joint, column)] = entry / NOISE[joint];
            }
        }
    }
    stacked
}

/// The ratio of the largest to the smallest singular value, with columns scaled to length 1: the largest factor by
/// which errors grow. It is infinite if a parameter has no effect.
pub(crate) fn condition(regressor: &DMatrix<f64>) -> f64 {
    let mut scaled = regressor.clone();
    for mut column in scaled.column_iter_mut() {
        let length = column.norm();
        column /= length;
    }
    let values = scaled.singular_values();
    values.max() / values.min()
}

/// The best conditioned of this number of random trajectories, and its condition number.
pub(crate) fn exciting(
    candidates: u32,
    samples: u32,
    random: &mut Random,
) -> Option<(Trajectory, f64)> {
    let tried = (0..candidates).map(|_| {
        let trajectory = Trajectory::random(&LIMITS, random);
        let time = |sample| Trajectory::period() * f64::from(sample) / f64::from(samples);
        let states: Vec<_> = (0..samples).map(|sample| trajectory.at(time(sample))).collect();
        let condition = condition(&weighted_regressor(&states));
        (trajectory, condition)
    });
    tried.min_by(|(_, a), (_, b)| a.total_cmp(b))
}

/// The result of least squares.
#[derive(Debug)]
pub(crate) struct Estimate {
    /// The base parameters.
    pub(crate) parameters: DVector<f64>,
    /// The standard deviations of the base parameters.
    pub(crate) deviations: DVector<f64>,
    /// WᵀW of the weighted regressor W, the inverse of the parameters' covariance.
    information: DMatrix<f64>,
    /// The sum of the squared residuals, each in units of its noise.
    pub(crate) residual: f64,
}

impl Estimate {
    /// The distance of the estimate from parameters, in units of its covariance. For the true parameters it has a
    /// χ² distribution with as many degrees of freedom as there are parameters.
    pub(crate) fn distance(&self, parameters: &[f64]) -> f64 {
        let error = &self.parameters - DVector::from_column_slice(parameters);
        (&self.information * &error).dot(&error)
    }
}

/// Weighted least squares by the QR decomposition W = Q R of the weighted regressor: R β = Qᵀ τ, and the covariance
/// R⁻¹ R⁻ᵀ. `None` if a parameter is not identifiable.
pub(crate) fn estimate(measured: &Measurements) -> Option<Estimate> {
    let regressor = weighted_regressor(&measured.states);
    let entries = measured.torques.iter().flat_map(|tau| tau.iter().zip(NOISE));
    let entries: Vec<f64> = entries.map(|(tau, deviation)| tau / deviation).collect();
    let torques = DVector::from_vec(entries);
    let (q, r) = regressor.clone().qr().unpack();
    let parameters = r.solve_upper_triangular(&(q.transpose() * &torques))?;
    let inverse = r.solve_upper_triangular(&DMatrix::identity(PARAMETERS, PARAMETERS))?;
    let variances = inverse.row_iter().map(|row| row.norm());
    Some(Estimate {
        deviations: DVector::from_iterator(PARAMETERS, variances),
        information: r.transpose() * &r,
        residual: (&regressor * &parameters - torques).norm_squared(),
        parameters,
    })
}

/// The torques that the parameters predict at a state, N m.
pub(crate) fn predict(parameters: &DVector<f64>, [q, qd, qdd]: &[Joints; 3]) -> Joints {
    let rows = Model::NOMINAL.regressor_base(q, qd, qdd);
    rows.map(|row| row.iter().zip(parameters.iter()).map(|(entry, value)| entry * value).sum())
}
