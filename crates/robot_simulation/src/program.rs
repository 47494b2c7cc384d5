//! The interpreted program of a robot as dynamics.

use robot_build::{FunctionKind, Pivot, Pivots, Programs};
use robot_codegen::Interpreter;
use robot_dynamics::model::{Friction, Robot};

use crate::dynamics::{Dynamics, State};
use crate::error::{Cause, Error};

/// Rounds of the search for accelerations that agree with friction by load; each gains a factor of
/// about the friction coefficient.
const MAX_ROUNDS: usize = 200;

/// The interpreted program of a robot, its parameters given: dynamics with or without friction, and
/// the energies.
///
/// It does the operations of the generated code, one by one.
#[derive(Clone, Debug)]
pub struct RobotProgram<'p> {
    robot: &'p Robot,
    interpreter: Interpreter<'p>,
    friction: bool,
    /// Whether friction depends on the accelerations.
    by_load: bool,
    /// What says why there are no accelerations.
    pivots: Option<Pivots>,
}

impl<'p> RobotProgram<'p> {
    /// The functions that a program for a simulation needs.
    #[must_use]
    pub fn functions(friction: bool) -> Vec<FunctionKind> {
        let mut kinds = vec![FunctionKind::ForwardDynamics, FunctionKind::Energies];
        if friction {
            kinds.extend([FunctionKind::InverseDynamics, FunctionKind::InverseDynamicsFriction]);
        }
        kinds
    }

    /// The program with the parameters that `given` names, the others at their nominal values.
    ///
    /// # Errors
    ///
    /// Parameters that there are not, or that have no value; functions that the programs lack.
    pub fn new(
        programs: &'p Programs,
        given: &[(&str, f64)],
        friction: bool,
    ) -> Result<RobotProgram<'p>, Error> {
        check_functions(programs, &RobotProgram::functions(friction))?;
        let none = Friction::none();
        let robot = &programs.robot;
        let by_load = robot.links.iter().any(|link| link.friction.coulomb != none.coulomb);
        let interpreter = Interpreter::new(&programs.module, given)?;
        Ok(RobotProgram { robot, interpreter, friction, by_load, pivots: None })
    }

    /// The same with the pivots of the robot's mass matrix, so that where there are no accelerations the
    /// error names the joint.
    #[must_use]
    pub fn with_pivots(self, pivots: Pivots) -> RobotProgram<'p> {
        RobotProgram { pivots: Some(pivots), ..self }
    }

    /// The robot.
    #[must_use]
    pub fn robot(&self) -> &'p Robot {
        self.robot
    }

    /// The kinetic and the potential energy, J.
    ///
    /// # Errors
    ///
    /// A state with another number of coordinates.
    pub fn energies(&self, state: &State) -> Result<[f64; 2], Error> {
        let inputs = [("q", state.q.as_slice()), ("qd", &state.qd)];
        let values = values(&self.interpreter, FunctionKind::Energies, &inputs)?;
        match values.as_slice() {
            &[kinetic, potential] => Ok([kinetic, potential]),
            _ => Err(Error::input("the program gives no energies")),
        }
    }

    /// The pivot for which a state has no accelerations.
    fn wrong_pivot(&self, state: &State) -> Option<Pivot> {
        let smallest = self.pivots.as_ref()?.smallest(&state.q);
        smallest.ok().flatten().filter(Pivot::is_wrong)
    }

    /// q̈ of M q̈ = τ − C q̇ − g, without friction.
    fn smooth(&self, state: &State, tau: &[f64]) -> Result<Vec<f64>, Error> {
        let inputs = [("q", state.q.as_slice()), ("qd", &state.qd), ("tau", tau)];
        values(&self.interpreter, FunctionKind::ForwardDynamics, &inputs)
    }

    /// Q_f at accelerations.
    fn friction(&self, state: &State, qdd: &[f64]) -> Result<Vec<f64>, Error> {
        let inputs = [("q", state.q.as_slice()), ("qd", &state.qd), ("qdd", qdd)];
        let with = values(&self.interpreter, FunctionKind::InverseDynamicsFriction, &inputs)?;
        let without = values(&self.interpreter, FunctionKind::InverseDynamics, &inputs)?;
        Ok(difference(&with, &without))
    }

    /// q̈ with friction. Dry friction by load, equation (5) of the paper, depends on q̈ itself: from
    /// the accelerations without it, each round takes the friction of the round before.
    fn rough(&self, state: &State, tau: &[f64]) -> Result<Vec<f64>, Error> {
        let still = vec![0.0; tau.len()];
        let mut qdd = match self.by_load {
            true => self.smooth(state, tau)?,
            false => still,
        };
        for _ in 0..MAX_ROUNDS {
            let driving = difference(tau, &self.friction(state, &qdd)?);
            let next = self.smooth(state, &driving)?;
            let size = next.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
            let change = difference(&next, &qdd);
            let settled = change.iter().all(|change| change.abs() <= 1e-12 * size);
            qdd = next;
            if settled || !self.by_load {
                return Ok(qdd);
            }
        }
        Err(Error::Stopped { t: 0.0, cause: Cause::Friction })
    }
}

impl Dynamics for RobotProgram<'_> {
    fn degrees_of_freedom(&self) -> usize {
        self.robot.degrees_of_freedom()
    }

    fn accelerations(&self, state: &State, tau: &[f64]) -> Result<Vec<f64>, Cause> {
        let found = match self.friction {
            true => self.rough(state, tau),
            false => self.smooth(state, tau),
        };
        let found = found.map_err(|error| match error {
            Error::Stopped { cause, .. } => cause,
            other => Cause::Other(other.to_string()),
        })?;
        if found.iter().all(|entry| entry.is_finite()) {
            return Ok(found);
        }
        match self.wrong_pivot(state) {
            Some(pivot) => Err(Cause::Other(format!("there are no accelerations: {pivot}"))),
            None => Ok(found),
        }
    }
}

/// Functions that are not among the programs.
pub(crate) fn check_functions(programs: &Programs, needed: &[FunctionKind]) -> Result<(), Error> {
    let missing = needed.iter().filter(|kind| !programs.functions.contains(kind));
    let messages = missing.map(|kind| format!("the program lacks the function {}", kind.name()));
    Error::check(messages.collect(), ())
}

/// All outputs of a function, one after the other.
pub(crate) fn values(
    interpreter: &Interpreter<'_>,
    kind: FunctionKind,
    inputs: &[(&str, &[f64])],
) -> Result<Vec<f64>, Error> {
    let outputs = interpreter.call(kind.name(), inputs)?;
    Ok(outputs.into_iter().flat_map(|output| output.values).collect())
}

/// a − b.
pub(crate) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
