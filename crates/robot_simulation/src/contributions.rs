//! Joint torques along a trajectory, divided into their contributions.

use robot_build::{Effects, FunctionKind, Programs, Trigonometry, too_large_angle};
use robot_jit::Executable;
use robot_model::diagnostic::number;
use robot_model::robot::Robot;
use robot_model::variable::JointVariable::{Acceleration, Position, Torque, Velocity};
use robot_model::variable::WRENCH;

use crate::error::Error;
use crate::program::{check_functions, difference};
use crate::table::Table;
use crate::trajectory::Trajectory;

/// The joint torques along a trajectory in N m or N, with n values for each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TorqueContributions {
    /// The times t, in s.
    pub t: Vec<f64>,
    /// The total joint torques τ: the sum of the contributions.
    pub total: Vec<Vec<f64>>,
    /// The inertia terms M q̈.
    pub inertia: Vec<Vec<f64>>,
    /// The Coriolis and centrifugal terms C q̇.
    pub coriolis: Vec<Vec<f64>>,
    /// The gravity terms g.
    pub gravity: Vec<Vec<f64>>,
    /// The contribution Q_f of friction, if it is requested. It includes the load-dependent dry friction that wrenches
    /// cause.
    pub friction: Option<Vec<Vec<f64>>>,
    /// The contribution of the tips' wrenches, if there are any.
    pub wrench: Option<Vec<Vec<f64>>>,
}

/// The values of a contribution over time, each with one entry per coordinate.
type Series = Vec<Vec<f64>>;

/// The names of the contributions in tables and plots.
const NAMES: [&str; 5] = ["inertia", "coriolis", "gravity", "friction", "wrench"];

impl TorqueContributions {
    /// The functions that the programs must contain.
    #[must_use]
    pub fn functions(friction: bool, wrench: bool) -> Vec<FunctionKind> {
        use FunctionKind as Kind;
        let mut kinds = vec![Kind::MassMatrix, Kind::Bias];
        if friction || wrench {
            kinds.push(Kind::InverseDynamics(Effects { friction: false, wrench }));
        }
        if friction {
            kinds.push(Kind::InverseDynamics(Effects { friction, wrench }));
        }
        kinds
    }

    /// Whether a column of a table contains a contribution to the torque of a coordinate, such as `gravity2`.
    pub(crate) fn is_column(name: &str) -> bool {
        let contribution = name.trim_end_matches(|last: char| last.is_ascii_digit());
        contribution.len() < name.len() && NAMES.contains(&contribution)
    }

    /// The contributions by their names, with the total last.
    #[must_use]
    pub fn named(&self) -> Vec<(&'static str, &Series)> {
        let [inertia, coriolis, gravity, friction, wrench] = NAMES;
        let mut contributions =
            vec![(inertia, &self.inertia), (coriolis, &self.coriolis), (gravity, &self.gravity)];
        contributions.extend(self.friction.as_ref().map(|series| (friction, series)));
        contributions.extend(self.wrench.as_ref().map(|series| (wrench, series)));
        contributions.push(("total", &self.total));
        contributions
    }

    /// The contributions by their names in tables and plots.
    #[must_use]
    pub fn titled(&self) -> Vec<(&'static str, &Series)> {
        let title = |name| if name == "coriolis" { "Coriolis" } else { name };
        self.named().into_iter().map(|(name, series)| (title(name), series)).collect()
    }

    /// Appends the contributions at later times.
    pub fn append(&mut self, next: TorqueContributions) {
        let TorqueContributions { t, total, inertia, coriolis, gravity, friction, wrench } = next;
        self.t.extend(t);
        self.total.extend(total);
        self.inertia.extend(inertia);
        self.coriolis.extend(coriolis);
        self.gravity.extend(gravity);
        for (series, next) in [(&mut self.friction, friction), (&mut self.wrench, wrench)] {
            if let Some(next) = next {
                series.get_or_insert_default().extend(next);
            }
        }
    }

    /// The table with the columns t, tau1 …, and then those of each contribution: inertia1 …, coriolis1 …, gravity1 …,
    /// friction1 …, wrench1 ….
    #[must_use]
    pub fn table(&self) -> Table {
        let mut table = Table::default();
        table.push("t", self.t.clone());
        table.push_numbered(Torque.name(), &self.total);
        for (name, series) in self.named().into_iter().filter(|(name, _)| *name != "total") {
            table.push_numbered(name, series);
        }
        table
    }
}

/// Computes the joint torques along a trajectory of the robot, the inverse dynamics (6) of the paper, divided into
/// their contributions. `given` are the parameters with other than their nominal values. The programs must contain the
/// functions of [`TorqueContributions::functions`].
///
/// # Errors
///
/// If the programs lack functions, parameters have no values, samples have the wrong length, or torques are not finite.
pub fn torque_contributions(
    programs: &Programs,
    given: &[(&str, f64)],
    trajectory: &Trajectory,
    friction: bool,
) -> Result<TorqueContributions, Error> {
    let wrench = trajectory.wrenches.is_some();
    check_functions(programs, &TorqueContributions::functions(friction, wrench))?;
    let executable = Executable::new(&programs.module, given, Trigonometry::default())?;
    let loads = wrenches(&programs.robot, trajectory);
    let motion = Motion { executable: &executable, trajectory, loads: &loads };
    let contributions = motion.contributions(friction)?;
    for ((total, t), q) in contributions.total.iter().zip(&contributions.t).zip(&trajectory.q) {
        if total.iter().all(|torque| torque.is_finite()) {
            continue;
        }
        let angle = too_large_angle(&programs.robot, q, Trigonometry::default());
        let why = angle.unwrap_or_else(|| {
            "check the magnitudes of the trajectory and of the parameters".to_owned()
        });
        let message = format!("at t = {} s torques do not have finite values; {why}", number(*t));
        return Err(Error::input(message));
    }
    Ok(contributions)
}

