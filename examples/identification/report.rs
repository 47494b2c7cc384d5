//! Runs the whole study and returns its results as text.

use std::error::Error;
use std::fmt::Write as _;

use robot_dynamics::base_parameters::{BaseParameter, base_parameters};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::description::read_toml;
use robot_numeric::random::Random;
use robot_symbolic::Graph;

use crate::study::{self, Estimate, Measurements, NOISE, PARAMETERS};
use crate::trajectory::{JOINTS, Joints, Trajectory};

pub(crate) const SEED: u64 = 560;
/// The number of trajectories, of which the best conditioned one is used, and the number of samples at which they
/// are compared.
const CANDIDATES: (u32, u32) = (20, 60);
/// The number of measurements along a trajectory.
const SAMPLES: u32 = 1000;

/// Returns the text to print, and the CSV with the torques along another trajectory.
pub(crate) fn report(seed: u64) -> Result<(String, String), Box<dyn Error>> {
    let mut random = Random::new(seed);
    let (candidates, samples) = CANDIDATES;
    let (trajectory, condition) =
        study::exciting(candidates, samples, &mut random).ok_or("no trajectory")?;
    let measured = study::measure(&trajectory, SAMPLES, &mut random);
    let estimate = study::estimate(&measured).ok_or("a parameter is not identifiable")?;
    let other = Trajectory::random(&study::LIMITS, &mut random);
    let unseen = study::measure(&other, SAMPLES, &mut random);
    let predicted: Vec<Joints> =
        unseen.states.iter().map(|state| study::predict(&estimate.parameters, state)).collect();

    let mut text =
        format!("seed {seed}\nbest of {candidates} trajectories: condition {condition:.0}\n\n");
    show_parameters(&estimate, &mut text)?;
    show_torques(&unseen, &predicted, &mut text)?;
    Ok((text, csv(&unseen, &predicted)?))
}

fn show_parameters(estimate: &Estimate, text: &mut String) -> Result<(), Box<dyn Error>> {
    let truth = study::true_parameters();
    writeln!(text, "{:<8} {:>12} {:>12} {:>12}", "", "true", "estimated", "std. dev.")?;
    let found = estimate.parameters.iter().zip(estimate.deviations.iter());
    for ((name, value), (found, deviation)) in names()?.iter().zip(truth).zip(found) {
        writeln!(text, "{name:<8} {value:>12.6} {found:>12.6} {deviation:>12.6}")?;
    }
    let distance = estimate.distance(&truth);
    let degrees = SAMPLES as usize * JOINTS - PARAMETERS;
    let residual = estimate.residual;
    writeln!(
        text,
        "\nchi-square of the errors: {distance:.1} with {PARAMETERS} degrees of freedom"
    )?;
    writeln!(text, "chi-square of the residual: {residual:.1} with {degrees} degrees of freedom")?;
    Ok(())
}

fn show_torques(
    measured: &Measurements,
    predicted: &[Joints],
    text: &mut String,
) -> Result<(), std::fmt::Error> {
    writeln!(text, "\nanother trajectory, root mean square, N m")?;
    writeln!(text, "{:<8} {:>12} {:>12} {:>12}", "joint", "torque", "residual", "noise")?;
    for (joint, noise) in NOISE.iter().enumerate() {
        let torque = rms(measured.torques.iter().map(|tau| tau[joint]));
        let pairs = measured.torques.iter().zip(predicted);
        let residual = rms(pairs.map(|(tau, predicted)| tau[joint] - predicted[joint]));
        writeln!(text, "{:<8} {torque:>12.4} {residual:>12.4} {noise:>12.4}", joint + 1)?;
    }
    Ok(())
}

/// The names of the base parameters, in the order of the regressor's columns.
fn names() -> Result<Vec<String>, Box<dyn Error>> {
    let text = include_str!("../../robots/puma560.toml");
    let robot = read_toml("puma560.toml", text).map_err(|errors| errors.to_string())?.robot;
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::EXACT, None);
    let found = base_parameters(&derivation).ok_or("no base parameters")?;
    Ok(found.base.iter().map(BaseParameter::name).collect())
}

/// The root mean square.
fn rms(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|value| value * value).sum::<f64>() / count).sqrt()
}

/// The CSV has a line for each state: the time, then for each joint the measured torque, the predicted torque and
/// their difference.
fn csv(measured: &Measurements, predicted: &[[f64; JOINTS]]) -> Result<String, std::fmt::Error> {
    let mut text = "t".to_owned();
    for joint in 1..=JOINTS {
        write!(text, ",measured{joint},predicted{joint},residual{joint}")?;
    }
    text.push('\n');
    let period = Trajectory::period() / measured.torques.len() as f64;
    for (sample, (tau, predicted)) in measured.torques.iter().zip(predicted).enumerate() {
        write!(text, "{:.4}", sample as f64 * period)?;
        for (measured, predicted) in tau.iter().zip(predicted) {
            write!(text, ",{measured:.6},{predicted:.6},{:.6}", measured - predicted)?;
        }
        text.push('\n');
    }
    Ok(text)
}
