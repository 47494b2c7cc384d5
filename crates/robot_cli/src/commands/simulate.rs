//! `simulate`: the motion of a robot.

use std::path::{Path, PathBuf};

use clap::Args;
use robot_build::{Pivots, Programs, is_stream};
use robot_model::diagnostic::number;
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_simulation::plot::motion_figure;
use robot_simulation::{
    Energies, Motion, RobotProgram, SimulationOptions, State, Table, Torques, simulate,
};

use crate::Terminal;
use crate::delivery::{ForceArgument, file_of};
use crate::failure::Failure;
use crate::files;
use crate::friction::FrictionArguments;
use crate::limits;
use crate::motion;
use crate::progress::Progress;
use crate::recording::{Recording, plot_path};
use crate::robot::RobotArgument;
use crate::settings::Settings;
use crate::values::{self, miscounted, of_joints, seconds, whole};

/// The number of lines of the output that are in memory as text.
const PART: usize = 1024;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic simulate robots/planar_2r.toml --time 10 --q0 1.5,0.5 -o motion.csv --plot motion.svg
  robot-symbolic simulate robots/puma560.toml --torque \"2 = -40*(q2 - 0.5) - 8*qd2\" --time 3
  robot-symbolic simulate robots/planar_2r.toml --torques motion.csv --time 10

The output is CSV: t, q, qd, qdd, tau and the energies, in s, rad or m, N m or N, and J; numbers round-trip
exactly. Expressions may use t, q1 …, qd1 … and the robot's parameters. A file of torques has the columns t and
tau1 …, one for each joint; torques are interpolated linearly in t. With --friction, Coulomb friction can hold
joints at rest (stiction) unless it has a smoothing. docs/simulation.md describes the method and the tolerance.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Duration of the simulation, s
    #[arg(long, value_name = "S", value_parser = seconds, default_value_t = 10.0, allow_hyphen_values = true)]
    time: f64,
    /// Time between lines of the output, s
    #[arg(long, value_name = "S", value_parser = seconds, default_value_t = 0.01, allow_hyphen_values = true)]
    step: f64,
    /// Error tolerance of a step in a component y of q and qd: TOLERANCE (1 + |y|)
    #[arg(long, default_value = "1e-9", value_parser = values::number, allow_hyphen_values = true)]
    tolerance: f64,
    /// Maximum number of integrator steps [default: 1000000, or ten per line of output if that is more]
    #[arg(long, value_name = "STEPS", value_parser = whole(1_usize..), allow_hyphen_values = true)]
    max_steps: Option<usize>,
    /// Initial joint positions, separated by commas; in rad or m, such as 0.5, pi/2 or 90deg [default: 0]
    #[arg(long, value_name = "Q1,Q2,…", allow_hyphen_values = true)]
    q0: Option<String>,
    /// Initial joint velocities; rad/s or m/s [default: 0]
    #[arg(long, value_name = "QD1,QD2,…", allow_hyphen_values = true)]
    qd0: Option<String>,
    /// Torque or force of a joint, by number or name; the other joints are not driven
    #[arg(long = "torque", value_name = "JOINT=EXPRESSION")]
    torque: Vec<String>,
    /// A CSV file of torques; `-` for standard input
    #[arg(long, value_name = "FILE", conflicts_with = "torque")]
    torques: Option<PathBuf>,
    #[command(flatten)]
    friction: FrictionArguments,
    #[command(flatten)]
    settings: Settings,
    /// The CSV file to write; `-` is standard output [default: -]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// A plot to write, .svg or .png: q, qd, torques and energies over time
    #[arg(long, value_name = "FILE", value_parser = plot_path)]
    plot: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgument,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let inputs = self.robot.inputs().into_iter().chain(self.torques.clone());
        let writes = file_of(self.output.as_deref()).is_some() || self.plot.is_some();
        let writer = self.force.writer(inputs, writes)?;
        let recording = Recording::open(self.output.as_deref(), self.plot.as_deref(), writer)?;
        let file = self.robot.open()?;
        let robot = motion::robot(&file, &self.settings, &self.friction, terminal)?;
        let start = self.start(&robot)?;
        if let Some(text) = &self.q0 {
            limits::note(("--q0", text), &start.q, &robot, terminal)?;
        }
        let friction = self.friction.is_wanted();
        let functions = RobotProgram::functions(friction);
        let options = file.options(terminal)?;
        let programs = motion::programs(&file, robot, functions, options.clone())?;
        let pivots = Pivots::new(&programs.robot, &options, &self.settings.pairs())?;
        let program = RobotProgram::new(&programs, &self.settings.pairs(), friction)?
            .with_pivots(pivots.clone());
        let motion = self.motion(&programs, &program, &start, terminal)?;
        warn(&motion, &pivots, terminal)?;
        let energies = motion.energies(&program)?;
        let figure = || {
            let conserved = !friction && motion.tau.iter().flatten().all(|tau| *tau == 0.0);
            motion_figure(&programs.robot, &motion, &energies, conserved)
        };
        let mut table = recording.begin(terminal.output, terminal.errors)?;
        for start in (0..motion.t.len()).step_by(PART) {
            let part = motion.table_of(&energies, start..start + PART);
            table.push_table(&part, start == 0)?;
        }
        recording.end(table, figure)?;
        // A summary must not follow the table into a pipe, a device or a redirected stream.
        let is_file = |path: &Path| path.is_file() && !is_stream(path);
        if file_of(self.output.as_deref()).is_some_and(is_file) {
            writeln!(terminal.output, "{}", summary(&motion, &energies))?;
        }
        Ok(())
    }

    fn motion(
        &self,
        programs: &Programs,
        program: &RobotProgram<'_>,
        start: &State,
        terminal: &mut Terminal<'_>,
    ) -> Result<Motion, Failure> {
        let torques = self.torques(&programs.robot, terminal)?;
        let &Arguments { time: duration, step, tolerance, .. } = self;
        // The simulation reports invalid times.
        let usual = SimulationOptions::default().max_steps.max((10.0 * duration / step) as usize);
        let max_steps = self.max_steps.unwrap_or(usual);
        let options = SimulationOptions { duration, step, tolerance, max_steps };
        let mut progress = Progress::new(terminal);
        let mut heard = |t: f64| progress.show(|| format!("{t:.3} s of {} s", number(duration)));
        Ok(simulate(program, &torques, start, &options, &mut heard)?)
    }

    fn start(&self, robot: &Robot) -> Result<State, Failure> {
        let mut wrong = vec![];
        let given = [
            ("--q0", &self.q0, JointVariable::Position),
            ("--qd0", &self.qd0, JointVariable::Velocity),
        ];
        let [q, qd] = given.map(|(option, text, variable)| match text {
            None => vec![0.0; robot.degrees_of_freedom()],
            Some(text) => match of_joints(option, text, variable, robot) {
                Ok(values) => {
                    wrong.extend(miscounted(option, &values, &robot.symbols(variable)));
                    values
                }
                Err(found) => {
                    wrong.extend(found);
                    vec![]
                }
            },
        });
        if wrong.is_empty() { Ok(State { q, qd }) } else { Err(Failure::Usage(wrong)) }
    }

    fn torques(&self, robot: &Robot, terminal: &mut Terminal<'_>) -> Result<Torques, Failure> {
        let Some(path) = &self.torques else {
            return Ok(Torques::from_expressions(robot, &self.settings.pairs(), &self.torque)?);
        };
        let (name, text) = files::read(path, terminal)?;
        let table = Table::read(&name, &text)?;
        Ok(Torques::from_table(robot, &name, &table, self.time)?)
    }
}

