//! A session of the query engine that knows the dynamics of robots.

use std::sync::Arc;

use datafusion::execution::runtime_env::RuntimeEnvBuilder;
use datafusion::prelude::{
    CsvReadOptions, DataFrame, ParquetReadOptions, SessionConfig, SessionContext,
};

use super::files::{Format, Log};
use crate::error::Error;
use crate::robots::Robots;
use crate::{functions, identify};

/// How a session computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Partitions that are computed at the same time. With 1, rows keep their order.
    pub threads: usize,
    /// The most memory that queries may take for what they keep, bytes.
    pub memory: usize,
}

/// A session.
#[derive(Clone)]
pub struct Session {
    /// The engine.
    pub context: SessionContext,
    /// The robots that queries may name.
    pub robots: Arc<Robots>,
}

impl Session {
    /// A session with all functions of this crate. Tables are named by their paths, or registered.
    ///
    /// # Errors
    ///
    /// Settings that the engine refuses.
    pub fn new(robots: Robots, settings: Settings) -> Result<Session, Error> {
        let mut config = SessionConfig::new()
            .with_target_partitions(settings.threads.max(1))
            .with_information_schema(true);
        config.options_mut().execution.parquet.pushdown_filters = true;
        let runtime =
            RuntimeEnvBuilder::new().with_memory_limit(settings.memory, 1.0).build_arc()?;
        let mut context = SessionContext::new_with_config_rt(config, runtime).enable_url_table();
        let robots = Arc::new(robots);
        functions::register(&mut context, &robots)?;
        identify::register(&mut context, &robots)?;
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
