//! `torques`: the torques of the model along a log.

use std::path::PathBuf;

use clap::Args;
use datafusion::execution::FunctionRegistry;
use robot_model::variable::JointVariable;
use robot_query::Error;
use robot_query::functions::torques_of;
use robot_query::log::{Answer, write};

use super::Engine;
use super::inputs::Inputs;

/// The torques of the model along a log, with the friction of the robot file
///
/// The answer has the columns of the log and the list `torque`. A .parquet or .csv file has the rows in the order of
/// the log, and is computed by one thread; a folder gets a file from each thread.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query torques robots/ur5.toml logs -o torques.parquet --columns episode,t")]
pub(super) struct Arguments {
    #[command(flatten)]
    inputs: Inputs,
    /// The .parquet or .csv file, or the folder, to write
    #[arg(short, long, value_name = "PATH")]
    output: PathBuf,
    /// The columns of the log that are kept [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    columns: Option<Vec<String>>,
}

impl Arguments {
    pub(super) async fn run(&self, engine: &Engine) -> Result<(), Error> {
        let answer = Answer::at(&self.output)?;
        let threads = if matches!(answer, Answer::Folder(_)) { engine.threads() } else { 1 };
        let session = engine.session(threads)?;
        let opened = self.inputs.open(&session).await?;
        let function = session.context.udf(torques_of(&opened.model).name())?;
        let torque = function.call(opened.arguments(&JointVariable::MOTION)?).alias("torque");
        let mut columns = opened.kept(self.columns.as_deref());
        columns.push(torque);
        let table = opened.table.clone().select(columns)?;
        let rows = write(table, &answer).await.map_err(|error| opened.located(error))?;
        eprintln!("{rows} rows");
        Ok(())
    }
}
