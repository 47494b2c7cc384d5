//! The doors: everything that touches files or the environment. The builder for build scripts, robot files, pins and output
//! files.

pub(crate) mod builder;
mod cargo;
pub(crate) mod files;
pub(crate) mod paths;
pub(crate) mod pin;
