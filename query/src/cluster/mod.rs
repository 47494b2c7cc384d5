//! Queries over several machines: each reads a part of the log, and the partial results are combined.
//!
//! DataFusion's distributed execution sends plans to the workers and returns batches, over TCP. A worker serves all
//! robots, because their files are sent with the plans. Workers read logs under the same paths.

mod texts;
mod worker;

use std::net::ToSocketAddrs;
use std::time::Duration;

use datafusion::error::Result as EngineResult;
use datafusion_distributed::WorkerResolver;
use url::Url;

use crate::error::Error;
pub(crate) use texts::Texts;
pub use worker::{Listener, serve};

/// The time to wait for a connection to a worker.
const PATIENCE: Duration = Duration::from_secs(5);

/// The minimum size of a part of a log for another machine, bytes; it takes a few milliseconds to compute.
pub(crate) const WORTH: usize = 1 << 20;

/// The machines that compute queries.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Workers {
    urls: Vec<Url>,
}

impl Workers {
    /// No workers: this process computes its queries.
    #[must_use]
    pub fn none() -> Workers {
        Workers::default()
    }

    /// Workers at addresses such as `192.168.0.7:7070` or `arm-lab:7070`. Each must accept a connection.
    ///
    /// # Errors
    ///
    /// A text that is not an address; a worker that cannot be reached.
    pub fn at(addresses: &[String]) -> Result<Workers, Error> {
        let mut urls = vec![];
        for address in addresses {
            let failed = |reason: &dyn std::fmt::Display| {
                Error::Query(format!(
                    "worker {address}: {reason}; start a worker with `robot-query worker` and name it as HOST:PORT"
                ))
            };
            let url = Url::parse(&format!("http://{address}")).map_err(|error| failed(&error))?;
            let found = address.to_socket_addrs().map_err(|error| failed(&error))?;
            let mut reason = "it has no address".to_owned();
            let reached = found.into_iter().any(|address| {
                let connected = std::net::TcpStream::connect_timeout(&address, PATIENCE);
                connected.map_err(|error| reason = error.to_string()).is_ok()
            });
            if !reached {
                return Err(failed(&reason));
            }
            urls.push(url);
        }
        Ok(Workers { urls })
    }

    /// Whether there are no workers.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.urls.is_empty()
    }
}

impl WorkerResolver for Workers {
    fn get_urls(&self) -> EngineResult<Vec<Url>> {
        Ok(self.urls.clone())
    }
}
