//! The program of a robot as forward dynamics.

use robot_build::{Effects, FunctionKind, Pivot, Pivots, Programs, Trigonometry, too_large_angle};
use robot_jit::Executable;
use robot_model::robot::{Friction, JointKind, Robot};
use robot_model::variable::JointVariable::{Acceleration, Position, Torque, Velocity};
use robot_symbolic::Formula;

use crate::dynamics::{DryFriction, Dynamics, State};
use crate::error::{Cause, Error};
use crate::expressions::parameters;
use crate::friction::{Mode, balance};

/// The program of a robot with given parameters, as machine code or interpreted: its dynamics with or without friction,
/// and its energies.
///
/// It carries out the same operations as the generated code.
#[derive(Debug)]
pub struct RobotProgram<'p> {
    robot: &'p Robot,
    executable: Executable<'p>,
    friction: Option<RobotFriction>,
    /// The pivots of the mass matrix: if a state has no accelerations, they show which joint is the cause.
    pivots: Option<Pivots>,
}

/// The properties of the friction of a robot.
#[derive(Clone, Debug)]
struct RobotFriction {
    /// Whether friction depends on the accelerations.
    by_load: bool,
    /// For each coordinate, whether dry friction without smoothing acts on it.
    can_stick: Vec<bool>,
}

impl<'p> RobotProgram<'p> {
    /// The functions that the programs must contain for a simulation.
    #[must_use]
    pub fn functions(friction: bool) -> Vec<FunctionKind> {
        let mut kinds = vec![FunctionKind::ForwardDynamics(Effects::NONE), FunctionKind::Energies];
        if friction {
            kinds.extend([
                FunctionKind::MassMatrix,
                FunctionKind::InverseDynamics(Effects::NONE),
                FunctionKind::InverseDynamics(Effects::FRICTION),
            ]);
        }
        kinds
    }

    /// The program with the parameter values in `given`, and nominal values for the others.
    ///
    /// # Errors
    ///
    /// If a parameter does not exist or has no value, or if the programs lack functions.
    pub fn new(
        programs: &'p Programs,
        given: &[(&str, f64)],
        friction: bool,
    ) -> Result<RobotProgram<'p>, Error> {
        check_functions(programs, &RobotProgram::functions(friction))?;
        let robot = &programs.robot;
        let executable = Executable::new(&programs.module, given, Trigonometry::default())?;
        let friction = friction.then(|| robot_friction(robot, given)).transpose()?;
        Ok(RobotProgram { robot, executable, friction, pivots: None })
    }

    /// Adds the pivots of the robot's mass matrix, so that the error names the joint if there are no accelerations.
    #[must_use]
    pub fn with_pivots(self, pivots: Pivots) -> RobotProgram<'p> {
        RobotProgram { pivots: Some(pivots), ..self }
    }

    /// The robot.
    #[must_use]
    pub fn robot(&self) -> &'p Robot {
        self.robot
    }

    /// The kinetic and the potential energy, in J.
    ///
    /// # Errors
    ///
    /// If the state has another number of coordinates.
    pub fn energies(&self, state: &State) -> Result<[f64; 2], Error> {
        let inputs = [(Position.name(), state.q.as_slice()), (Velocity.name(), &state.qd)];
        let values = values(&self.executable, FunctionKind::Energies, &inputs)?;
        match values.as_slice() {
            &[kinetic, potential] => Ok([kinetic, potential]),
            _ => Err(Error::input("the program does not compute energies")),
        }
    }

    /// All outputs of a function; an error becomes a cause.
    fn values(&self, kind: FunctionKind, inputs: &[(&str, &[f64])]) -> Result<Vec<f64>, Cause> {
        values(&self.executable, kind, inputs).map_err(|error| Cause::Other(error.to_string()))
    }

    /// The pivot because of which a state has no accelerations; `None` if there is none.
    fn wrong_pivot(&self, state: &State) -> Option<Pivot> {
        let smallest = self.pivots.as_ref()?.smallest(&state.q);
        smallest.ok().flatten().filter(Pivot::is_wrong)
    }
}

