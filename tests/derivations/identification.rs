//! A small version of the example `identification`: the errors of the estimates must be consistent with the noise.

use nalgebra::DVector;
use robot_numeric::random::Random;

use crate::report;
use crate::study::{self, NOISE, PARAMETERS};
use crate::trajectory::{JOINTS, Trajectory};

const SEED: u64 = 7;
const SAMPLES: u32 = 300;

/// The sum of n squared standard normal numbers is n with a standard deviation of √(2n). A deviation of more than six
/// times this value cannot be due to chance.
fn assert_chi_square(sum: f64, degrees: usize, what: &str) {
    let degrees = degrees as f64;
    let deviations = (sum - degrees).abs() / (2.0 * degrees).sqrt();
    assert!(deviations < 6.0, "seed {SEED}, {what}: {sum} for {degrees}");
}

#[test]
fn estimates_are_off_by_what_the_noise_allows() {
    let mut random = Random::new(SEED);
    let (trajectory, condition) = study::exciting(5, 60, &mut random).unwrap();
    assert!(condition < 1e4, "seed {SEED}: condition {condition}");
    let measured = study::measure(&trajectory, SAMPLES, &mut random);
    let estimate = study::estimate(&measured).unwrap();
    let truth = DVector::from_column_slice(&study::true_parameters());
    let error = &estimate.parameters - &truth;
    // The errors in units of their covariance, for all parameters together and for each one.
    let distance = estimate.distance(&study::true_parameters());
    assert_chi_square(distance, PARAMETERS, "the parameters");
    let rows = SAMPLES as usize * JOINTS;
    assert_chi_square(estimate.residual, rows - PARAMETERS, "the residual");
    for (error, deviation) in error.iter().zip(estimate.deviations.iter()) {
        assert!(error.abs() < 6.0 * deviation, "seed {SEED}: {error} with {deviation}");
    }
    // Large parameters are estimated to within a few percent.
    for (value, deviation) in truth.iter().zip(estimate.deviations.iter()) {
        assert!(value.abs() < 0.5 || deviation / value.abs() < 0.1, "{value} with {deviation}");
    }
}

#[test]
fn torques_of_another_trajectory_are_predicted_to_the_noise() {
    let mut random = Random::new(SEED);
    let (trajectory, _) = study::exciting(5, 60, &mut random).unwrap();
    let measured = study::measure(&trajectory, SAMPLES, &mut random);
    let estimate = study::estimate(&measured).unwrap();
    let other = Trajectory::random(&study::LIMITS, &mut random);
    let unseen = study::measure(&other, SAMPLES, &mut random);
    for joint in 0..JOINTS {
        let squares = unseen.states.iter().zip(&unseen.torques).map(|(state, tau)| {
            let residual = tau[joint] - study::predict(&estimate.parameters, state)[joint];
            (residual / NOISE[joint]).powi(2)
        });
        // The noise of this trajectory, plus the contribution of the error of the estimate.
        let mean = squares.sum::<f64>() / f64::from(SAMPLES);
        assert!(mean > 0.5 && mean < 2.0, "seed {SEED}, joint {}: {mean}", joint + 1);
    }
}

/// Without noise, the true parameters give the torques: the columns of the regressor belong to the parameters.
#[test]
fn the_regressor_times_the_true_parameters_is_the_torque() {
    let mut random = Random::new(SEED);
    let trajectory = Trajectory::random(&study::LIMITS, &mut random);
    let truth = DVector::from_column_slice(&study::true_parameters());
    for step in 0..50 {
        let state = trajectory.at(f64::from(step) * Trajectory::period() / 50.0);
        let [q, qd, qdd] = &state;
        let tau = study::puma560::Model::NOMINAL.inverse_dynamics(q, qd, qdd);
        let largest = tau.iter().fold(1.0, |largest: f64, tau| largest.max(tau.abs()));
        for (predicted, tau) in study::predict(&truth, &state).iter().zip(tau) {
            assert!((predicted - tau).abs() < 1e-11 * largest, "{predicted} {tau}");
        }
    }
}

#[test]
fn the_page_shows_what_the_example_prints() {
    let blocks = robot_testing::pages::blocks(include_str!("../../docs/users/identification.md"));
    let shown = blocks.iter().find(|block| block.is("printed")).unwrap();
    assert_eq!(shown.text, report::report(report::SEED).unwrap().0);
}