/// The wrench of each tip along a trajectory, by the names of the inputs of functions.
fn wrenches(robot: &Robot, trajectory: &Trajectory) -> Vec<(String, Series)> {
    let Some(samples) = &trajectory.wrenches else { return vec![] };
    let name = |tip| format!("{WRENCH}{}", robot.wrench_suffix(tip));
    let of_tip = |tip: usize| {
        let chunk = |sample: &Vec<f64>| sample.chunks(6).nth(tip).unwrap_or_default().to_vec();
        samples.iter().map(chunk).collect()
    };
    let tips = robot.tips().enumerate();
    tips.map(|(tip, (frame, _))| (name(frame), of_tip(tip))).collect()
}

/// A trajectory with the program that computes its joint torques.
struct Motion<'t> {
    executable: &'t Executable<'t>,
    trajectory: &'t Trajectory,
    loads: &'t [(String, Series)],
}

impl Motion<'_> {
    /// The outputs of a function at all times.
    fn series(&self, kind: FunctionKind, inputs: &[(&str, &[Vec<f64>])]) -> Result<Series, Error> {
        let handle = self.executable.function(kind.name())?;
        Ok(handle.states(self.trajectory.t.len(), inputs)?)
    }

    /// The contributions at all times. Each difference is one of the same function, at rest or without a wrench, so
    /// that it is exactly 0 where nothing acts; only that of friction is one of two functions.
    fn contributions(&self, friction: bool) -> Result<TorqueContributions, Error> {
        use FunctionKind as Kind;
        let Trajectory { t, q, qd, qdd, wrenches } = self.trajectory;
        let motion = [(Position, q), (Velocity, qd), (Acceleration, qdd)]
            .map(|(variable, samples)| (variable.name(), samples.as_slice()));
        let loads = self.loads.iter().map(|(name, wrench)| (name.as_str(), wrench.as_slice()));
        let loaded: Vec<(&str, &[Vec<f64>])> = motion.into_iter().chain(loads).collect();
        let matrices = self.series(Kind::MassMatrix, &motion[..1])?;
        let inertia: Series =
            matrices.iter().zip(qdd).map(|(matrix, qdd)| product(matrix, qdd)).collect();
        let at_rest = zeros(qd);
        let gravity = self.series(Kind::Bias, &[motion[0], (Velocity.name(), &at_rest)])?;
        let coriolis = differences(&self.series(Kind::Bias, &motion[..2])?, &gravity);
        let wrench = wrenches.is_some();
        let of = |friction| Kind::InverseDynamics(Effects { friction, wrench });
        let without = match friction || wrench {
            true => self.series(of(false), &loaded)?,
            false => vec![],
        };
        let friction = friction.then(|| self.series(of(true), &loaded)).transpose()?;
        let friction = friction.map(|with| differences(&with, &without));
        let zero_loads: Vec<Series> = self.loads.iter().map(|(_, wrench)| zeros(wrench)).collect();
        let zero_loads = self.loads.iter().zip(&zero_loads);
        let zero_loads = zero_loads.map(|((name, _), wrench)| (name.as_str(), wrench.as_slice()));
        let unloaded: Vec<(&str, &[Vec<f64>])> = motion.into_iter().chain(zero_loads).collect();
        let unloaded = wrench.then(|| self.series(of(false), &unloaded)).transpose()?;
        let wrench = unloaded.map(|unloaded| differences(&without, &unloaded));
        let mut contributions = TorqueContributions {
            t: t.clone(),
            total: vec![],
            inertia,
            coriolis,
            gravity,
            friction,
            wrench,
        };
        let parts = contributions.named();
        let parts = parts.into_iter().filter(|(name, _)| *name != "total");
        let parts: Vec<&Series> = parts.map(|(_, series)| series).collect();
        contributions.total = (0..t.len()).map(|time| sum(&parts, time)).collect();
        Ok(contributions)
    }
}

/// The product M q̈ with a mass matrix that is given row by row.
fn product(matrix: &[f64], qdd: &[f64]) -> Vec<f64> {
    let rows = matrix.chunks(qdd.len().max(1));
    rows.map(|row| row.iter().zip(qdd).map(|(m, qdd)| m * qdd).sum()).collect()
}

/// Samples of the same lengths, all 0.
fn zeros(samples: &[Vec<f64>]) -> Series {
    samples.iter().map(|sample| vec![0.0; sample.len()]).collect()
}

/// The differences a − b at all times.
fn differences(a: &[Vec<f64>], b: &[Vec<f64>]) -> Series {
    a.iter().zip(b).map(|(a, b)| difference(a, b)).collect()
}

/// The sum of the contributions at a time.
fn sum(parts: &[&Series], time: usize) -> Vec<f64> {
    let samples = || parts.iter().filter_map(|part| part.get(time));
    let entries = samples().map(Vec::len).max().unwrap_or_default();
    (0..entries).map(|entry| samples().filter_map(|sample| sample.get(entry)).sum()).collect()
}
