//! `torques`: the torques of the model along a log.

use std::path::PathBuf;

use clap::Args;
use datafusion::execution::FunctionRegistry;
use robot_model::variable::JointVariable;
use robot_query::Error;
use robot_query::functions::torques_of;

use super::Engine;
use super::inputs::Inputs;
use super::rows::Rows;

/// Computes the torques of the model along a log, with the friction of the robot file
///
/// The result has the columns of the log and the list `torque`. A .parquet or .csv file has the rows in the order of
/// the log, and is computed by one thread; a folder gets a file from each thread or, with --resume, for each file of
/// the log.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query torques robots/ur5.toml logs -o torques.parquet --columns episode,t
  robot-query torques robots/ur5.toml logs -o torques --resume")]
pub(super) struct Arguments {
    #[command(flatten)]
    inputs: Inputs,
    /// The .parquet or .csv file, or the folder, to write
    #[arg(short, long, value_name = "PATH")]
    output: PathBuf,
    /// The columns of the log that are kept [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    columns: Option<Vec<String>>,
    /// Write a file into the folder for each Parquet file of the log, and keep those that an earlier run finished
    #[arg(long)]
    resume: bool,
}

impl Arguments {
    pub(super) async fn run(&self, engine: &Engine) -> Result<(), Error> {
        let rows = Rows {
            inputs: &self.inputs,
            columns: self.columns.as_deref(),
            output: &self.output,
            resume: self.resume,
            column: |session, opened| {
                let function = session.context.udf(torques_of(&opened.model).name())?;
                Ok(function.call(opened.arguments(&JointVariable::MOTION)?).alias("torque"))
            },
        };
        rows.write(engine).await
    }
}
