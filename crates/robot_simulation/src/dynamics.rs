//! The traits of the moving system and of its joint torques.

use crate::error::Cause;

/// The positions and velocities of the n coordinates, in rad and rad/s or in m and m/s.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The joint positions q.
    pub q: Vec<f64>,
    /// The joint velocities q̇.
    pub qd: Vec<f64>,
}

/// Forward dynamics: joint accelerations under given joint torques.
pub trait Dynamics {
    /// The number of coordinates, n.
    fn degrees_of_freedom(&self) -> usize;

    /// Returns the n accelerations q̈ (rad/s² or m/s²) under the n joint torques τ (N m or N).
    ///
    /// # Errors
    ///
    /// If the state has no accelerations. Values that are not finite are an error too, which the caller detects.
    fn accelerations(&self, state: &State, tau: &[f64]) -> Result<Vec<f64>, Cause>;

    /// Checks that the accelerations at a state are more than rounding errors; called for every sample.
    ///
    /// # Errors
    ///
    /// If they are not.
    fn check(&self, state: &State) -> Result<(), Cause> {
        let _ = state;
        Ok(())
    }

    /// The dry friction that holds joints at rest; `None` if no dry friction can. If it is not `None`, the motion
    /// follows from it and not from [`Dynamics::accelerations`].
    fn dry_friction(&self) -> Option<&dyn DryFriction> {
        None
    }
}

/// Dry friction without smoothing: a coordinate at rest stays at rest while its friction can supply the force that is
/// required to hold it.
pub trait DryFriction {
    /// For each of the n coordinates, whether dry friction can hold it.
    fn can_stick(&self) -> &[bool];

    /// Whether friction depends on the accelerations, as load-dependent dry friction does.
    fn is_by_load(&self) -> bool;

    /// The mass matrix M(q), n × n, row by row, in kg m², kg m or kg.
    ///
    /// # Errors
    ///
    /// If the positions have no mass matrix.
    fn mass_matrix(&self, q: &[f64]) -> Result<Vec<f64>, Cause>;

    /// The n joint torques (N m or N) for the accelerations `qdd`, with or without friction. Friction takes its
    /// direction from the sign of each velocity, however small the velocity is.
    ///
    /// # Errors
    ///
    /// If the state has no joint torques.
    fn joint_torques(&self, state: &State, qdd: &[f64], friction: bool) -> Result<Vec<f64>, Cause>;
}

/// Joint torques as functions of time and state.
pub trait TorqueLaw {
    /// Returns the n joint torques τ (N m or N) at the time t (s).
    fn torques(&self, t: f64, state: &State) -> Vec<f64>;

    /// The times (s), in ascending order, at which the joint torques or their slopes jump. The integrator ends a step at
    /// each of them, so no step contains such a time.
    fn corners(&self) -> &[f64] {
        &[]
    }

    /// Further times in the span of the samples (s) at which a step of the integrator must end.
    fn features(&self, samples: &[f64]) -> Features {
        let _ = samples;
        Features::default()
    }
}

/// The times, in s and in ascending order, at which joint torques change so quickly that a step might miss the change.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// The times just before and just after each jump of the joint torques or their slopes. A step ends at the first,
    /// and the integrator restarts at the second.
    pub jumps: Vec<[f64; 2]>,
    /// Times within short pulses. The integrator ends a step at each of them.
    pub peaks: Vec<f64>,
}

/// A function of time and state gives the joint torques.
impl<F: Fn(f64, &State) -> Vec<f64>> TorqueLaw for F {
    fn torques(&self, t: f64, state: &State) -> Vec<f64> {
        self(t, state)
    }
}

/// The dynamics of n coordinates from a function, such as generated code, that computes q̈ from the state and τ.
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
