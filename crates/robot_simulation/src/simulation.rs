//! The integration of the motion law.

use std::cell::RefCell;

use differential_equations::error::Error as IntegratorError;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;

use crate::dynamics::{Dynamics, State, TorqueLaw};
use crate::error::{Cause, Error};
use crate::grid;
use crate::motion::Motion;

/// How long and how exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulationOptions {
    /// The time that is simulated, s.
    pub duration: f64,
    /// The time between samples of the output, s; the integrator chooses its own steps between them.
    pub step: f64,
    /// The error that a step of the integrator may make in a component y of q and q̇, as it estimates
    /// it: tolerance · (1 + |y|), in rad, m, rad/s or m/s.
    pub tolerance: f64,
    /// The most steps that the integrator may take, rejected ones too; it takes at least one for each
    /// sample.
    pub max_steps: usize,
}

/// 10 s, samples at 0.01 s, a tolerance of 10⁻⁹, ten million steps.
impl Default for SimulationOptions {
    fn default() -> SimulationOptions {
        SimulationOptions { duration: 10.0, step: 0.01, tolerance: 1e-9, max_steps: 10_000_000 }
    }
}

/// Steps smaller than this part of the time that is simulated lead nowhere.
const SMALLEST_STEP: f64 = 1e-14;

/// Stops nearer to each other than this part of the time that is simulated are one.
const SMALLEST_PIECE: f64 = 1e-12;

/// The motion law q(t) from a state under driving forces: the direct problem (7) of the paper.
///
/// The method is that of Dormand and Prince of order 8 with error estimates of orders 5 and 3
/// (DOP853; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.10).
/// It steps onto every sample, so that nothing is interpolated. `progress` hears the time reached, s,
/// after every step.
///
/// # Errors
///
/// Options or a state that make no sense, all at once; why the integration ended before its time.
pub fn simulate(
    dynamics: &impl Dynamics,
    torques: &impl TorqueLaw,
    start: &State,
    options: &SimulationOptions,
    progress: &mut dyn FnMut(f64),
) -> Result<Motion, Error> {
    let times = grid::times(options.duration, options.step)?;
    check(dynamics, start, options)?;
    let system = System { dynamics, torques, failure: RefCell::new(None) };
    // What fails at the start would be a rejected step to the integrator.
    system.derivatives(0.0, start).map_err(|cause| Error::Stopped { t: 0.0, cause })?;
    let mut motion = Motion::default();
    let mut method = ExplicitRungeKutta::dop853()
        .rtol(options.tolerance)
        .atol(options.tolerance)
        .max_steps(usize::MAX)
        .h_max(options.duration);
    let y = [&start.q[..], &start.qd[..]].concat();
    let stopped = |t: f64, error| Error::Stopped { t, cause: cause(&system, error) };
    method.init(&system, 0.0, options.duration, &y).map_err(|error| stopped(0.0, error))?;
    method.set_status(Status::Solving);
    for target in stops(&times, torques.corners()) {
        // The end of a step lies within rounding of the time that it was to reach.
        while target.t - method.t() > SMALLEST_PIECE * options.duration {
            let before = method.t();
            method.set_h(method.h().min(target.t - before));
            if method.h().is_nan() || method.h() <= SMALLEST_STEP * options.duration {
                let cause = system.failure.take().unwrap_or(Cause::StepSize);
                return Err(Error::Stopped { t: before, cause });
            }
            if motion.steps == options.max_steps {
                return Err(Error::Stopped { t: before, cause: Cause::Steps(motion.steps) });
            }
            motion.steps += 1;
            match method.step(&system) {
                Ok(_) => progress(method.t()),
                // What is stiff is slow, no error; the steps are limited in any case.
                Err(IntegratorError::Stiffness { .. }) => {
                    method.h0 = method.h();
                    let (y, end) = (method.y().clone(), options.duration);
                    method
                        .init(&system, before, end, &y)
                        .map_err(|error| stopped(before, error))?;
                    method.set_status(Status::Solving);
                }
                Err(error) => return Err(stopped(before, error)),
            }
        }
        if target.is_sample {
            let state = state(method.y());
            let found = system.derivatives(target.t, &state);
            let (tau, qdd) = found.map_err(|cause| Error::Stopped { t: target.t, cause })?;
            motion.push(target.t, state, qdd, tau);
        }
    }
    Ok(motion)
}

