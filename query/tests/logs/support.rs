//! Functions that the tests share.

use std::path::{Path, PathBuf};

use datafusion::arrow::array::RecordBatch;
use datafusion::arrow::compute::concat_batches;
use robot_query::identify::Estimate;
use robot_query::log::{Log, Session, Settings};
use robot_query::motion::{Generation, Layout, generate, limits};
use robot_query::{Error, Robots};
use tempfile::TempDir;
use tokio::runtime::Runtime;

/// The path of a robot file of the project.
pub(crate) fn robot(name: &str) -> String {
    format!("{}/../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

pub(crate) fn session(threads: usize) -> Session {
    let settings = Settings { threads, memory: 1 << 30 };
    Session::new(Robots::new(), settings).unwrap()
}

/// The usual generation: episodes of 1000 rows with noise of 0.5 N m.
pub(crate) fn generation(path: &str, rows: u64) -> Generation {
    let model = Robots::new().model(path).unwrap();
    Generation {
        rows,
        files: 4,
        rate: 100.0,
        episode: 1000,
        limits: limits(&model, 2.0),
        noise: vec![0.5; model.joints()],
        layout: Layout::Lists,
        single: false,
        seed: 3,
    }
}

/// A folder that contains a log.
pub(crate) fn log(path: &str, how: &Generation) -> TempDir {
    let folder = TempDir::new().unwrap();
    let model = Robots::new().model(path).unwrap();
    generate(&model, how, folder.path()).unwrap();
    folder
}

/// The rows of a query over a log, as one batch, computed by this process.
pub(crate) fn rows(threads: usize, files: &[PathBuf], query: &str) -> Result<RecordBatch, Error> {
    rows_of(&session(threads), files, query)
}

/// The rows of a query over a log, as one batch.
pub(crate) fn rows_of(
    session: &Session,
    files: &[PathBuf],
    query: &str,
) -> Result<RecordBatch, Error> {
    Runtime::new().unwrap().block_on(async {
        let table = session.table(&Log::open(files)?).await?;
        session.context.register_table("log", table.into_view())?;
        let table = session.context.sql(query).await?;
        let schema = table.schema().inner().clone();
        let batches = table.collect().await?;
        Ok(concat_batches(&schema, &batches).unwrap())
    })
}

/// The estimate of a robot over a log; `more` contains further arguments, such as the noise.
pub(crate) fn identified(
    threads: usize,
    files: &[PathBuf],
    robot: &str,
    more: &str,
) -> Result<Estimate, Error> {
    let query = format!("SELECT identify('{robot}', q, qd, qdd, tau{more}) FROM log");
    let answer = rows(threads, files, &query)?;
    Ok(Estimate::from_array(answer.column(0), 0)?.unwrap())
}

/// The files of a folder.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    Log::open(&[folder.to_owned()]).unwrap().files().to_vec()
}

/// The largest difference, relative to the largest of the wanted values.
pub(crate) fn difference(found: &[f64], wanted: &[f64]) -> f64 {
    assert_eq!(found.len(), wanted.len());
    let largest = wanted.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let differences = found.iter().zip(wanted).map(|(found, wanted)| (found - wanted).abs());
    differences.fold(0.0, f64::max) / largest
}
