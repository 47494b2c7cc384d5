//! The limit on the number of expressions for which equations are derived.

use super::Writer;
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
}