impl Dynamics for RobotProgram<'_> {
    fn degrees_of_freedom(&self) -> usize {
        self.robot.degrees_of_freedom()
    }

    /// Includes friction if the program has it, but no dry friction of coordinates with the velocity 0.
    fn accelerations(&self, state: &State, tau: &[f64]) -> Result<Vec<f64>, Cause> {
        let found = match self.friction {
            Some(_) => balance(self, state, tau, &vec![Mode::Free; tau.len()])?.qdd,
            None => {
                let inputs = [
                    (Position.name(), state.q.as_slice()),
                    (Velocity.name(), &state.qd),
                    (Torque.name(), tau),
                ];
                self.values(FunctionKind::ForwardDynamics(Effects::NONE), &inputs)?
            }
        };
        if found.iter().all(|entry| entry.is_finite()) {
            return Ok(found);
        }
        if !state.q.iter().chain(&state.qd).chain(tau).all(|entry| entry.is_finite()) {
            let why = "positions, velocities or torques become larger than any number; check the \
                       magnitudes of the torques and of the initial velocities";
            return Err(Cause::Other(why.to_owned()));
        }
        if let Some(angle) = too_large_angle(self.robot, &state.q, Trigonometry::default()) {
            return Err(Cause::Other(angle));
        }
        match self.wrong_pivot(state) {
            Some(pivot) => Err(Cause::Other(format!("forward dynamics has no solution: {pivot}"))),
            None => Ok(found),
        }
    }

    /// Joints that dry friction can hold need no inertia, so nothing is checked if there are any.
    fn check(&self, state: &State) -> Result<(), Cause> {
        match self.wrong_pivot(state) {
            Some(pivot) if pivot.digits == 0 && self.dry_friction().is_none() => {
                Err(Cause::Other(format!("forward dynamics has no solution: {pivot}")))
            }
            _ => Ok(()),
        }
    }

    fn dry_friction(&self) -> Option<&dyn DryFriction> {
        let friction = self.friction.as_ref()?;
        friction.can_stick.contains(&true).then_some(self)
    }
}

impl DryFriction for RobotProgram<'_> {
    fn can_stick(&self) -> &[bool] {
        self.friction.as_ref().map_or(&[], |friction| &friction.can_stick)
    }

    fn is_by_load(&self) -> bool {
        self.friction.as_ref().is_some_and(|friction| friction.by_load)
    }

    fn mass_matrix(&self, q: &[f64]) -> Result<Vec<f64>, Cause> {
        self.values(FunctionKind::MassMatrix, &[(Position.name(), q)])
    }

    fn joint_torques(&self, state: &State, qdd: &[f64], friction: bool) -> Result<Vec<f64>, Cause> {
        let inputs = [
            (Position.name(), state.q.as_slice()),
            (Velocity.name(), &state.qd),
            (Acceleration.name(), qdd),
        ];
        let kind = match friction {
            true => FunctionKind::InverseDynamics(Effects::FRICTION),
            false => FunctionKind::InverseDynamics(Effects::NONE),
        };
        self.values(kind, &inputs)
    }
}

/// The properties of a robot's friction with the given parameters.
fn robot_friction(robot: &Robot, given: &[(&str, f64)]) -> Result<RobotFriction, Error> {
    let parameters = parameters(robot, given);
    let mut friction =
        RobotFriction { by_load: false, can_stick: vec![false; robot.degrees_of_freedom()] };
    let mut wrong = vec![];
    for link in &robot.links {
        let value = |formula: &Formula| {
            formula.evaluate(|name| parameters.get(name).copied().unwrap_or(f64::NAN))
        };
        let Friction { coulomb, spindle_diameter, coulomb_positive, coulomb_negative, .. } =
            &link.friction;
        let diameter = match link.joint.kind {
            JointKind::Revolute => value(spindle_diameter),
            JointKind::Prismatic => 1.0,
        };
        let by_load = value(coulomb) * diameter;
        let dry = [by_load, value(coulomb_positive), value(coulomb_negative)];
        if dry.iter().any(|value| *value < 0.0) {
            let joint = &link.joint.name;
            wrong.push(format!(
                "the Coulomb friction of joint `{joint}` is negative, which would drive the joint"
            ));
        }
        // A value that is NaN must count, so that it appears in the accelerations.
        let is_dry = dry.iter().any(|value| *value != 0.0);
        friction.by_load |= by_load != 0.0;
        if is_dry && link.friction.smoothing.is_none() {
            friction.can_stick[link.joint.coordinate] = true;
        }
    }
    Error::check(wrong, friction)
}

/// Returns an error if the programs lack some of the needed functions.
pub(crate) fn check_functions(programs: &Programs, needed: &[FunctionKind]) -> Result<(), Error> {
    let missing = needed.iter().filter(|kind| !programs.functions.contains(kind));
    let messages = missing.map(|kind| format!("the program lacks the function {}", kind.name()));
    Error::check(messages.collect(), ())
}

/// All outputs of a function, one after the other.
fn values(
    executable: &Executable<'_>,
    kind: FunctionKind,
    inputs: &[(&str, &[f64])],
) -> Result<Vec<f64>, Error> {
    Ok(executable.function(kind.name())?.call(inputs)?)
}

/// The difference a − b.
pub(crate) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
