//! `residual`: the residuals of measured torques.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use datafusion::execution::FunctionRegistry;
use datafusion::logical_expr::Expr;
use datafusion::prelude::ident;
use robot_model::variable::JointVariable;
use robot_query::Error;
use robot_query::log::{Session, check_row_count, check_vacant, write_new};
use robot_query::residual::{Residuals, Statistics, figure, statistics};

use super::inputs::{Inputs, Opened, explained};
use super::rows::Rows;
use super::{Engine, show};

/// Computes the residuals of measured torques: the measured torques minus those of the model, joint by joint
///
/// The model is that of the robot file, including friction. Rows with a null, NaN or infinity are left out and counted.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query residual robots/ur5.toml logs
  robot-query residual robots/ur5.toml logs --plot residuals.svg
  robot-query residual robots/ur5.toml logs -o residuals.parquet --columns episode,t")]
pub(super) struct Arguments {
    #[command(flatten)]
    inputs: Inputs,
    /// The .parquet or .csv file, or the folder, to write, with the residual of each row
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// The columns of the log that are kept in the output [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAMES", requires = "output")]
    columns: Option<Vec<String>>,
    /// Write a file into the folder for each Parquet file of the log, and keep those that an earlier run finished
    #[arg(long, requires = "output")]
    resume: bool,
    /// The .svg file to write, with the residuals of each joint over time: mean, root mean square, smallest and
    /// largest in each of 300 intervals
    #[arg(long, value_name = "FILE", conflicts_with = "output")]
    plot: Option<PathBuf>,
    /// The column of times for the plot, s
    #[arg(long, value_name = "COLUMN", default_value = "t", requires = "plot")]
    time: String,
}

fn residual(session: &Session, opened: &Opened) -> Result<Expr, Error> {
    let function = session.context.udf("residual")?;
    Ok(function.call(opened.arguments(&JointVariable::ALL)?).alias("residual"))
}

impl Arguments {
    pub(super) async fn run(&self, engine: &Engine) -> Result<(), Error> {
        if let Some(output) = &self.output {
            let rows = Rows {
                inputs: &self.inputs,
                columns: self.columns.as_deref(),
                output,
                resume: self.resume,
                column: residual,
            };
            return rows.write(engine).await;
        }
        self.plot.iter().try_for_each(|path| check_vacant(path))?;
        // A plot has the same bytes for any number of threads.
        let session = engine.session(if self.plot.is_some() { 1 } else { engine.threads() })?;
        let opened = self.inputs.open(&session).await?;
        let residuals = residual(&session, &opened)?;
        let table = opened.table.clone().select(vec![residuals.clone()])?;
        if self.inputs.explain {
            return explained(table, &opened).await;
        }
        let found = statistics(table, opened.rows()).await;
        let found = found.map_err(|error| opened.located(error))?;
        check_row_count(found.rows + found.excluded, opened.rows())?;
        show(&shown(&found, &opened))?;
        match &self.plot {
            Some(path) => self.plot(path, residuals, &opened).await,
            None => Ok(()),
        }
    }

    async fn plot(&self, path: &Path, residuals: Expr, opened: &Opened) -> Result<(), Error> {
        let time = ident(self.time.as_str()).alias("t");
        let table = opened.table.clone().select(vec![residuals, time])?;
        let figure = figure(table, &opened.model).await.map_err(|error| opened.located(error))?;
        write_new(path, figure.svg()?.as_bytes())
    }
}

/// Shows the residuals as text.
fn shown(found: &Residuals, opened: &Opened) -> String {
    let mut text = format!("{} rows, {} left out\n", found.rows, found.excluded);
    let _ = writeln!(text, "{:24}{:>14}{:>14}{:>14}", "joint", "mean", "rms", "largest");
    for (coordinate, joint) in opened.model.robot.coordinates.iter().zip(found.joints()) {
        let Statistics { mean, rms, largest } = joint;
        let name = &coordinate.joint;
        let _ = writeln!(text, "{name:24}{mean:>14.6}{rms:>14.6}{largest:>14.6}");
    }
    text
}
