//! `residual`: what the model leaves of measured torques.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use datafusion::execution::FunctionRegistry;
use robot_model::variable::JointVariable;
use robot_query::Error;
use robot_query::log::{Answer, write};
use robot_query::residual::{Statistics, statistics};

use super::inputs::Inputs;
use super::{Engine, show};

/// What the model leaves of measured torques, joint by joint
///
/// The model is that of the robot file, friction included. Rows with a null, NaN or infinity are left out and counted.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query residual robots/ur5.toml logs
  robot-query residual robots/ur5.toml logs -o residuals.parquet --columns episode,t")]
pub(super) struct Arguments {
    #[command(flatten)]
    inputs: Inputs,
    /// A .parquet or .csv file, or a folder, with the residual of each row
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// The columns of the log that are kept in the output [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAMES", requires = "output")]
    columns: Option<Vec<String>>,
}

impl Arguments {
    pub(super) async fn run(&self, engine: &Engine) -> Result<(), Error> {
        let answer = self.output.as_deref().map(Answer::at).transpose()?;
        let in_order = matches!(answer, Some(Answer::Parquet(_) | Answer::Csv(_)));
        let session = engine.session(if in_order { 1 } else { engine.threads() })?;
        let opened = self.inputs.open(&session).await?;
        let function = session.context.udf("residual")?;
        let residual = function.call(opened.arguments(&JointVariable::ALL)?).alias("residual");
        if let Some(answer) = &answer {
            let mut columns = opened.kept(self.columns.as_deref());
            columns.push(residual);
            let table = opened.table.clone().select(columns)?;
            let rows = write(table, answer).await.map_err(|error| opened.located(error))?;
            eprintln!("{rows} rows");
            return Ok(());
        }
        let table = opened.table.clone().select(vec![residual])?;
        let found = statistics(table).await.map_err(|error| opened.located(error))?;
        let mut text = format!("{} rows, {} left out\n", found.rows, found.excluded);
        let _ = writeln!(text, "{:24}{:>14}{:>14}{:>14}", "joint", "mean", "rms", "largest");
        for (coordinate, joint) in opened.model.robot.coordinates.iter().zip(found.joints()) {
            let Statistics { mean, rms, largest } = joint;
            let name = &coordinate.joint;
            let _ = writeln!(text, "{name:24}{mean:>14.6}{rms:>14.6}{largest:>14.6}");
        }
        show(&text)
    }
}
