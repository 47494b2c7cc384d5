//! `torques`: the joint torques along a trajectory, split by cause.

use std::io::Read;
use std::path::PathBuf;

use clap::Args;
use robot_model::diagnostic::quote;
use robot_model::robot::Robot;
use robot_simulation::plot::contributions_figure;
use robot_simulation::{Samples, TorqueContributions, Trajectory, torque_contributions};

use crate::Terminal;
use crate::delivery::{ForceArgument, file_of};
use crate::failure::Failure;
use crate::files;
use crate::friction::FrictionArguments;
use crate::motion;
use crate::recording::{Recording, plot_path};
use crate::robot::RobotArgument;
use crate::settings::Settings;
use crate::values::seconds;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic torques robots/planar_2r.toml --expressions \"q1 = sin(t); q2 = 0.5*t^2\" --time 3
  robot-symbolic simulate robots/planar_2r.toml --q0 1.5,0.5 -o motion.csv
  robot-symbolic torques robots/planar_2r.toml --trajectory motion.csv -o torques.csv --plot torques.svg

A trajectory has the columns t, q1 …, qd1 …, qdd1 …, and fx, fy, fz, mx, my, mz for the wrench that the tip
exerts on its surroundings, if any (fx_NAME … for each of several tips); the output of `simulate` is a
trajectory. Expressions may use t and the robot's parameters; velocities and accelerations are their exact
derivatives. A position or velocity that jumps where abs or sign change, and a position without
bound, are refused; where the argument of a root is 0 for a moment, a jump is not seen. The output is CSV:
t, the torques tau, and their contributions: inertia (M qdd), coriolis (C qd, Coriolis and centrifugal
terms), gravity, friction and wrench, in N m or N.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// A CSV file with the trajectory; `-` for standard input
    #[arg(long, value_name = "FILE", conflicts_with = "expressions")]
    trajectory: Option<PathBuf>,
    /// The trajectory as expressions in t, one for each coordinate, separated by `;`
    #[arg(
        long,
        value_name = "Q1=EXPRESSION;…",
        value_delimiter = ';',
        requires = "time",
        conflicts_with = "trajectory"
    )]
    expressions: Vec<String>,
    /// Duration of the trajectory given by --expressions, s
    // A requirement alone is dropped if it conflicts with what is given.
    #[arg(
        long,
        value_name = "S",
        value_parser = seconds,
        requires = "expressions",
        conflicts_with = "trajectory",
        allow_hyphen_values = true
    )]
    time: Option<f64>,
    /// Time between lines of the output with --expressions, s
    #[arg(
        long,
        value_name = "S",
        value_parser = seconds,
        default_value_t = 0.01,
        conflicts_with = "trajectory",
        allow_hyphen_values = true
    )]
    step: f64,
    #[command(flatten)]
    friction: FrictionArguments,
    #[command(flatten)]
    settings: Settings,
    /// The CSV file to write; `-` is standard output [default: -]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The plot to write, .svg or .png: the contributions to each torque over time
    #[arg(long, value_name = "FILE", value_parser = plot_path)]
    plot: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgument,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let inputs = self.robot.inputs().into_iter().chain(self.trajectory.clone());
        let writes = file_of(self.output.as_deref()).is_some() || self.plot.is_some();
        if self.trajectory.is_none() && self.expressions.is_empty() {
            let message = "a trajectory is needed: --trajectory with a CSV file, or --expressions with --time";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let writer = self.force.writer(inputs, writes)?;
        let recording = Recording::open(self.output.as_deref(), self.plot.as_deref(), writer)?;
        let file = self.robot.open()?;
        let robot = motion::robot(&file, &self.settings, &self.friction, terminal)?;
        let friction = self.friction.is_wanted();
        let mut nothing = std::io::empty();
        let (standard, mut terminal) = terminal.without_input(&mut nothing);
        let terminal = &mut terminal;
        let mut trajectory = self.trajectory(&robot, standard)?;
        let wrench = trajectory.has_wrenches();
        let functions = TorqueContributions::functions(friction, wrench);
        let options = file.options(terminal)?;
        let programs = motion::programs(&file, robot.clone(), functions, options)?;
        let mut table = recording.begin(terminal.output, terminal.errors)?;
        let (mut is_first, mut plotted) = (true, TorqueContributions::default());
        while let Some(part) = trajectory.next()? {
            let found = torque_contributions(&programs, &self.settings.pairs(), &part, friction)?;
            table.push_table(&found.table(), std::mem::take(&mut is_first))?;
            if recording.has_plot() {
                plotted.append(found);
            }
        }
        recording.end(table, || contributions_figure(&programs.robot, &plotted))
    }

    fn trajectory<'r, 't>(
        &self,
        robot: &'r Robot,
        standard: &'t mut dyn Read,
    ) -> Result<Parts<'r, 't>, Failure> {
        let Some(path) = &self.trajectory else {
            let texts: Vec<&str> = self.expressions.iter().map(|text| text.trim()).collect();
            let texts: Vec<&str> = texts.into_iter().filter(|text| !text.is_empty()).collect();
            let joined = texts.iter().find(|text| text.matches('=').count() > 1);
            if let Some(text) = joined {
                let remedy = match text.contains("==") {
                    true => "write `=` once",
                    false => "separate coordinates by `;`",
                };
                let message = format!("--expressions: `{}`: {remedy}", quote(text));
                return Err(Failure::Usage(vec![message]));
            }
            let (parameters, time) = (self.settings.pairs(), self.time.unwrap_or_default());
            let found = Trajectory::from_expressions(robot, &parameters, &texts, time, self.step);
            return Ok(Parts::Known(found?, 0));
        };
        let (name, bytes) = files::open(path, standard)?;
        Ok(Parts::Read(Box::new(Samples::new(robot, &name, bytes.reader(), PART)?)))
    }
}

/// The number of samples of the trajectory that are in memory with their torques, unless there is a plot.
const PART: usize = 1024;

/// A trajectory in parts: completely known, with the number of samples already used, or read from a file.
enum Parts<'r, 't> {
    Known(Trajectory, usize),
    Read(Box<Samples<'r, files::Reader<'t>>>),
}

impl Parts<'_, '_> {
    fn has_wrenches(&self) -> bool {
        match self {
            Parts::Known(trajectory, _) => trajectory.wrenches.is_some(),
            Parts::Read(samples) => samples.has_wrenches(),
        }
    }

    fn next(&mut self) -> Result<Option<Trajectory>, Failure> {
        match self {
            Parts::Known(trajectory, taken) => {
                let part = trajectory.part(*taken, PART);
                *taken += part.t.len();
                Ok(Some(part).filter(|part| !part.t.is_empty()))
            }
            Parts::Read(samples) => Ok(samples.next_part()?),
        }
    }
}
