//! The driving forces along a trajectory, split by cause.

use robot_build::{Effects, FunctionKind, Programs, Trigonometry, too_large_angle};
use robot_codegen::Interpreter;
use robot_model::diagnostic::number;
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;

use crate::error::Error;
use crate::program::{check_functions, difference, values};
use crate::table::Table;
use crate::trajectory::Trajectory;

/// The driving forces along a trajectory, N m or N, each with a sample of n entries for each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shares {
    /// t, s.
    pub t: Vec<f64>,
    /// The whole driving force τ: the sum of the shares.
    pub total: Vec<Vec<f64>>,
    /// That of the accelerations, M q̈.
    pub inertia: Vec<Vec<f64>>,
    /// That of the velocities, C q̇: Coriolis and centrifugal forces.
    pub coriolis: Vec<Vec<f64>>,
    /// That of the weight, g.
    pub gravity: Vec<Vec<f64>>,
    /// That of friction, Q_f, where it is asked for. It holds the dry friction that a wrench causes
    /// by its load.
    pub friction: Option<Vec<Vec<f64>>>,
    /// That of the tips' wrenches, where they are given.
    pub wrench: Option<Vec<Vec<f64>>>,
}

/// The samples of a share over time, a column for each coordinate.
type Series = Vec<Vec<f64>>;

impl Shares {
    /// The functions that the programs need.
    #[must_use]
    pub fn functions(friction: bool, wrench: bool) -> Vec<FunctionKind> {
        use FunctionKind as Kind;
        let mut kinds = vec![Kind::MassMatrix, Kind::Bias, Kind::Gravity];
        if friction || wrench {
            kinds.push(Kind::InverseDynamics(Effects::NONE));
        }
        if wrench {
            kinds.push(Kind::InverseDynamics(Effects::WRENCH));
        }
        if friction {
            kinds.push(Kind::InverseDynamics(Effects { friction, wrench }));
        }
        kinds
    }

    /// The shares that there are, by name, the total last.
    #[must_use]
    pub fn named(&self) -> Vec<(&'static str, &Series)> {
        let mut shares = vec![
            ("inertia", &self.inertia),
            ("coriolis", &self.coriolis),
            ("gravity", &self.gravity),
        ];
        shares.extend(self.friction.as_ref().map(|series| ("friction", series)));
        shares.extend(self.wrench.as_ref().map(|series| ("wrench", series)));
        shares.push(("total", &self.total));
        shares
    }

    /// The columns t, tau1 …, then each share's: inertia1 …, coriolis1 …, gravity1 …, friction1 …,
    /// wrench1 ….
    #[must_use]
    pub fn table(&self) -> Table {
        let mut table = Table::default();
        table.push("t", self.t.clone());
        table.push_numbered(JointVariable::Torque.name(), &self.total);
        for (name, series) in self.named().into_iter().filter(|(name, _)| *name != "total") {
            table.push_numbered(name, series);
        }
        table
    }
}

/// The driving forces along a trajectory of the robot, the inverse problem (6) of the paper, split by
/// cause; `given` are parameters that are not to have their nominal values. The programs have the
/// functions of [`Shares::functions`].
///
/// # Errors
///
/// Functions that the programs lack, parameters without values, samples of the wrong length.
pub fn shares(
    programs: &Programs,
    given: &[(&str, f64)],
    trajectory: &Trajectory,
    friction: bool,
) -> Result<Shares, Error> {
    let wrench = trajectory.wrenches.is_some();
    check_functions(programs, &Shares::functions(friction, wrench))?;
    let interpreter = Interpreter::new(&programs.module, given)?;
    let mut shares = Shares { t: trajectory.t.clone(), ..Shares::default() };
    shares.friction = friction.then(Vec::new);
    shares.wrench = wrench.then(Vec::new);
    let motion = trajectory.q.iter().zip(&trajectory.qd).zip(&trajectory.qdd);
    for (index, ((q, qd), qdd)) in motion.enumerate() {
        let sample = Sample { q, qd, qdd, wrenches: wrenches(&programs.robot, trajectory, index) };
        sample.add(&interpreter, &mut shares)?;
        if shares.total.last().is_some_and(|total| total.iter().any(|torque| !torque.is_finite())) {
            let t = number(trajectory.t.get(index).copied().unwrap_or_default());
            let angle = too_large_angle(&programs.robot, q, Trigonometry::default());
            let why = angle.unwrap_or_else(|| {
                "look at the size of the trajectory and of the parameters".to_owned()
            });
            let message = format!("at t = {t} s torques have no finite value; {why}");
            return Err(Error::input(message));
        }
    }
    Ok(shares)
}

/// The wrenches of a sample by the names of the functions' inputs.
fn wrenches<'t>(
    robot: &Robot,
    trajectory: &'t Trajectory,
    index: usize,
) -> Vec<(String, &'t [f64])> {
    let components = trajectory.wrenches.as_ref().and_then(|samples| samples.get(index));
    let chunks = components.map_or(&[][..], Vec::as_slice).chunks(6);
    let single = robot.tips().count() == 1;
    let name = |tip: &str| if single { "wrench".to_owned() } else { format!("wrench_{tip}") };
    robot.tips().zip(chunks).map(|((frame, _), chunk)| (name(&frame.name), chunk)).collect()
}

/// A moment of a trajectory.
struct Sample<'t> {
    q: &'t [f64],
    qd: &'t [f64],
    qdd: &'t [f64],
    wrenches: Vec<(String, &'t [f64])>,
}

impl Sample<'_> {
    /// Adds the shares of this moment.
    fn add(&self, interpreter: &Interpreter<'_>, shares: &mut Shares) -> Result<(), Error> {
        use FunctionKind as Kind;
        let call = |kind, inputs: &[(&str, &[f64])]| values(interpreter, kind, inputs);
        let (q, qd, qdd) = (("q", self.q), ("qd", self.qd), ("qdd", self.qdd));
        let matrix = call(Kind::MassMatrix, &[q])?;
        let rows = matrix.chunks(self.q.len().max(1));
        let product = |row: &[f64]| row.iter().zip(self.qdd).map(|(m, qdd)| m * qdd).sum();
        let inertia: Vec<f64> = rows.map(product).collect();
        let gravity = call(Kind::Gravity, &[q])?;
        let coriolis = difference(&call(Kind::Bias, &[q, qd])?, &gravity);
        let mut parts = vec![inertia.clone(), coriolis.clone(), gravity.clone()];
        let motion = [q, qd, qdd];
        let loads = self.wrenches.iter().map(|(name, wrench)| (name.as_str(), *wrench));
        let loaded: Vec<(&str, &[f64])> = motion.into_iter().chain(loads).collect();
        let wrench = shares.wrench.is_some();
        let of = |friction| Kind::InverseDynamics(Effects { friction, wrench });
        let (free, rubbing) = (of(false), of(true));
        if let Some(friction) = &mut shares.friction {
            let share = difference(&call(rubbing, &loaded)?, &call(free, &loaded)?);
            parts.push(share.clone());
            friction.push(share);
        }
        if let Some(wrench) = &mut shares.wrench {
            let share = difference(
                &call(free, &loaded)?,
                &call(Kind::InverseDynamics(Effects::NONE), &motion)?,
            );
            parts.push(share.clone());
            wrench.push(share);
        }
        let total = |entry: usize| parts.iter().filter_map(|part| part.get(entry)).sum();
        shares.total.push((0..self.q.len()).map(total).collect());
        shares.inertia.push(inertia);
        shares.coriolis.push(coriolis);
        shares.gravity.push(gravity);
        Ok(())
    }
}
