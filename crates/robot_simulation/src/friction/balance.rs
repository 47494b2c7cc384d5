//! Accelerations for given modes.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::Mode;
use crate::dynamics::{DryFriction, State};
use crate::error::Cause;

/// The largest number of iterations to find accelerations that are consistent with the load-dependent friction they
/// cause.
const MAX_ROUNDS: usize = 60;
/// A velocity that only gives friction its direction: its square is 0.
const TINY: f64 = 1e-200;
/// The change of the accelerations at which the iteration has converged, relative to 1 + the largest one (rad/s² or
/// m/s²), as in the definition of tolerances.
const SETTLED: f64 = 1e-12;
/// The rounding error of a force, relative to its terms.
const ROUNDING_OF_FORCES: f64 = 1e-14;
/// The accepted excess over the limit of friction, relative to the forces.
const SLACK: f64 = 1e-11;

/// The accelerations, and the friction that holds coordinates at rest.
#[derive(Clone, Debug)]
pub(crate) struct Balance {
    /// The accelerations q̈ in rad/s² or m/s²; exactly 0 for a coordinate that is held.
    pub(crate) qdd: Vec<f64>,
    /// The friction of each coordinate that is held; `None` for the others.
    pub(crate) holding: Vec<Option<Holding>>,
}

/// The friction of a coordinate at rest, in N m or N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Holding {
    /// The force that is required of the friction.
    pub(crate) force: f64,
    /// The smallest and the largest force that the friction can supply.
    pub(crate) range: [f64; 2],
    /// The rounding error of these forces.
    pub(crate) slack: f64,
    /// The inertia of the coordinate, in kg m² or kg.
    pub(crate) inertia: f64,
}

impl Holding {
    /// The amount by which the required force is outside the range of the friction, minus the slack; not positive if
    /// the coordinate is held.
    pub(crate) fn excess(&self) -> f64 {
        let [least, most] = self.range;
        (self.force - most).max(least - self.force) - self.slack
    }

    /// The direction in which the coordinate would break away.
    pub(crate) fn direction(&self) -> f64 {
        let [least, most] = self.range;
        if self.force - most >= least - self.force { 1.0 } else { -1.0 }
    }
}

/// Computes q̈ from M q̈ + C q̇ + g + Q_f = τ for the coordinates that move; it is 0 for those that are held.
///
/// # Errors
///
/// [`Cause::Accelerations`] if the mass matrix of the moving coordinates is not positive definite, and
/// [`Cause::Friction`] if no accelerations are consistent with the load-dependent friction that they cause.
pub(crate) fn balance(
    friction: &dyn DryFriction,
    state: &State,
    tau: &[f64],
    modes: &[Mode],
) -> Result<Balance, Cause> {
    let matrix = friction.mass_matrix(&state.q)?;
    let matrix = DMatrix::from_row_slice(modes.len(), modes.len(), &matrix);
    let forward = State { q: state.q.clone(), qd: directed(&state.qd, modes, 1.0) };
    let qdd = accelerations(friction, &forward, tau, modes, &matrix)?;
    let mut holding = vec![None; modes.len()];
    if modes.contains(&Mode::Held) {
        let backward = State { q: state.q.clone(), qd: directed(&state.qd, modes, -1.0) };
        let without = friction.joint_torques(&forward, &qdd, false)?;
        let most = friction.joint_torques(&forward, &qdd, true)?;
        let least = friction.joint_torques(&backward, &qdd, true)?;
        let size = |index: usize| {
            let range =
                (most[index] - without[index]).abs() + (least[index] - without[index]).abs();
            tau[index].abs() + without[index].abs() + range
        };
        let largest = (0..modes.len()).map(size).fold(0.0, f64::max);
        for (index, place) in holding.iter_mut().enumerate() {
            if modes[index] == Mode::Held {
                *place = Some(Holding {
                    force: tau[index] - without[index],
                    range: [least[index] - without[index], most[index] - without[index]],
                    slack: SLACK * (size(index) + 0.01 * largest),
                    inertia: matrix[(index, index)],
                });
            }
        }
    }
    Ok(Balance { qdd, holding })
}

/// The velocities with the directions of the modes; `held` is the direction for coordinates at rest. Within a step a
/// velocity can pass 0, but its friction keeps its direction until the event is found.
fn directed(qd: &[f64], modes: &[Mode], held: f64) -> Vec<f64> {
    let directed = |(qd, mode): (&f64, &Mode)| match mode {
        Mode::Free => *qd,
        Mode::Sliding(direction) => direction * (direction * qd).max(TINY),
        Mode::Held => held * TINY,
    };
    qd.iter().zip(modes).map(directed).collect()
}

/// The accelerations q̈ of the moving coordinates. Without load-dependent friction, the equations are linear in q̈.
/// Otherwise they are M q̈ + Q_f(q̈) = … and are solved by Broyden's method, starting from the matrix M (Nocedal and
/// Wright, Numerical Optimization, 2nd ed., 11.1), because Q_f is small compared to the joint torques.
fn accelerations(
    friction: &dyn DryFriction,
    state: &State,
    tau: &[f64],
    modes: &[Mode],
    matrix: &DMatrix<f64>,
) -> Result<Vec<f64>, Cause> {
    let moving: Vec<usize> = (0..modes.len()).filter(|index| modes[*index] != Mode::Held).collect();
    let mut qdd = vec![0.0; modes.len()];
    if moving.is_empty() {
        return Ok(qdd);
    }
    let lacking = |qdd: &[f64]| -> Result<DVector<f64>, Cause> {
        let forces = friction.joint_torques(state, qdd, true)?;
        let lacking = moving.iter().map(|index| tau[*index] - forces[*index]);
        let lacking = DVector::from_iterator(moving.len(), lacking);
        let finite = lacking.iter().all(|force| force.is_finite());
        if finite { Ok(lacking) } else { Err(Cause::Accelerations) }
    };
    let block = matrix.select_rows(&moving).select_columns(&moving);
    let decomposed = Cholesky::new(block).ok_or(Cause::Accelerations)?;
    let mut rest = lacking(&qdd)?;
    let sizes = moving.iter().zip(rest.iter()).map(|(index, rest)| tau[*index].abs() + rest.abs());
    let sizes = DVector::from_iterator(moving.len(), sizes);
    let rounding = sizes.add_scalar(0.01 * sizes.amax()) * ROUNDING_OF_FORCES;
    let mut step = decomposed.solve(&rest);
    add(&mut qdd, &moving, &step);
    if !friction.is_by_load() {
        return Ok(qdd);
    }
    let mut inverse = decomposed.inverse();
    for _ in 0..MAX_ROUNDS {
        let next = lacking(&qdd)?;
        let gained = &rest - &next;
        let row = inverse.tr_mul(&step);
        let along = row.dot(&gained);
        if along != 0.0 {
            let correction = (&step - &inverse * &gained) / along;
            inverse += correction * row.transpose();
        }
        step = &inverse * &next;
        rest = next;
        add(&mut qdd, &moving, &step);
        let size = qdd.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
        // Even if the forces balance, the accelerations do not converge beyond their rounding errors.
        if step.amax() <= SETTLED * (1.0 + size) + (inverse.abs() * &rounding).amax() {
            return Ok(qdd);
        }
    }
    Err(Cause::Friction)
}

fn add(qdd: &mut [f64], moving: &[usize], step: &DVector<f64>) {
    for (index, step) in moving.iter().zip(step.iter()) {
        qdd[*index] += step;
    }
}
