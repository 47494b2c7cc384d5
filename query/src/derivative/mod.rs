//! Derivatives of sampled positions.

mod cubic;
mod window;

use std::sync::Arc;

use datafusion::execution::FunctionRegistry;
use datafusion::logical_expr::WindowUDF;

use crate::error::Error;
pub(crate) use cubic::{Samples, derivatives};
use window::Derivative;

/// Registers the window function `derivative`.
///
/// # Errors
///
/// A registry that does not accept functions.
pub fn register(registry: &mut dyn FunctionRegistry) -> Result<(), Error> {
    registry.register_udwf(Arc::new(WindowUDF::new_from_impl(Derivative::new())))?;
    Ok(())
}
