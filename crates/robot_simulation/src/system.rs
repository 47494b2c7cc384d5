//! The differential equations of a motion, in the form that the integrator needs.

use std::cell::{Cell, RefCell};

use differential_equations::ode::ODE;

use crate::dynamics::{DryFriction, Dynamics, State, TorqueLaw};
use crate::error::Cause;
use crate::friction::{Balance, Holding, Mode, balance};

/// The magnitude of a velocity, in rad/s or m/s, below which a coordinate comes to rest.
pub(crate) const REST: f64 = 1e-13;

/// The derivative ẏ of y = (q, q̇) under the joint torques.
///
/// With dry friction, y has n more entries: for a coordinate that is held, the velocity that it would have gained
/// without friction. They make steps short enough to resolve changes of the force that is required to hold it.
pub(crate) struct System<'s, D, L> {
    dynamics: &'s D,
    torques: &'s L,
    /// The dry friction that can hold coordinates at rest.
    pub(crate) friction: Option<&'s dyn DryFriction>,
    /// The modes of the coordinates, if there is such friction.
    pub(crate) modes: Vec<Mode>,
    /// The tolerance for the error of a step.
    tolerance: f64,
    /// The last error, because the integrator only receives NaN.
    pub(crate) failure: RefCell<Option<Cause>>,
    /// The earliest time within a step at which a mode seemed to have ended.
    pub(crate) seen: Cell<f64>,
}

/// The distance of a coordinate beyond the end of its mode: a velocity that has changed its sign, or a force that
/// friction cannot supply.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Overrun {
    /// The distance, which is positive beyond the end.
    pub(crate) value: f64,
    /// The distance from the end that is precise enough.
    pub(crate) tolerance: f64,
}

impl<'s, D: Dynamics, L: TorqueLaw> System<'s, D, L> {
    pub(crate) fn new(dynamics: &'s D, torques: &'s L, tolerance: f64) -> System<'s, D, L> {
        System {
            dynamics,
            torques,
            friction: dynamics.dry_friction(),
            modes: vec![],
            tolerance,
            failure: RefCell::new(None),
            seen: Cell::new(f64::INFINITY),
        }
    }

    /// The state q, q̇ in y.
    pub(crate) fn state(&self, y: &[f64]) -> State {
        let count = self.dynamics.degrees_of_freedom();
        let part = |from: usize| y.iter().copied().skip(from).take(count).collect();
        State { q: part(0), qd: part(count) }
    }

    /// The vector y for a state.
    pub(crate) fn start(&self, state: &State) -> Vec<f64> {
        let mut y = [&state.q[..], &state.qd[..]].concat();
        if self.friction.is_some() {
            y.resize(3 * state.q.len(), 0.0);
        }
        y
    }

    /// The joint torques τ; an error if they are not finite.
    pub(crate) fn driving(&self, t: f64, state: &State) -> Result<Vec<f64>, Cause> {
        let tau = self.torques.torques(t, state);
        if tau.len() != state.q.len() || !tau.iter().all(|value| value.is_finite()) {
            return Err(Cause::Torques);
        }
        Ok(tau)
    }

    /// The joint torques τ, the accelerations q̈, and the friction of held coordinates.
    pub(crate) fn found(&self, t: f64, state: &State) -> Result<(Vec<f64>, Balance), Cause> {
        let tau = self.driving(t, state)?;
        let found = match self.friction {
            Some(friction) => balance(friction, state, &tau, &self.modes)?,
            None => Balance { qdd: self.dynamics.accelerations(state, &tau)?, holding: vec![] },
        };
        let Balance { qdd, .. } = &found;
        if qdd.len() != state.q.len() || !qdd.iter().all(|value| value.is_finite()) {
            return Err(Cause::Accelerations);
        }
        Ok((tau, found))
    }

    /// Checks that the accelerations are more than rounding errors.
    pub(crate) fn check(&self, state: &State) -> Result<(), Cause> {
        self.dynamics.check(state)
    }

    /// The distance of each coordinate beyond the end of its mode.
    pub(crate) fn overruns(&self, state: &State, found: &Balance) -> Vec<Overrun> {
        let holding = found.holding.iter();
        let of_mode =
            |((mode, qd), holding): ((&Mode, &f64), &Option<Holding>)| match (mode, holding) {
                (Mode::Sliding(direction), _) => {
                    Overrun { value: -direction * qd, tolerance: REST }
                }
                (Mode::Held, Some(holding)) => {
                    Overrun { value: holding.excess(), tolerance: holding.slack }
                }
                _ => Overrun { value: f64::NEG_INFINITY, tolerance: 0.0 },
            };
        self.modes.iter().zip(&state.qd).zip(holding).map(of_mode).collect()
    }

    fn derivatives(&self, t: f64, y: &[f64]) -> Result<Vec<f64>, Cause> {
        let state = self.state(y);
        let (_, found) = self.found(t, &state)?;
        let mut dydt = [&state.qd[..], &found.qdd[..]].concat();
        if self.friction.is_some() {
            for holding in &found.holding {
                let gained = holding.map_or(0.0, |holding| match holding.inertia > 0.0 {
                    true => holding.force / holding.inertia,
                    false => holding.force,
                });
                dydt.push(gained);
            }
            self.look(t, &state, &found);
        }
        Ok(dydt)
    }

    /// Records the time if a mode seems to have ended. States within a step are only approximate, so this is checked
    /// again with a step to that time.
    fn look(&self, t: f64, state: &State, found: &Balance) {
        let margin = 100.0 * self.tolerance;
        let ended = |(overrun, qd): (Overrun, &f64)| {
            overrun.value > overrun.tolerance + margin * (1.0 + qd.abs())
        };
        let seen = self.overruns(state, found).into_iter().zip(&state.qd).any(ended);
        if seen && t < self.seen.get() {
            self.seen.set(t);
        }
    }
}

impl<D: Dynamics, L: TorqueLaw> ODE<f64, Vec<f64>> for System<'_, D, L> {
    fn diff(&self, t: f64, y: &Vec<f64>, dydt: &mut Vec<f64>) {
        match self.derivatives(t, y) {
            Ok(derivatives) => *dydt = derivatives,
            Err(cause) => {
                dydt.fill(f64::NAN);
                *self.failure.borrow_mut() = Some(cause);
            }
        }
    }
}
