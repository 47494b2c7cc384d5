//! Identification of base parameters from logs.

mod accumulator;
mod answer;
mod consistent;
mod estimate;
mod measurements;
mod parameters;
mod prior;
mod triangle;
mod written;

use std::sync::Arc;

use datafusion::execution::FunctionRegistry;
use datafusion::logical_expr::AggregateUDF;

use crate::error::Error;
use crate::robots::Robots;
use accumulator::Identify;
pub use consistent::Consistent;
pub use estimate::{Estimate, Residual, Unidentifiable};
pub(crate) use measurements::{Measurements, Scratch};
pub use prior::{Known, Prior};

/// Registers the aggregate `identify`.
///
/// # Errors
///
/// A registry that does not accept functions.
pub fn register(registry: &mut dyn FunctionRegistry, robots: &Arc<Robots>) -> Result<(), Error> {
    let identify = AggregateUDF::new_from_impl(Identify::new(robots.clone()));
    registry.register_udaf(Arc::new(identify))?;
    Ok(())
}
