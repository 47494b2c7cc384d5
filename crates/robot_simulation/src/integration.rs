//! The steps of the integrator from event to event.

use differential_equations::error::Error as IntegratorError;
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::OrdinaryNumericalMethod;
use differential_equations::status::Status;
use robot_model::diagnostic::number;
use robot_model::variable::JointVariable;

use crate::dynamics::{Dynamics, State, TorqueLaw};
use crate::error::{Cause, Error};
use crate::events::{Base, Bracket, Event, any_ended};
use crate::friction::{Balance, Mode, chosen, starting};
use crate::simulation::SimulationOptions;
use crate::system::{Overrun, System};

/// The smallest step, as a fraction of the simulated time: shorter steps make no progress.
const SMALLEST_STEP: f64 = 1e-14;
/// Stops closer together than this fraction of the simulated time count as one.
const SMALLEST_PIECE: f64 = 1e-12;
/// The number of steps after which progress is checked.
const WATCHED: usize = 5000;
/// Velocities and accelerations above this magnitude are too large: their squares can exceed the range of `f64`.
const LARGE: f64 = 1e150;
/// The largest number of successive events with practically no time between them.
const MAX_EVENTS: usize = 100;

/// DOP853.
type Method = ExplicitRungeKutta<Ordinary, DormandPrince, f64, Vec<f64>, 8, 12, 16>;

/// A motion during its integration.
pub(crate) struct Integration<'s, D, L> {
    system: System<'s, D, L>,
    method: Method,
    options: SimulationOptions,
    /// The number of steps so far, including rejected ones.
    pub(crate) steps: usize,
    /// The time in s at which progress was last checked.
    watched: f64,
    /// The distance of each coordinate beyond the end of its mode at the integrator's time.
    overruns: Vec<Overrun>,
    /// The interval in which the next mode ends, while it is searched for.
    bracket: Option<Bracket>,
    /// The length in s of the next step, if it must lead to a time at which a mode seemed to end.
    shortened: Option<f64>,
    /// The time of the last event in s, and the number of preceding events at practically the same time.
    last_event: (f64, usize),
}

