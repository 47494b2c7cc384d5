//! What several tests use.

pub(crate) mod arm;
pub(crate) mod random;
pub(crate) mod rustc;
