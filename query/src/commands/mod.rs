//! The subcommands, one per file.

mod check;
mod convert;
mod excite;
mod generate;
mod identify;
mod inputs;
mod residual;
mod rows;
mod sql;
mod torques;
mod worker;

use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use robot_query::Error;
use robot_query::Robots;
use robot_query::cluster::Workers;
use robot_query::log::{Session, Settings};

/// Torques, residuals and identification over logs of robots.
#[derive(Parser)]
#[command(name = "robot-query", version, max_term_width = 100)]
struct Command {
    #[command(flatten)]
    engine: Engine,
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    Sql(sql::Arguments),
    Torques(torques::Arguments),
    Residual(residual::Arguments),
    Identify(identify::Arguments),
    Generate(generate::Arguments),
    Excite(excite::Arguments),
    Convert(convert::Arguments),
    Check(check::Arguments),
    Worker(worker::Arguments),
}

/// The heading of options that all subcommands share.
const SHARED: &str = "Options of all commands";

/// What all subcommands share.
#[derive(Args)]
struct Engine {
    /// A folder whose robot files can be named without path and extension; may be repeated
    #[arg(long, global = true, help_heading = SHARED, value_name = "FOLDER")]
    robots: Vec<PathBuf>,
    /// All joints have viscous and constant dry friction: that of the robot file, for URDF that of `<dynamics>`, otherwise
    /// with coefficients that are 0 until `identify` finds them
    #[arg(long, global = true, help_heading = SHARED)]
    friction: bool,
    /// Number of threads; with 1, the rows of one file stay in their order [default: one for each core]
    #[arg(long, global = true, help_heading = SHARED, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// The maximum memory of a query, MiB
    #[arg(long, global = true, help_heading = SHARED, value_name = "MIB", default_value = "1024")]
    memory: NonZeroUsize,
    /// Workers, started by `robot-query worker`; logs must have the same paths on their machines
    #[arg(long, global = true, help_heading = SHARED, value_delimiter = ',', value_name = "HOST:PORT")]
    workers: Vec<String>,
}

impl Engine {
    fn robots(&self) -> Result<Robots, Error> {
        let mut robots = Robots::new();
        self.robots.iter().try_for_each(|folder| robots.register_folder(folder))?;
        if self.friction {
            robots.with_friction();
        }
        Ok(robots)
    }

    fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        self.threads.map_or_else(cores, usize::from)
    }

    /// The maximum memory of a query, in bytes.
    fn memory(&self) -> usize {
        self.memory.get().saturating_mul(1 << 20)
    }

    /// A session with this number of threads.
    fn session(&self, threads: usize) -> Result<Session, Error> {
        let settings = Settings { threads, memory: self.memory() };
        Session::on(self.robots()?, settings, Workers::at(&self.workers)?)
    }
}

/// Runs the command with the arguments of the process.
pub(crate) fn run() -> Result<(), Error> {
    let Command { engine, what } = Command::parse();
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(engine.threads())
        .enable_all()
        .build()
        .map_err(|error| Error::Query(error.to_string()))?;
    runtime.block_on(async {
        match what {
            What::Sql(arguments) => arguments.run(&engine).await,
            What::Torques(arguments) => arguments.run(&engine).await,
            What::Residual(arguments) => arguments.run(&engine).await,
            What::Identify(arguments) => arguments.run(&engine).await,
            What::Generate(arguments) => arguments.run(&engine),
            What::Excite(arguments) => arguments.run(&engine),
            What::Convert(arguments) => arguments.run(&engine),
            What::Check(arguments) => arguments.run(&engine),
            What::Worker(arguments) => arguments.run(&engine).await,
        }
    })
}

/// A number above 0.
fn positive(text: &str) -> Result<f64, String> {
    number(text, "above 0", |number| number > 0.0)
}

/// A number that is 0 or above.
fn not_negative(text: &str) -> Result<f64, String> {
    number(text, "of at least 0", |number| number >= 0.0)
}

/// A finite number in a range, which `range` has in words.
fn number(text: &str, range: &str, is_allowed: fn(f64) -> bool) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    let is_in_range = number.is_finite() && is_allowed(number);
    if is_in_range { Ok(number) } else { Err(format!("not a number {range}")) }
}

/// The noise of every joint, from one number or from one for each joint.
fn noise(given: &[f64], joints: usize) -> Result<Vec<f64>, Error> {
    match given {
        [one] => Ok(vec![*one; joints]),
        all if all.len() == joints => Ok(all.to_vec()),
        other => Err(Error::Identification(format!(
            "--noise has {} numbers; give one, or one for each of {joints} joints",
            other.len()
        ))),
    }
}

/// Writes to standard output, whose reader may close it before the end.
fn show(text: &str) -> Result<(), Error> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::Query(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}
