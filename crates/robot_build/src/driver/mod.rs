//! The driver, which takes and returns texts and does not access files, the environment or the terminal.

pub mod ablation;
pub(crate) mod angles;
pub mod budget;
pub mod check;
pub(crate) mod conventions;
pub(crate) mod counted;
pub(crate) mod file;
pub(crate) mod generate;
#[cfg(feature = "languages")]
pub mod languages;
pub(crate) mod limbs;
pub(crate) mod nominal;
pub(crate) mod options;
pub mod package;
pub(crate) mod pivots;
pub(crate) mod problems;
pub(crate) mod programs;
pub(crate) mod readme;
pub(crate) mod singular;
pub mod snapping;
pub(crate) mod specification;
