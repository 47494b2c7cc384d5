//! `identify`: base parameters from a log.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use datafusion::execution::FunctionRegistry;
use datafusion::functions_nested::expr_fn::make_array;
use datafusion::logical_expr::lit;
use datafusion::physical_plan::collect;
use robot_model::variable::JointVariable;
use robot_query::Error;
use robot_query::identify::{Estimate, Known, Prior};
use robot_query::log::{Progress, check_row_count, check_vacant, write_new};

use super::Engine;
use super::inputs::{Inputs, Opened, explained};
use super::{noise, not_negative, positive, show};

/// Estimates the base parameters from measured torques, with their standard deviations
///
/// The method is weighted least squares by QR decomposition; the log is read once, in any order, and never held in
/// memory. Friction and drives are also identified if the robot file has them, with any values. Rows with a null, NaN
/// or infinity are left out and counted. Parameters that the log does not determine keep the value from the robot
/// file.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query identify robots/ur5.toml logs
  robot-query identify robots/ur5.toml logs --noise 1
  robot-query identify robots/ur5.toml logs --write-back identified.toml")]
pub(super) struct Arguments {
    #[command(flatten)]
    inputs: Inputs,
    /// The standard deviations of the torques' noise, N m or N: one, or one for each joint [default: estimated]
    #[arg(long, value_delimiter = ',', value_name = "NUMBERS", value_parser = positive, allow_negative_numbers = true)]
    noise: Option<Vec<f64>>,
    /// Keep parameters near those of the robot file: the weight of its values relative to that of all rows of the
    /// log, such as 0.001
    #[arg(long, value_name = "WEIGHT", default_value_t = 0.0, value_parser = not_negative, allow_negative_numbers = true)]
    ridge: f64,
    /// A known parameter: its value, by default that of the robot file, and its standard deviation, 0 to fix the
    /// parameter
    #[arg(long, value_delimiter = ',', value_name = "NAME=VALUE:DEVIATION")]
    prior: Vec<Known>,
    /// The .csv file to write, with the parameters
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The .toml file to write, or a .urdf file if the robot file is one, with the identified values: among those
    /// that are physically possible, the ones that explain the log best
    #[arg(long, value_name = "FILE")]
    write_back: Option<PathBuf>,
}

impl Arguments {
    pub(super) async fn run(&self, engine: &Engine) -> Result<(), Error> {
        self.output.iter().chain(&self.write_back).try_for_each(|path| check_vacant(path))?;
        let session = engine.session(engine.threads())?;
        let opened = self.inputs.open(&session).await?;
        let Some(estimate) = self.estimate(&session, &opened).await? else {
            return Ok(());
        };
        check_row_count(estimate.rows + estimate.excluded, opened.rows())?;
        show(&shown(&estimate))?;
        if let Some(unit) = estimate.unit() {
            eprintln!("warning: the measured torques are {unit}");
        }
        if let Some(path) = &self.output {
            write_new(path, csv(&estimate).as_bytes())?;
        }
        match &self.write_back {
            Some(path) => write_back(&estimate, &opened, path),
            None => Ok(()),
        }
    }

    /// Computes the estimate; `None` if only the plan is shown.
    async fn estimate(
        &self,
        session: &robot_query::log::Session,
        opened: &Opened,
    ) -> Result<Option<Estimate>, Error> {
        let mut arguments = opened.arguments(&JointVariable::ALL)?;
        if let Some(given) = &self.noise {
            let noise = noise(given, opened.model.joints())?;
            arguments.push(make_array(noise.into_iter().map(lit).collect()));
        }
        let prior = Prior { ridge: self.ridge, known: self.prior.clone() };
        arguments.push(lit(prior.to_string()));
        let identify = session.context.udaf("identify")?.call(arguments).alias("answer");
        let table = opened.table.clone().aggregate(vec![], vec![identify])?;
        if self.inputs.explain {
            return explained(table, opened).await.map(|()| None);
        }
        let context = Arc::new(table.task_ctx());
        let plan = table.create_physical_plan().await?;
        let progress = Progress::of(&plan, opened.rows());
        let batches = collect(plan, context).await;
        drop(progress);
        let batches = batches.map_err(|error| opened.located(error.into()))?;
        let answers = batches.iter().find(|batch| batch.num_rows() > 0);
        let answer = answers.map(|batch| Estimate::from_array(batch.column(0), 0)).transpose()?;
        let no_rows = || Error::Identification("the log has no rows".to_owned());
        answer.flatten().ok_or_else(no_rows).map(Some)
    }
}

/// Writes the robot file with the identified values, and reports how much they increase the residual and the
/// warnings of the doctor.
fn write_back(estimate: &Estimate, opened: &Opened, path: &Path) -> Result<(), Error> {
    let consistent = estimate.consistent(&opened.model)?;
    let (text, complaints) =
        estimate.robot_file(&opened.model, &consistent, &path.to_string_lossy())?;
    let path_shown = path.display();
    let said = if consistent.is_estimate {
        format!("\nthe estimate is physically possible; {path_shown} contains it\n")
    } else {
        let percent = 100.0 * (consistent.growth - 1.0);
        format!(
            "\nthe estimate is physically impossible; {path_shown} contains the possible values that explain the log \
             best, with a residual {percent:.3e} % larger\n"
        )
    };
    show(&said)?;
    eprint!("{complaints}");
    write_new(path, text.as_bytes())
}

/// Shows the estimate as text.
fn shown(estimate: &Estimate) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}: {} rows, {} left out; {} of {} parameters identified, condition {:.3}",
        estimate.robot,
        estimate.rows,
        estimate.excluded,
        estimate.rank,
        estimate.names.len(),
        estimate.condition
    );
    let _ = writeln!(text, "{:10}{:>16}{:>16}{:>16}", "", "estimated", "deviation", "robot file");
    for (place, name) in estimate.names.iter().enumerate() {
        let (value, nominal) = (estimate.values[place], estimate.nominal[place]);
        let deviation =
            estimate.deviations[place].map_or("-".to_owned(), |one| format!("{one:.6}"));
        let _ = writeln!(text, "{name:10}{value:>16.6}{deviation:>16}{nominal:>16.6}");
    }
    for parameter in &estimate.unidentifiable {
        let _ = match parameter.with.as_slice() {
            [] => writeln!(text, "{} has no effect in this log", parameter.name),
            with => {
                writeln!(
                    text,
                    "{} has an effect only together with {}",
                    parameter.name,
                    with.join(", ")
                )
            }
        };
    }
    for name in &estimate.fixed {
        let _ = writeln!(text, "{name} was fixed");
    }
    let _ = writeln!(text, "\n{:24}{:>16}{:>16}", "joint", "residual (rms)", "noise");
    for joint in &estimate.joints {
        let noise = joint.noise.map_or("given".to_owned(), |noise| format!("{noise:.6}"));
        let _ = writeln!(text, "{:24}{:>16.6}{noise:>16}", joint.name, joint.rms);
    }
    text
}

/// The estimate as a table.
fn csv(estimate: &Estimate) -> String {
    let mut text = "name,value,deviation,robot_file\n".to_owned();
    for (place, name) in estimate.names.iter().enumerate() {
        let deviation = estimate.deviations[place].map_or(String::new(), |one| one.to_string());
        let (value, nominal) = (estimate.values[place], estimate.nominal[place]);
        text.push_str(&format!("{name},{value},{deviation},{nominal}\n"));
    }
    text
}
