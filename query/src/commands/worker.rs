//! `worker`: computes queries for other machines.

use clap::Args;
use robot_query::Error;
use robot_query::cluster::{Listener, serve};

use super::{Engine, show};

/// Computes parts of other machines' queries, for any robot, until it is stopped
///
/// The address is printed once it can be reached. Robots are sent with the queries; the worker reads logs from the
/// paths in the query. There is no password: listen only on addresses that trusted machines alone can reach.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query worker --listen 127.0.0.1:7071 &
  robot-query worker --listen 127.0.0.1:7072 &
  robot-query --workers 127.0.0.1:7071,127.0.0.1:7072 identify robots/ur5.toml logs")]
pub(super) struct Arguments {
    /// The address to listen on; port 0 is any free port
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:7070")]
    listen: String,
}

impl Arguments {
    pub(super) async fn run(&self, engine: &Engine) -> Result<(), Error> {
        let listener = Listener::bind(&self.listen).await?;
        show(&format!("{}\n", listener.address))?;
        serve(listener, engine.robots()?, engine.memory()).await
    }
}
