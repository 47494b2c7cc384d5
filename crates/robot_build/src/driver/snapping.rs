//! The effects of snapping angles close to multiples of π/2, and the operations that it saves.

use robot_dynamics::economical::Plan;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions, Snap};
use robot_model::functions::{Effects, FunctionKind, Functions};
use robot_model::robot::Robot;
use robot_symbolic::Graph;

use crate::driver::options::Options;
use crate::driver::programs::programs_of;
use crate::error::Errors;

/// The tolerances, in rad, that are tried in addition to the one in use.
const TRIED: [f64; 3] = [1e-6, 1e-4, 1e-3];

/// The effect of snapping on a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapping {
    /// The effect of the tolerance in use.
    pub taken: Tried,
    /// The effects of larger tolerances, each of which snaps more angles.
    pub larger: Vec<Tried>,
}

/// The effect of a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// The tolerance, in rad.
    pub tolerance: f64,
    /// The angles that are changed.
    pub snapped: Vec<Snap>,
    /// The multiplications, additions and divisions of inverse dynamics with this tolerance, without sines and cosines.
    pub operations: usize,
}

impl Tried {
    /// The largest change of an angle.
    #[must_use]
    pub fn largest(&self) -> Option<&Snap> {
        self.snapped.iter().max_by(|a, b| a.change.abs().total_cmp(&b.change.abs()))
    }
}

/// Computes the effect of snapping on a robot with the given tolerance, or else that of the file, and with larger ones.
/// All use the same plan, or the default plan if none is given.
///
/// # Errors
///
/// The tolerance is not an angle, or the plan does not match the robot.
pub fn snapping(robot: &Robot, snap: Option<f64>, plan: Option<&Plan>) -> Result<Snapping, Errors> {
    let tolerance = MechanismOptions::ROUNDED.with_snap(snap, robot).snap;
    let taken = tried(robot, tolerance, plan)?;
    let mut larger: Vec<Tried> = vec![];
    for tolerance in TRIED.into_iter().filter(|tried| *tried > tolerance) {
        let options = MechanismOptions { snap: tolerance, ..MechanismOptions::ROUNDED };
        let count = Mechanism::new(robot, &Graph::new(), &options).snapped.len();
        if count > larger.last().unwrap_or(&taken).snapped.len() {
            larger.push(tried(robot, tolerance, plan)?);
        }
    }
    Ok(Snapping { taken, larger })
}

fn tried(robot: &Robot, tolerance: f64, plan: Option<&Plan>) -> Result<Tried, Errors> {
    let options = Options {
        functions: Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]),
        snap: Some(tolerance),
        plan: plan.cloned(),
        ..Options::default()
    };
    let programs = programs_of(robot.clone(), &robot.name, &options)?;
    let functions = programs.module.functions.iter();
    let operations =
        functions.map(|function| programs.module.counts(function).call.operations()).sum();
    Ok(Tried { tolerance, snapped: programs.snapped, operations })
}
