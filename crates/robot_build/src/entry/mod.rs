//! Everything that touches files or the environment: the builder for build scripts, and robot files, pins and output
//! files as all entry points read and write them.

pub(crate) mod builder;
mod cargo;
pub(crate) mod files;
pub(crate) mod paths;
pub(crate) mod pin;
