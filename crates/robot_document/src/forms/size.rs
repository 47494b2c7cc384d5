//! The limit on the number of expressions for which equations are derived, and the error for sums that are too long.

use super::{Writer, grouped};
use crate::error::Error;

/// The largest number of expressions for which equations are derived; the equations of arms need some thousands.
pub(crate) const MAX_NODES: usize = 300_000;

impl Writer<'_, '_> {
    /// Refuses equations for which too many expressions were derived: what is written from a full graph is not true.
    pub(super) fn check_size(&self) -> Result<(), Error> {
        match self.graph.is_full() {
            true => Err(Error::TooManyExpressions { limit: MAX_NODES }),
            false => Ok(()),
        }
    }

    /// The error for sums that are too long if products are multiplied out, with the forms that the robot has.
    pub(super) fn too_long(&self, reason: String) -> Error {
        let forms = match self.robot.degrees_of_freedom() > grouped::MAX_COORDINATES {
            true => "`recursive` or `compact`",
            false => "`grouped`, `recursive` or `compact`",
        };
        Error::TooLong { reason, forms }
    }
}
