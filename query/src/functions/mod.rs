//! The dynamics of robots as functions of SQL.

mod dynamics;
mod literal;
mod output;
mod residual;
mod scaled;

use std::sync::Arc;

use datafusion::execution::FunctionRegistry;
use datafusion::logical_expr::{ScalarUDF, ScalarUDFImpl};
use robot_build::FunctionKind;

use crate::error::Error;
use crate::robots::Robots;
use dynamics::Dynamics;
pub(crate) use dynamics::{compute, function};
pub(crate) use literal::text_of;
use residual::Residual;
pub use residual::torques_of;
use scaled::Scaled;

/// Registers the functions of a robot whose result is one array over the joints' variables, under their names, and
/// `residual` and `scaled`.
///
/// # Errors
///
/// A registry that does not accept functions.
pub fn register(registry: &mut dyn FunctionRegistry, robots: &Arc<Robots>) -> Result<(), Error> {
    for kind in FunctionKind::ALL.iter().copied().filter(|kind| is_one(*kind)) {
        registry.register_udf(udf(Dynamics::new(kind, robots.clone())))?;
    }
    registry.register_udf(udf(Residual::new(robots.clone())))?;
    registry.register_udf(scaled())?;
    Ok(())
}

/// The function that converts columns to other units.
pub(crate) fn scaled() -> Arc<ScalarUDF> {
    udf(Scaled::new())
}

fn udf(function: impl ScalarUDFImpl + 'static) -> Arc<ScalarUDF> {
    Arc::new(ScalarUDF::new_from_impl(function))
}

/// Whether the first argument of a function or aggregate of that name is a robot.
pub(crate) fn takes_robot(name: &str) -> bool {
    let mut kinds = FunctionKind::ALL.iter().filter(|kind| is_one(**kind));
    name == "residual" || name == "identify" || kinds.any(|kind| kind.name() == name)
}

/// Whether a kind is a single function; the kinds of frames have one function for each frame.
fn is_one(kind: FunctionKind) -> bool {
    !matches!(kind, FunctionKind::Jacobian | FunctionKind::JacobianDotQd)
}
