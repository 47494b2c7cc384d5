//! A robot and a log as arguments.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use datafusion::logical_expr::Expr;
use datafusion::prelude::{DataFrame, ident};
use robot_model::variable::JointVariable;
use robot_query::log::{Log, Names, Session};
use robot_query::{Error, Model};

/// A robot and its log.
#[derive(Args)]
pub(super) struct Inputs {
    /// The robot: a path, or a name in a folder of --robots
    robot: String,
    /// The log: Parquet or CSV files, or folders of Parquet files
    #[arg(required = true)]
    log: Vec<PathBuf>,
    /// The column of positions: a list, or the beginning of the names of numbered columns [default: q]
    #[arg(long, value_name = "COLUMN")]
    q: Option<String>,
    /// The column of velocities [default: qd]
    #[arg(long, value_name = "COLUMN")]
    qd: Option<String>,
    /// The column of accelerations [default: qdd]
    #[arg(long, value_name = "COLUMN")]
    qdd: Option<String>,
    /// The column of measured torques [default: tau]
    #[arg(long, value_name = "COLUMN")]
    tau: Option<String>,
    /// Only rows of which this SQL expression is true, as in "episode < 10"
    #[arg(long = "where", value_name = "SQL")]
    filter: Option<String>,
}

/// A log that has been opened for a robot.
pub(super) struct Opened {
    pub(super) model: Arc<Model>,
    pub(super) table: DataFrame,
    robot: String,
    log: Log,
    names: Names,
}

impl Inputs {
    pub(super) async fn open(&self, session: &Session) -> Result<Opened, Error> {
        let model = session.robots.model(&self.robot)?;
        let log = Log::open(&self.log)?;
        let mut table = session.table(&log).await?;
        if let Some(filter) = &self.filter {
            let filter = table.parse_sql_expr(filter)?;
            table = table.filter(filter)?;
        }
        let Inputs { q, qd, qdd, tau, .. } = self;
        let names = Names { variables: [q, qd, qdd, tau].map(Clone::clone) };
        Ok(Opened { model, table, robot: self.robot.clone(), log, names })
    }
}

impl Opened {
    /// The robot as an argument of a function, and the columns of variables.
    pub(super) fn arguments(&self, variables: &[JointVariable]) -> Result<Vec<Expr>, Error> {
        let schema = self.table.schema().as_arrow().clone();
        let columns = self.names.columns(&schema, variables, &self.model)?;
        let robot = datafusion::logical_expr::lit(self.robot.as_str());
        Ok(std::iter::once(robot).chain(columns).collect())
    }

    /// The columns of the log that are kept beside an answer: those named, else all.
    pub(super) fn kept(&self, columns: Option<&[String]>) -> Vec<Expr> {
        let all =
            || self.table.schema().fields().iter().map(|field| field.name().clone()).collect();
        let names: Vec<String> = columns.map_or_else(all, <[String]>::to_vec);
        names.into_iter().map(ident).collect()
    }

    /// An error with the place in the log, if the log is the reason.
    pub(super) fn located(&self, error: Error) -> Error {
        match error {
            Error::Engine(_) => self.log.fault().unwrap_or(error),
            error => error,
        }
    }
}
