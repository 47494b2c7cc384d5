//! A session of the query engine with the functions of robots.

use std::sync::Arc;

use datafusion::execution::runtime_env::{RuntimeEnv, RuntimeEnvBuilder};
use datafusion::execution::{FunctionRegistry, SessionStateBuilder};
use datafusion::prelude::{
    CsvReadOptions, DataFrame, ParquetReadOptions, SessionConfig, SessionContext,
};
use datafusion_distributed::{DistributedExt, SessionStateBuilderExt};

use super::files::{Format, Log};
use super::stores::Stores;
use crate::cluster::{Texts, WORTH, Workers};
use crate::error::Error;
use crate::robots::Robots;
use crate::{derivative, functions, identify};

/// The settings of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The number of partitions that are computed at the same time. With 1, rows keep their order.
    pub threads: usize,
    /// The most memory that queries may use for intermediate results, bytes.
    pub memory: usize,
}

/// Makes the environment that queries share: the limit of the memory for intermediate results, in bytes, and the
/// stores that they read from.
///
/// # Errors
///
/// A limit that the engine refuses.
pub(crate) fn runtime(memory: usize) -> Result<Arc<RuntimeEnv>, Error> {
    let builder = RuntimeEnvBuilder::new().with_memory_limit(memory, 1.0);
    Ok(builder.with_object_store_registry(Arc::new(Stores::default())).build_arc()?)
}

/// A session.
#[derive(Clone)]
pub struct Session {
    /// The engine.
    pub context: SessionContext,
    /// The robots that queries can name.
    pub robots: Arc<Robots>,
}

impl Session {
    /// Makes a session with all functions of this crate. Tables are named by their paths, or registered.
    ///
    /// # Errors
    ///
    /// Settings that the engine refuses.
    pub fn new(robots: Robots, settings: Settings) -> Result<Session, Error> {
        Session::on(robots, settings, Workers::none())
    }

    /// Makes a session whose queries are computed by workers if a log is large enough. Without workers this process
    /// computes them.
    ///
    /// # Errors
    ///
    /// Settings that the engine refuses.
    pub fn on(robots: Robots, settings: Settings, workers: Workers) -> Result<Session, Error> {
        let mut config = SessionConfig::new()
            .with_target_partitions(settings.threads.max(1))
            .with_information_schema(true);
        config.options_mut().execution.parquet.pushdown_filters = true;
        let runtime = runtime(settings.memory)?;
        let mut builder = SessionStateBuilder::new()
            .with_config(config)
            .with_runtime_env(runtime)
            .with_default_features();
        let distributed = !workers.is_empty();
        if distributed {
            builder = builder
                .with_distributed_worker_resolver(workers)
                .with_distributed_planner()
                .with_distributed_file_scan_config_bytes_per_partition(WORTH)?;
        }
        let mut context = SessionContext::new_with_state(builder.build()).enable_url_table();
        let robots = Arc::new(robots);
        functions::register(&mut context, &robots)?;
        identify::register(&mut context, &robots)?;
        derivative::register(&mut context)?;
        let texts = Texts { robots: robots.clone(), distributed };
        context.register_function_rewrite(Arc::new(texts))?;
        Ok(Session { context, robots })
    }

    /// The table of a log.
    ///
    /// # Errors
    ///
    /// Files that the engine cannot read.
    pub async fn table(&self, log: &Log) -> Result<DataFrame, Error> {
        let paths = log.files().iter().map(|path| path.to_string_lossy().into_owned());
        let paths: Vec<String> = paths.collect();
        let table = match log.format() {
            Format::Parquet => {
                self.context.read_parquet(paths, ParquetReadOptions::default()).await
            }
            Format::Csv => self.context.read_csv(paths, CsvReadOptions::default()).await,
        };
        Ok(table?)
    }
}
