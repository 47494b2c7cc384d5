//! A robot and a log as arguments.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use datafusion::logical_expr::Expr;
use datafusion::prelude::{DataFrame, ident};
use datafusion_distributed::display_plan_ascii;
use robot_model::variable::JointVariable;
use robot_query::log::{Log, Names, Session};
use robot_query::{Error, Model};

use super::show;

/// A robot and its log.
#[derive(Args)]
pub(super) struct Inputs {
    /// The robot: a path, or a name in a folder of --robots
    robot: String,
    /// The log: Parquet or CSV files, or folders of Parquet files
    #[arg(required = true)]
    log: Vec<PathBuf>,
    #[command(flatten)]
    variables: Variables,
    /// Use only rows for which this SQL expression is true, such as "episode < 10"
    #[arg(long = "where", value_name = "SQL")]
    pub(super) filter: Option<String>,
    /// Show how the query would be computed, and compute nothing
    #[arg(long)]
    pub(super) explain: bool,
}

/// The columns of the joints' variables, and their units.
#[derive(Args)]
pub(super) struct Variables {
    /// The column of positions: a list, the prefix of numbered columns, a column for each joint with commas between them,
    /// or `{}` for the joint's name, as in '{}_position' [default: q]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    q: Option<Vec<String>>,
    /// The column of velocities, likewise [default: qd]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    qd: Option<Vec<String>>,
    /// The column of accelerations, likewise [default: qdd]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    qdd: Option<Vec<String>>,
    /// The column of measured torques, likewise [default: tau]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    tau: Option<Vec<String>>,
    /// Angles are in degrees, their derivatives in degrees per s and s² [default: rad]
    #[arg(long)]
    degrees: bool,
    /// The factor by which measured torques are multiplied to be in N m or N: 0.001 for N mm, the torque constant times the
    /// gear ratio for motor currents; one number, or one for each joint
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', allow_negative_numbers = true, value_parser = factor)]
    tau_factor: Vec<f64>,
}

/// A number by which torques can be multiplied.
fn factor(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    let is_factor = number.is_finite() && number != 0.0;
    if is_factor { Ok(number) } else { Err("not a number other than 0".to_owned()) }
}

impl Variables {
    pub(super) fn names(&self) -> Names {
        let Variables { q, qd, qdd, tau, degrees, tau_factor } = self;
        Names {
            variables: [q, qd, qdd, tau].map(Clone::clone),
            degrees: *degrees,
            tau_factor: tau_factor.clone(),
        }
    }
}

/// Shows the plan of a table, including the stages that other machines compute.
pub(super) async fn explained(table: DataFrame, opened: &Opened) -> Result<(), Error> {
    let plan = table.create_physical_plan().await?;
    let text = display_plan_ascii(plan.as_ref(), false);
    // Other machines receive a robot as the text of its file.
    let text = text.replace(&opened.model.source.text, &opened.robot);
    show(&format!("{}\n", text.trim_end()))
}

/// A log that is open for a robot.
pub(super) struct Opened {
    pub(super) model: Arc<Model>,
    pub(super) table: DataFrame,
    pub(super) log: Log,
    robot: String,
    names: Names,
    /// Whether every row of the log is used.
    all: bool,
}

impl Inputs {
    pub(super) async fn open(&self, session: &Session) -> Result<Opened, Error> {
        self.open_log(session, Log::open(&self.log)?).await
    }

    /// Another log for the robot.
    pub(super) async fn open_log(&self, session: &Session, log: Log) -> Result<Opened, Error> {
        let model = session.robots.model(&self.robot)?;
        let mut table = session.table(&log).await?;
        if let Some(filter) = &self.filter {
            let filter = table.parse_sql_expr(filter)?;
            table = table.filter(filter)?;
        }
        let names = self.variables.names();
        Ok(Opened {
            model,
            table,
            log,
            robot: self.robot.clone(),
            names,
            all: self.filter.is_none(),
        })
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

    /// The columns of the log that are kept beside a result: those that are named, otherwise all.
    ///
    /// # Errors
    ///
    /// A column that the log does not have.
    pub(super) fn kept(&self, columns: Option<&[String]>) -> Result<Vec<Expr>, Error> {
        let fields = self.table.schema().fields();
        let all: Vec<&str> = fields.iter().map(|field| field.name().as_str()).collect();
        let Some(columns) = columns else { return Ok(all.into_iter().map(ident).collect()) };
        match columns.iter().find(|column| !all.contains(&column.as_str())) {
            Some(missing) => Err(Error::Columns(format!(
                "--columns: the log has no column `{missing}`; its columns are {}",
                all.join(", ")
            ))),
            None => Ok(columns.iter().map(ident).collect()),
        }
    }

    /// The number of rows that a result must have, if the files state it.
    pub(super) fn rows(&self) -> Option<u64> {
        self.log.rows().filter(|_| self.all)
    }

    /// Adds the place in the log to an error, if the log is the reason.
    pub(super) fn located(&self, error: Error) -> Error {
        self.log.located(error)
    }
}
