//! All code that accesses files or the environment: the builder for build scripts, and the robot files, pinned plans
//! and output files that all entry points read and write.

pub(crate) mod builder;
mod cargo;
pub(crate) mod files;
pub(crate) mod paths;
pub(crate) mod pin;
pub(crate) mod system;
