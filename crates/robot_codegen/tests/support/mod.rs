//! Code that several tests share.

pub(crate) mod arm;
pub(crate) mod random;
pub(crate) mod rustc;
