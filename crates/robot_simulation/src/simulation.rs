//! The simulation of motions.

use robot_model::diagnostic::number;
use robot_model::variable::JointVariable;

use crate::dynamics::{Dynamics, Features, State, TorqueLaw};
use crate::error::Error;
use crate::grid;
use crate::integration::Integration;
use crate::motion::Motion;

/// The duration and accuracy of a simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulationOptions {
    /// The simulated time, in s.
    pub duration: f64,
    /// The time between samples of the output, in s; the integrator chooses its own steps between them.
    pub step: f64,
    /// The error that a step of the integrator is allowed in a component y of q and q̇, according to its estimate:
    /// tolerance · (1 + |y|), in rad, m, rad/s or m/s.
    pub tolerance: f64,
    /// The largest number of steps of the integrator, including rejected ones; it takes at least one for each sample.
    /// If the rate of the last 5000 steps would require more, the simulation ends.
    pub max_steps: usize,
}

/// The default options: 10 s, samples every 0.01 s, a tolerance of 10⁻⁹, and a million steps.
impl Default for SimulationOptions {
    fn default() -> SimulationOptions {
        SimulationOptions { duration: 10.0, step: 0.01, tolerance: 1e-9, max_steps: 1_000_000 }
    }
}

/// Simulates the motion q(t) from a state under joint torques: the forward dynamics (7) of the paper.
///
/// The method is that of Dormand and Prince of order 8 with error estimates of orders 5 and 3 (DOP853; Hairer, Nørsett
/// and Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.10). A step ends at every sample, so nothing is
/// interpolated. `progress` is called with the time reached, in s, after every step.
///
/// If [`Dynamics::dry_friction`] returns dry friction, a step also ends at every event: when a coordinate comes to
/// rest, and when the force required to hold one at rest exceeds what its friction can supply. A coordinate that is
/// held by friction keeps its position, and its velocity and acceleration are 0.
///
/// # Errors
///
/// All invalid options and entries of the state at once, or the reason why the integration stopped early.
pub fn simulate(
    dynamics: &impl Dynamics,
    torques: &impl TorqueLaw,
    start: &State,
    options: &SimulationOptions,
    progress: &mut dyn FnMut(f64),
) -> Result<Motion, Error> {
    let times = grid::times(options.duration, options.step)?;
    check(dynamics, start, options)?;
    let mut integration = Integration::new(dynamics, torques, start, options)?;
    let mut motion = Motion::default();
    for target in stops(&times, torques.corners(), &torques.features(&times)) {
        integration.reach(target.t, progress)?;
        match target.then {
            Then::Nothing => {}
            Then::Sample => {
                let (state, qdd, tau) = integration.sample(target.t)?;
                motion.push(target.t, state, qdd, tau);
            }
            Then::Jump(after) => integration.jump(after)?,
        }
    }
    motion.steps = integration.steps;
    Ok(motion)
}

/// A time at which a step ends.
struct Stop {
    t: f64,
    then: Then,
}

/// The action at such a time.
enum Then {
    Nothing,
    Sample,
    /// The joint torques jump before this time.
    Jump(f64),
}

/// The times of samples, and those of corners, peaks and jumps between them.
fn stops(samples: &[f64], corners: &[f64], features: &Features) -> Vec<Stop> {
    let end = samples.last().copied().unwrap_or(0.0);
    let corners = corners.iter().chain(&features.peaks);
    let corners = corners.map(|t| Stop { t: *t, then: Then::Nothing });
    let jumps = features.jumps.iter();
    let jumps = jumps.map(|[before, after]| Stop { t: before.max(0.0), then: Then::Jump(*after) });
    let mut stops: Vec<Stop> =
        corners.chain(jumps).filter(|stop| (0.0..end).contains(&stop.t)).collect();
    stops.extend(samples.iter().map(|t| Stop { t: *t, then: Then::Sample }));
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
        let tolerance = number(tolerance);
        wrong.push(format!("the tolerance is {tolerance}; it must be between 1e-14 and 0.1"));
    }
    let expected = dynamics.degrees_of_freedom();
    for (variable, values) in
        [(JointVariable::Position, &start.q), (JointVariable::Velocity, &start.qd)]
    {
        let name = variable.name();
        if values.len() != expected {
            let count = values.len();
            let entries = if count == 1 { "entry" } else { "entries" };
            wrong
                .push(format!("the initial state has {count} {entries} of {name}, not {expected}"));
        }
        if values.iter().any(|value| !value.is_finite()) {
            wrong.push(format!("the initial state has entries of {name} that are not finite"));
        }
    }
    Error::check(wrong, ())
}
