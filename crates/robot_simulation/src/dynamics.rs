//! Traits of the moving system and of its loads.

use crate::error::Cause;

/// Positions and velocities of the n coordinates: rad and rad/s, or m and m/s.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// q.
    pub q: Vec<f64>,
    /// q̇.
    pub qd: Vec<f64>,
}

/// Forward dynamics: what accelerates under joint torques.
pub trait Dynamics {
    /// n, the number of coordinates.
    fn degrees_of_freedom(&self) -> usize;

    /// The n accelerations q̈ (rad/s² or m/s²) under the n joint torques τ (N m or N).
    ///
    /// # Errors
    ///
    /// If the state has none. Values that are not finite are an error as well; the caller checks.
    fn accelerations(&self, state: &State, tau: &[f64]) -> Result<Vec<f64>, Cause>;

    /// Whether the accelerations at a state are more than rounding; asked at each sample.
    ///
    /// # Errors
    ///
    /// If they are not.
    fn check(&self, state: &State) -> Result<(), Cause> {
        let _ = state;
        Ok(())
    }

    /// The dry friction that holds joints at rest; `None` if none can. If there is some, the
    /// motion follows it and not [`Dynamics::accelerations`].
    fn dry_friction(&self) -> Option<&dyn DryFriction> {
        None
    }
}

/// Dry friction with a sharp sign: a coordinate at rest stays there until more is asked of its friction
/// than that can give.
pub trait DryFriction {
    /// For each of the n coordinates, whether dry friction can hold it.
    fn can_stick(&self) -> &[bool];

    /// Whether friction depends on the accelerations, as dry friction by load does.
    fn is_by_load(&self) -> bool;

    /// M(q), n × n, row by row: kg m², kg m or kg.
    ///
    /// # Errors
    ///
    /// If the positions have none.
    fn mass_matrix(&self, q: &[f64]) -> Result<Vec<f64>, Cause>;

    /// The n joint torques (N m or N) that the accelerations `qdd` take, with friction or without it.
    /// Friction takes the direction of each velocity from its sign, however small it is.
    ///
    /// # Errors
    ///
    /// If the state has none.
    fn joint_torques(&self, state: &State, qdd: &[f64], friction: bool) -> Result<Vec<f64>, Cause>;
}

/// Joint torques over time.
pub trait TorqueLaw {
    /// The n joint torques τ (N m or N) at the time t (s).
    fn torques(&self, t: f64, state: &State) -> Vec<f64>;

    /// Times, rising, at which the forces or their slopes jump. The integrator steps onto each: no
    /// step goes over a corner.
    fn corners(&self) -> &[f64] {
        &[]
    }

    /// Further times that the integrator must not step over in the span of the samples, s.
    fn features(&self, samples: &[f64]) -> Features {
        let _ = samples;
        Features::default()
    }
}

/// The times at which joint torques change so quickly that a step might miss it; s, ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// Times just before and just after a jump of the forces or their slopes: a step ends at the first, and
    /// the integrator starts anew at the second.
    pub jumps: Vec<[f64; 2]>,
    /// Times within short pulses. The integrator steps onto each.
    pub peaks: Vec<f64>,
}

/// Any function of time and state.
impl<F: Fn(f64, &State) -> Vec<f64>> TorqueLaw for F {
    fn torques(&self, t: f64, state: &State) -> Vec<f64> {
        self(t, state)
    }
}

/// The dynamics of n coordinates that a function gives, such as generated code: q̈ from state and τ.
pub fn from_fn<F: Fn(&State, &[f64]) -> Vec<f64>>(
    degrees_of_freedom: usize,
    accelerations: F,
) -> impl Dynamics {
    FromFn { degrees_of_freedom, accelerations }
}

struct FromFn<F> {
    degrees_of_freedom: usize,
    accelerations: F,
}

impl<F: Fn(&State, &[f64]) -> Vec<f64>> Dynamics for FromFn<F> {
    fn degrees_of_freedom(&self) -> usize {
        self.degrees_of_freedom
    }

    fn accelerations(&self, state: &State, tau: &[f64]) -> Result<Vec<f64>, Cause> {
        Ok((self.accelerations)(state, tau))
    }
}
