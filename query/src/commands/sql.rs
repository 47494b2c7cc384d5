//! `sql`: any SQL query.

use std::path::PathBuf;

use clap::Args;
use datafusion::arrow::util::pretty::pretty_format_batches;
use datafusion::execution::context::SQLOptions;
use datafusion::prelude::DataFrame;
use robot_query::Error;
use robot_query::log::{Answer, Log, Session, write};

use super::{Engine, show};

/// Runs an SQL query in which the dynamics are functions and files are tables
///
/// `inverse_dynamics('ur5', q, qd, qdd)` and the other functions of a robot take the robot, then for each input a
/// list, a struct or numbers; `residual('ur5', q, qd, qdd, tau)` is the measured torques minus those of the model;
/// `identify('ur5', q, qd, qdd, tau)` is an aggregate. Tables are paths in quotes, or `log`, the log that --log
/// names.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query --robots robots sql \"SELECT t, gravity('ur5', q) FROM 'logs/*.parquet' LIMIT 3\"
  robot-query --robots robots sql --log logs \\
    \"SELECT episode, identify('ur5', q, qd, qdd, tau)['condition'] FROM log GROUP BY episode\"")]
pub(super) struct Arguments {
    /// The query
    query: String,
    /// The files and folders of the table `log`
    #[arg(long, value_name = "PATH")]
    log: Vec<PathBuf>,
    /// The .parquet or .csv file, or the folder, to write [default: a table on standard output]
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
}

/// The answer of a query, which only reads.
async fn queried(session: &Session, query: &str) -> Result<DataFrame, Error> {
    let plan = session.context.state().create_logical_plan(query).await?;
    let options = SQLOptions::new().with_allow_ddl(false).with_allow_dml(false);
    if options.with_allow_statements(false).verify_plan(&plan).is_err() {
        return Err(Error::Query(
            "only queries that read can be run, such as SELECT; -o writes the answer to a new file"
                .to_owned(),
        ));
    }
    Ok(session.context.execute_logical_plan(plan).await?)
}

impl Arguments {
    pub(super) async fn run(&self, engine: &Engine) -> Result<(), Error> {
        let session = engine.session(engine.threads())?;
        let log = if self.log.is_empty() { None } else { Some(Log::open(&self.log)?) };
        if let Some(log) = &log {
            let table = session.table(log).await?;
            session.context.register_table("log", table.into_view())?;
        }
        let located = |error: Error| match &log {
            Some(log) => log.located(error),
            None => error,
        };
        let table = queried(&session, &self.query).await?;
        match &self.output {
            Some(path) => {
                let rows = write(table, &Answer::at(path)?, None).await.map_err(located)?;
                eprintln!("{rows} rows");
                Ok(())
            }
            None => {
                let batches = table.collect().await.map_err(|error| located(error.into()))?;
                let text = pretty_format_batches(&batches);
                let text = text.map_err(|error| Error::Query(error.to_string()))?;
                show(&format!("{text}\n"))
            }
        }
    }
}