impl<'s, D: Dynamics, L: TorqueLaw> Integration<'s, D, L> {
    /// Starts a motion.
    pub(crate) fn new(
        dynamics: &'s D,
        torques: &'s L,
        start: &State,
        options: &SimulationOptions,
    ) -> Result<Integration<'s, D, L>, Error> {
        let method = ExplicitRungeKutta::dop853()
            .rtol(options.tolerance)
            .atol(options.tolerance)
            .max_steps(usize::MAX)
            .h_max(options.duration);
        let mut integration = Integration {
            system: System::new(dynamics, torques, options.tolerance),
            method,
            options: *options,
            steps: 0,
            watched: 0.0,
            overruns: vec![],
            bracket: None,
            shortened: None,
            last_event: (0.0, 0),
        };
        integration.choose(0.0, start, None)?;
        let y = integration.system.start(start);
        integration.restart(0.0, &y, 0.0)?;
        Ok(integration)
    }

    /// Returns the state, q̈ and τ at a time that has been reached.
    pub(crate) fn sample(&self, t: f64) -> Result<(State, Vec<f64>, Vec<f64>), Error> {
        let state = self.system.state(self.method.y());
        let stopped = |cause| Error::Stopped { t, cause };
        let (tau, Balance { qdd, .. }) = self.system.found(t, &state).map_err(stopped)?;
        self.system.check(&state).map_err(stopped)?;
        Ok((state, qdd, tau))
    }

    /// Integrates to a time; `progress` is called with the time reached, in s, after every step.
    pub(crate) fn reach(
        &mut self,
        target: f64,
        progress: &mut dyn FnMut(f64),
    ) -> Result<(), Error> {
        // The end of a step can differ from its target by rounding.
        while target - self.method.t() > SMALLEST_PIECE * self.options.duration {
            let before = self.method.t();
            self.bound(before)?;
            self.step(target)?;
            if self.method.t() > before && self.system.friction.is_some() {
                self.check(before)?;
            }
            progress(self.method.t());
        }
        Ok(())
    }

    /// Passes a jump of the joint torques: restarts from the state that was reached, at a time after the jump.
    pub(crate) fn jump(&mut self, after: f64) -> Result<(), Error> {
        let t = after.max(self.method.t());
        let y = self.method.y().clone();
        (self.bracket, self.shortened) = (None, None);
        self.choose(t, &self.system.state(&y), Some(&[]))?;
        self.restart(t, &y, 0.0)
    }

    /// The shortest time between two different events, in s.
    fn shortest(&self) -> f64 {
        SMALLEST_STEP * self.options.duration + 4.0 * f64::EPSILON * self.method.t()
    }

    /// Takes a step toward a time, or toward the end of a mode before it.
    fn step(&mut self, target: f64) -> Result<(), Error> {
        let (t, shortest) = (self.method.t(), self.shortest());
        let smallest = SMALLEST_STEP * self.options.duration;
        let mut length = self.method.h().min(target - t);
        if let Some(bracket) = &mut self.bracket {
            let base = Base { t, y: self.method.y(), overruns: &self.overruns };
            length = length.min(bracket.step(&base, shortest));
        } else if let Some(shortened) = self.shortened.take() {
            length = length.min(shortened);
        }
        let least = if self.bracket.is_some() { shortest / 4.0 } else { smallest };
        if length.is_nan() || length <= least {
            let cause = self.system.failure.take().unwrap_or(Cause::StepSize);
            return Err(Error::Stopped { t, cause });
        }
        self.method.set_h(length);
        self.steps += 1;
        self.system.seen.set(f64::INFINITY);
        match self.method.step(&self.system) {
            Ok(_) => Ok(()),
            // A stiff system is slow, but not an error; the number of steps is limited anyway.
            Err(IntegratorError::Stiffness { .. }) => {
                let (y, h) = (self.method.y().clone(), self.method.h());
                self.restart(t, &y, h)
            }
            Err(_) => Err(self.stopped(t)),
        }
    }

    /// Checks whether modes ended within the step from `before`. If so, the step is undone, and the following steps
    /// lead to the first end.
    fn check(&mut self, before: f64) -> Result<(), Error> {
        let (t, y) = (self.method.t(), self.method.y().clone());
        let stopped = |cause| Error::Stopped { t, cause };
        let state = self.system.state(&y);
        let (_, found) = self.system.found(t, &state).map_err(stopped)?;
        let overruns = self.system.overruns(&state, &found);
        let length = t - before;
        let seen = self.system.seen.get() - before;
        if any_ended(&overruns) {
            self.bracket = Some(Bracket::new(t, &y, overruns, self.bracket.as_ref()));
            let y = self.method.y_prev().clone();
            self.restart(before, &y, length)?;
        } else if self.bracket.is_none() && seen > self.shortest() && seen < 0.9 * length {
            self.shortened = Some(seen);
            let y = self.method.y_prev().clone();
            return self.restart(before, &y, length);
        } else {
            self.overruns = overruns;
        }
        let base = Base { t: self.method.t(), y: self.method.y(), overruns: &self.overruns };
        let shortest = self.shortest();
        match self.bracket.as_ref().and_then(|bracket| bracket.event(&base, shortest)) {
            Some(event) => self.pass(event),
            None => Ok(()),
        }
    }

    /// Passes an event: velocities that became 0 are set to exactly 0, and the modes are chosen again.
    fn pass(&mut self, event: Event) -> Result<(), Error> {
        let Event { t, mut y, ended } = event;
        let near = t - self.last_event.0 <= 4.0 * self.shortest();
        self.last_event = (t, if near { self.last_event.1 + 1 } else { 0 });
        if self.last_event.1 > MAX_EVENTS {
            return Err(Error::Stopped { t, cause: Cause::Events });
        }
        let count = self.system.modes.len();
        for index in &ended {
            if let Mode::Sliding(_) = self.system.modes[*index] {
                y[count + index] = 0.0;
            }
        }
        let state = self.system.state(&y);
        self.choose(t, &state, Some(&ended))?;
        self.bracket = None;
        self.restart(t, &y, 0.0)
    }

    /// Chooses the modes of a state, and computes the distances from their ends.
    fn choose(&mut self, t: f64, state: &State, ended: Option<&[usize]>) -> Result<(), Error> {
        let stopped = |cause| Error::Stopped { t, cause };
        let Some(friction) = self.system.friction else {
            return self.system.found(t, state).map(|_| ()).map_err(stopped);
        };
        let mut guess = starting(friction, &state.qd);
        for (index, mode) in self.system.modes.iter().enumerate() {
            // A coordinate that starts to move slowly is still at rest.
            let goes_on = ended.is_some_and(|ended| !ended.contains(&index));
            if goes_on && state.qd[index] == 0.0 {
                guess[index] = *mode;
            }
        }
        let tau = self.system.driving(t, state).map_err(stopped)?;
        let (modes, _) = chosen(friction, state, &tau, guess).map_err(stopped)?;
        self.system.modes = modes;
        let (_, found) = self.system.found(t, state).map_err(stopped)?;
        self.overruns = self.system.overruns(state, &found);
        Ok(())
    }

    /// Sets the integrator to a state; with the length 0 it chooses its first step itself.
    fn restart(&mut self, t: f64, y: &Vec<f64>, length: f64) -> Result<(), Error> {
        // The end only limits the first step.
        let end = t + self.options.duration;
        self.method.h0 = length;
        let started = self.method.init(&self.system, t, end, y);
        started.map_err(|error| match error {
            IntegratorError::BadInput { .. } => Error::Stopped { t, cause: self.too_large(t, y) },
            _ => self.stopped(t),
        })?;
        self.method.set_status(Status::Solving);
        Ok(())
    }

    /// Checks that steps are left, and that the last ones advanced far enough.
    fn bound(&mut self, t: f64) -> Result<(), Error> {
        let limit = self.options.max_steps;
        if self.steps >= limit {
            return Err(Error::Stopped { t, cause: Cause::Steps(limit) });
        }
        if self.steps > 0 && self.steps.is_multiple_of(WATCHED) {
            let part = (t - self.watched) / self.options.duration;
            if part * (limit as f64) < WATCHED as f64 {
                return Err(Error::Stopped { t, cause: Cause::Slow(WATCHED, limit) });
            }
            self.watched = t;
        }
        Ok(())
    }

    /// The reason why steps are too small, which the integrator does not report.
    fn stopped(&self, t: f64) -> Error {
        let cause = self.system.failure.take().unwrap_or(Cause::StepSize);
        Error::Stopped { t, cause }
    }

    /// The reason why there is no first step: the largest velocity or acceleration.
    fn too_large(&self, t: f64, y: &[f64]) -> Cause {
        let state = self.system.state(y);
        let qdd = match self.system.found(t, &state) {
            Ok((_, Balance { qdd, .. })) => qdd,
            Err(cause) => return cause,
        };
        let named = |variable: JointVariable, values: Vec<f64>| {
            let entries = values.into_iter().enumerate();
            entries.map(move |(index, value)| (variable.symbol(index), value))
        };
        let all =
            named(JointVariable::Velocity, state.qd).chain(named(JointVariable::Acceleration, qdd));
        match all.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs())) {
            Some((name, value)) if value.abs() > LARGE => {
                Cause::Large(format!("{name} = {}", number(value)))
            }
            _ => Cause::StepSize,
        }
    }
}
