//! A worker: computes parts of other processes' queries.

use std::net::SocketAddr;
use std::sync::Arc;

use datafusion::error::DataFusionError;
use datafusion::execution::SessionState;
use datafusion_distributed::{Worker, WorkerQueryContext};
use tokio::net::TcpListener;
use tonic::transport::Server;
use tonic::transport::server::TcpIncoming;

use crate::error::Error;
use crate::log::runtime;
use crate::robots::Robots;
use crate::{derivative, functions, identify};

/// An address at which a worker accepts connections.
#[derive(Debug)]
pub struct Listener {
    listener: TcpListener,
    /// The address.
    pub address: SocketAddr,
}

impl Listener {
    /// Listens at an address such as `127.0.0.1:7070`; port 0 chooses a free port.
    ///
    /// # Errors
    ///
    /// An address that is in use or does not belong to this machine.
    pub async fn bind(address: &str) -> Result<Listener, Error> {
        let failed = |error: std::io::Error| Error::Query(format!("{address}: {error}"));
        let listener = TcpListener::bind(address).await.map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        Ok(Listener { listener, address })
    }
}

/// Computes parts of queries until the process ends. Robots arrive as texts; names are those of `robots`. Anyone
/// who can connect to the address can make this process read files.
///
/// # Errors
///
/// A memory limit that the engine refuses; a connection that cannot be served.
pub async fn serve(listener: Listener, robots: Robots, memory: usize) -> Result<(), Error> {
    let robots = Arc::new(robots);
    let runtime = runtime(memory)?;
    let build = move |query: WorkerQueryContext| {
        let state = state(query, &robots);
        async { state }
    };
    let worker = Worker::from_session_builder(build)
        .with_runtime_env(runtime)
        .with_version(env!("CARGO_PKG_VERSION"));
    Server::builder()
        .add_service(worker.into_worker_server())
        .serve_with_incoming(TcpIncoming::from(listener.listener))
        .await
        .map_err(|error| Error::Query(error.to_string()))
}

/// The state of a session with the functions of robots.
fn state(query: WorkerQueryContext, robots: &Arc<Robots>) -> Result<SessionState, DataFusionError> {
    let mut state = query.builder.build();
    functions::register(&mut state, robots)?;
    identify::register(&mut state, robots)?;
    derivative::register(&mut state)?;
    Ok(state)
}