/// Warns once, at the first state at which accelerations have few correct digits.
fn warn(motion: &Motion, pivots: &Pivots, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    for (t, state) in motion.t.iter().zip(&motion.states) {
        if let Ok(Some(pivot)) = pivots.smallest(&state.q) {
            writeln!(terminal.errors, "warning: t = {} s: {pivot}", number(*t))?;
            return Ok(());
        }
    }
    Ok(())
}

/// Summarizes a motion in one line.
fn summary(motion: &Motion, energies: &Energies) -> String {
    let ends = |values: &[f64]| {
        let (first, last) = (values.first().copied(), values.last().copied());
        (first.unwrap_or_default(), last.unwrap_or_default())
    };
    let ((_, end), (before, after)) = (ends(&motion.t), ends(&energies.total));
    let drift = drift(energies);
    // Further digits are not needed, because the change is also printed.
    let rounded = |energy: f64| format!("{energy:.5e}").parse().unwrap_or(energy);
    let [end, before, after] = [end, rounded(before), rounded(after)].map(number);
    let drift = match drift {
        Some(0.0) => ", no change".to_owned(),
        Some(drift) => format!(", a relative change of {drift:.1e}"),
        None => String::new(),
    };
    format!(
        "{end} s in {} step{}, {} lines; energy from {before} J to {after} J{drift}",
        motion.steps,
        if motion.steps == 1 { "" } else { "s" },
        motion.t.len()
    )
}

/// The change of the energy, relative to the largest value of the energy or of its kinetic part; `None` if both are
/// always 0. The zero of the potential energy is arbitrary, so the sum alone may be 0 up to rounding.
fn drift(energies: &Energies) -> Option<f64> {
    let (first, last) = (energies.total.first()?, energies.total.last()?);
    let sizes = energies.total.iter().chain(&energies.kinetic).map(|energy| energy.abs());
    let largest = sizes.fold(0.0, f64::max);
    (largest > 0.0).then(|| (last - first) / largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_drift_is_relative_to_the_largest_energy() {
        let drift = |kinetic: &[f64], total: &[f64]| {
            let [kinetic, total] = [kinetic, total].map(<[f64]>::to_vec);
            drift(&Energies { kinetic, potential: vec![], total })
        };
        assert_eq!(drift(&[0.0; 3], &[2.0, -4.0, 3.0]), Some(0.25));
        // From rest at the height of the base.
        assert_eq!(drift(&[0.0, 4.0], &[0.0, 1e-9]), Some(2.5e-10));
        assert_eq!(drift(&[0.0, 0.0], &[0.0, 0.0]), None);
        assert_eq!(drift(&[], &[]), None);
    }
}