/// A time at which a step ends.
struct Stop {
    t: f64,
    is_sample: bool,
}

/// The samples, and the corners between them.
fn stops(samples: &[f64], corners: &[f64]) -> Vec<Stop> {
    let end = samples.last().copied().unwrap_or(0.0);
    let corners = corners.iter().copied().filter(|corner| (0.0..end).contains(corner));
    let mut stops: Vec<Stop> = corners.map(|t| Stop { t, is_sample: false }).collect();
    stops.extend(samples.iter().map(|t| Stop { t: *t, is_sample: true }));
    stops.sort_by(|a, b| a.t.total_cmp(&b.t));
    stops
}

fn check(
    dynamics: &impl Dynamics,
    start: &State,
    options: &SimulationOptions,
) -> Result<(), Error> {
    let mut wrong = vec![];
    let tolerance = options.tolerance;
    if !(1e-14..=0.1).contains(&tolerance) {
        wrong.push(format!("the tolerance is {tolerance}; it must lie between 1e-14 and 0.1"));
    }
    let expected = dynamics.degrees_of_freedom();
    for (name, values) in [("q", &start.q), ("qd", &start.qd)] {
        if values.len() != expected {
            let count = values.len();
            wrong.push(format!("the start has {count} entries of {name}, not {expected}"));
        }
        if values.iter().any(|value| !value.is_finite()) {
            wrong.push(format!("the start has entries of {name} that are not finite"));
        }
    }
    Error::check(wrong, ())
}

/// The words of the integrator, or what stood behind them.
fn cause<D: Dynamics, L: TorqueLaw>(
    system: &System<'_, D, L>,
    error: IntegratorError<f64, Vec<f64>>,
) -> Cause {
    match error {
        IntegratorError::StepSize { .. } => system.failure.take().unwrap_or(Cause::StepSize),
        other => Cause::Other(format!("{other:?}")),
    }
}

/// y = (q, q̇).
fn state(y: &[f64]) -> State {
    let (q, qd) = y.split_at(y.len() / 2);
    State { q: q.to_vec(), qd: qd.to_vec() }
}

/// ẏ = (q̇, q̈) under the driving forces.
struct System<'s, D, L> {
    dynamics: &'s D,
    torques: &'s L,
    /// What went wrong last, for the integrator knows of NaN only.
    failure: RefCell<Option<Cause>>,
}

impl<D: Dynamics, L: TorqueLaw> System<'_, D, L> {
    /// τ and q̈.
    fn derivatives(&self, t: f64, state: &State) -> Result<(Vec<f64>, Vec<f64>), Cause> {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let expected = state.q.len();
        let tau = self.torques.torques(t, state);
        if tau.len() != expected || !finite(&tau) {
            return Err(Cause::Torques);
        }
        let qdd = self.dynamics.accelerations(state, &tau)?;
        if qdd.len() != expected || !finite(&qdd) {
            return Err(Cause::Accelerations);
        }
        Ok((tau, qdd))
    }
}

impl<D: Dynamics, L: TorqueLaw> ODE<f64, Vec<f64>> for System<'_, D, L> {
    fn diff(&self, t: f64, y: &Vec<f64>, dydt: &mut Vec<f64>) {
        let state = state(y);
        match self.derivatives(t, &state) {
            Ok((_, qdd)) => {
                dydt.clear();
                dydt.extend(state.qd.iter().chain(&qdd));
            }
            Err(cause) => {
                dydt.fill(f64::NAN);
                *self.failure.borrow_mut() = Some(cause);
            }
        }
    }
}
